// The panels of the studio: plan, mission, stop; files.

const LEGS = { ocean: "through the ocean", straight: "straight lines" };
const BOUNDS = { quick: "quick", exact: "until proved", none: "none" };

function section(title, ...children) {
  return element("section", { class: "part" }, element("h2", {}, title), ...children);
}

/** Plan: how far it is from optimal, how it is made. */
class PlanPart {
  constructor(studio) {
    this.studio = studio;
    this.gap = new GapView();
    this.state = element("p", { class: "state", id: "plan-state", role: "status" });
    this.go = button("plan", "Plan anew", () => studio.plan(), {
      class: "main",
      title: "Plan anew (P)",
    });
    this.stop = button("stop", "Stop, keep the best", () => studio.stop());
    const onChange = () => this.sum();
    this.legs = choiceOf("legs", "Legs", LEGS, onChange);
    this.bound = choiceOf("bound-kind", "Bound", BOUNDS, onChange);
    this.seconds = new Field("seconds", "Time limit", { unit: "s", onChange });
    this.seconds.show("30");
    this.summary = element("summary", { id: "how" });
    this.auto = element("input", { type: "checkbox", id: "auto" });
    this.box = section(
      "Plan",
      this.state,
      this.gap.box,
      element("div", { class: "row" }, this.go, this.stop),
      element(
        "details",
        { class: "how" },
        this.summary,
        this.legs.line,
        this.bound.line,
        this.seconds.line,
      ),
      element("label", { class: "check" }, this.auto, " plan after every edit, for five seconds"),
    );
    this.sum();
  }

  /** Say in a line how it is planned. */
  sum() {
    const legs = this.legs.line.hidden ? [] : [`legs ${LEGS[this.legs.select.value]}`];
    const bound = `bound ${BOUNDS[this.bound.select.value]}`;
    this.summary.textContent = [...legs, bound, `${this.seconds.text} s`].join(", ");
  }

  get isStraight() {
    return this.legs.select.value === "straight";
  }

  wish() {
    const seconds = this.seconds.number;
    if (seconds === null) throw new Error("Time limit: give a number of seconds");
    return { seconds, straight_lines: this.isStraight, bound: this.bound.select.value };
  }

  quickWish() {
    return { seconds: 5, straight_lines: this.isStraight, bound: "quick" };
  }

  show(state, scene, theme) {
    const { job, planned } = state;
    const isRunning = job?.state === "running";
    this.legs.line.hidden = !state.ocean;
    this.sum();
    this.stop.disabled = !isRunning;
    this.box.classList.toggle("running", isRunning);
    this.state.textContent = planWords(state, scene);
    this.state.dataset.state = isRunning ? "running" : planned ? "planned" : "old";
    const { total } = scene;
    const now = isRunning
      ? job
      : { objective: scene.routes.length ? scene.objective : null, bound: scene.bound, gap: scene.gap, status: scene.status };
    this.gap.show({ ...now, total });
    this.gap.drawCourse(job, total, theme);
  }
}

function planWords({ job, planned }, scene) {
  if (job?.state === "running")
    return `Planning: ${job.message}, ${job.seconds.toFixed(1)} of ${amount(job.limit)} s`;
  if (job?.state === "failed") return `No plan: ${job.error}`;
  if (planned && job?.state === "stopped") return "Stopped: the best plan so far.";
  if (planned && job && job.seconds > 0.95 * job.limit)
    return "The plan is up to date. Its time ran out: with more, its legs and routes may be better.";
  if (planned) return "The plan is up to date.";
  if (!scene.routes.length) return "There is no plan yet.";
  return "The plan is older than the mission: routes are a draft.";
}

/** Mission: its name and its fleet. */
class MissionPart {
  constructor(studio) {
    this.studio = studio;
    const onChange = () => this.enter();
    this.name = new Field("mission-name", "Name", { isText: true, onChange });
    this.size = new Field("fleet-size", "AUVs", { hint: "as estimated", onChange });
    this.endurance = new Field("endurance", "Endurance", { unit: "s", hint: "unlimited", onChange });
    this.speed = new Field("speed-water", "Speed", { unit: "m/s", onChange });
    const steps = [-1, 1].map((step) =>
      button(step < 0 ? "fewer" : "more", step < 0 ? "−" : "+", () => this.resize(step), {
        "aria-label": step < 0 ? "One AUV fewer" : "One AUV more",
        class: "step",
      }),
    );
    this.size.unit.replaceChildren(...steps);
    const fields = [this.name, this.size, this.endurance, this.speed];
    this.box = section("Mission", ...fields.map((field) => field.line));
  }

  show({ mission }) {
    this.mission = mission;
    this.name.show(mission.name);
    this.size.show(shownNumber(mission.fleet.size));
    this.endurance.show(shownNumber(mission.fleet.endurance));
    this.speed.show(shownNumber(mission.fleet.speed));
    const { endurance } = mission.fleet;
    const hours = typeof endurance === "number" ? ` = ${clock(endurance)}` : "";
    this.endurance.unit.textContent = `s${hours}`;
  }

  resize(step) {
    const size = (this.mission.fleet.size || this.studio.scene.routes.length) + step;
    if (size < 1) return;
    this.size.input.value = String(size);
    this.enter();
  }

  async enter() {
    const isDone = await this.studio.attempt(() => {
      const fleet = {
        ...this.mission.fleet,
        size: this.size.number,
        endurance: numbersOf(this.endurance.text, "Endurance"),
        speed: this.speed.number,
      };
      return this.studio.edit({ do: "mission", name: this.name.text.trim(), fleet });
    });
    if (!isDone) this.show(this.studio.state);
  }
}

/** The stop that is selected, and what can be done with it. */
class StopPart {
  constructor(studio) {
    this.studio = studio;
    const onChange = () => this.enter();
    this.id = new Field("stop-id", "Name", { isText: true, onChange });
    this.x = new Field("stop-x", "East", { unit: "m", onChange });
    this.y = new Field("stop-y", "North", { unit: "m", onChange });
    this.data = new Field("stop-data", "Data", { onChange });
    this.service = new Field("stop-service", "Service", { unit: "s", hint: "by data", onChange });
    this.depth = new Field("stop-depth", "Depth", { unit: "m", hint: "that of the fleet", onChange });
    this.add = button("add", "Add a node", () => studio.editor.setAdding(!studio.editor.isAdding), {
      "aria-pressed": "false",
      title: "Then click on the map (A); N puts it in the middle of the map",
    });
    this.remove = button("remove", "Remove", () => studio.editor.remove(), {
      title: "Remove the selected node (Delete)",
    });
    this.title = element("h2", { id: "stop-title", dir: "auto" });
    this.place = element("p", { id: "stop-place", class: "hint" });
    this.ofNode = [this.id, this.data, this.service, this.depth];
    this.fields = element(
      "div",
      {},
      this.id.line,
      element("div", { class: "pair" }, this.x.line, this.y.line),
      this.place,
      element("div", { class: "pair" }, this.data.line, this.service.line),
      this.depth.line,
    );
    this.none = element("p", { class: "hint" }, "Drag a node, the start ▲ or the destination ★. Click one to edit it here.");
    this.box = element(
      "section",
      { class: "part" },
      this.title,
      this.none,
      element("div", { class: "row" }, this.add, this.remove),
      this.fields,
    );
  }

  show({ mission, view }, vertex) {
    this.mission = mission;
    this.vertex = vertex;
    const count = mission.nodes.length;
    const isNode = vertex >= 1 && vertex <= count;
    const stop = isNode ? mission.nodes[vertex - 1] : vertex === 0 ? mission.start : mission.destination;
    this.fields.hidden = vertex < 0;
    this.none.hidden = vertex >= 0;
    this.remove.disabled = !isNode;
    for (const field of this.ofNode) field.line.hidden = !isNode;
    this.title.textContent =
      vertex < 0 ? "Stops" : isNode ? `Node ${stop.id}` : vertex === 0 ? "Start" : "Destination";
    if (vertex < 0) return;
    this.x.show(String(Number(stop.x.toFixed(3))));
    this.y.show(String(Number(stop.y.toFixed(3))));
    this.place.textContent = placeText(view.scenes[0], stop.x, stop.y) || "";
    if (!isNode) return;
    this.id.show(stop.id);
    this.data.show(shownNumber(stop.data));
    this.service.show(shownNumber(stop.service_time));
    this.depth.show(shownNumber(stop.depth));
  }

  /** A coordinate that nobody touched keeps all its digits. */
  coordinate(field, before) {
    return field.text === field.shown ? before : field.number;
  }

  async enter() {
    const { mission, vertex } = this;
    const isDone = await this.studio.attempt(() => {
      if (vertex < 0) return null;
      if (vertex < 1 || vertex > mission.nodes.length) {
        const stop = vertex === 0 ? mission.start : mission.destination;
        const [x, y] = [this.coordinate(this.x, stop.x), this.coordinate(this.y, stop.y)];
        return this.studio.edit({ do: "move", vertex, x, y, alone: true });
      }
      const stop = mission.nodes[vertex - 1];
      const node = {
        id: this.id.text.trim(),
        x: this.coordinate(this.x, stop.x),
        y: this.coordinate(this.y, stop.y),
        data: this.data.number,
        service_time: this.service.number,
        depth: this.depth.number,
      };
      return this.studio.edit({ do: "node", vertex, node });
    });
    if (!isDone) this.studio.showStop();
  }
}

const FORMAT_NAMES = {
  qgc: "QGroundControl (ArduSub)",
  wpl: "waypoint list (QGC WPL)",
  neptus: "Neptus (DUNE)",
  moos: "MOOS-IvP",
  slocum: "Slocum glider",
  cola2: "COLA2",
  gpx: "GPX",
  kml: "KML",
  geojson: "GeoJSON",
  csv: "CSV",
};

/** Files: saving and exporting. */
class FilesPart {
  constructor(studio, formats) {
    this.studio = studio;
    this.instance = new Field("save-instance", "Mission", { isText: true });
    this.plan = new Field("save-plan", "Plan", { isText: true });
    this.folder = element("p", { class: "hint path", dir: "auto" });
    const names = Object.fromEntries(
      Object.keys(formats).map((name) => [name, FORMAT_NAMES[name] || name]),
    );
    this.format = choiceOf("export-format", "Format", names);
    this.name = new Field("export-name", "Name", { isText: true });
    this.depth = new Field("export-depth", "Depth", { unit: "m", hint: "that of the fleet" });
    this.origin = new Field("export-origin", "Origin", { unit: "lon, lat", hint: "of the mission" });
    this.auv = new Field("export-auv", "Only AUV", { hint: "all" });
    this.vehicles = new Field("export-vehicles", "Names", { isText: true, hint: "auv-1, auv-2, ..." });
    this.departure = new Field("export-departure", "Departure", {
      isText: true,
      unit: "UTC",
      hint: "2016-01-31T12:00",
    });
    this.tolerance = new Field("export-tolerance", "Tolerance", { unit: "m" });
    this.tolerance.show("1");
    this.savePlan = button("save-both", "Save mission and plan", () => this.save(true), { class: "main" });
    this.exportButton = button("export", "Export the plan", () => this.export(), { class: "main" });
    this.box = element(
      "div",
      {},
      section(
        "Save",
        this.folder,
        this.instance.line,
        this.plan.line,
        element(
          "div",
          { class: "row" },
          this.savePlan,
          button("save-mission", "Mission only", () => this.save(false)),
        ),
      ),
      section(
        "Export for vehicles and maps",
        this.format.line,
        this.name.line,
        this.depth.line,
        this.origin.line,
        element(
          "details",
          { class: "how" },
          element("summary", { id: "export-more" }, "One AUV, names, departure, tolerance"),
          this.auv.line,
          this.vehicles.line,
          this.departure.line,
          this.tolerance.line,
        ),
        element("div", { class: "row" }, this.exportButton),
        element(
          "p",
          { class: "hint" },
          "A plan that crosses land or obstacles, dives too deep or takes too long is refused.",
        ),
      ),
    );
  }

  show(state) {
    this.savePlan.disabled = this.exportButton.disabled = !state.planned;
    const reason = state.planned ? "" : "Plan anew first";
    this.savePlan.title = this.exportButton.title = reason;
    this.folder.textContent = `Into ${state.folder}`;
    if (this.instance.text) return;
    const stem = state.stem.replace(/-plan$/, "");
    this.instance.show(`${stem}.json`);
    this.plan.show(`${stem}-plan.json`);
    this.name.show(stem);
  }

  save(hasPlan) {
    const body = { instance: this.instance.text.trim() };
    if (hasPlan) body.plan = this.plan.text.trim();
    return this.studio.write("/api/save", body, ({ names }) => `Saved ${names.join(" and ")}.`);
  }

  export() {
    return this.studio.attempt(() => {
      const body = { format: this.format.select.value, name: this.name.text.trim() };
      const given = {
        depth: this.depth.number,
        origin: numbersOf(this.origin.text, "Origin"),
        auv: this.auv.number,
        vehicles: namesOf(this.vehicles.text),
        departure: this.departure.text.trim() || null,
        tolerance: this.tolerance.number,
      };
      for (const [name, value] of Object.entries(given)) if (value !== null) body[name] = value;
      return this.studio.write(
        "/api/export",
        body,
        ({ name, vehicles }) => `Exported ${name}: ${vehicles.join(", ")}.`,
      );
    });
  }
}
