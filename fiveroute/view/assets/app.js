// The page: maps, tables and clock put together.

const KINDS = {
  collections: ["collect"],
  changes: ["discard", "pick_up"],
  messages: ["send", "receive"],
  manoeuvres: ["manoeuvre"],
  "departures and ends": ["depart", "arrive", "fail"],
};

/** Seconds that an event is seen while the clock runs. */
const LIFE = 0.9;

/** Milliseconds without a movement after which the camera rests. */
const REST = 150;

const byId = (id) => document.getElementById(id);

class App {
  /** editor: what lets the scene be changed on the map, see the studio; null shows it only. */
  constructor(scenes, editor = null) {
    this.scenes = scenes;
    this.editor = editor;
    this.camera = new Camera();
    this.kinds = new Set(Object.values(KINDS).flat());
    this.shows = { arrows: true, routes: true, names: true, events: true };
    this.player = new Player(
      () => this.redraw(),
      () => this.showState(),
    );
    this.isDark = matchMedia("(prefers-color-scheme: dark)").matches;
    this.isCalm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.panes = [new Pane(this, scenes, 0, scenes[0].runs.length ? 0 : -1)];
    this.active = this.panes[0];
    this.strip = new Strip(byId("strip"));
    this.bars = new Bars(byId("bars"));
    this.events = new EventList(byId("events"), (event) => this.go(event));
    byId("title").textContent = [...new Set(scenes.map((scene) => scene.name))].join(" and ");
    byId("panes").append(this.panes[0].article);
    this.wire();
    if (scenes.length > 1) this.compare();
    this.setTheme(this.isDark);
    this.changed();
    this.player.suit(this.player.end);
    this.showState();
    this.fit();
    new ResizeObserver(() => this.resized()).observe(byId("panes"));
  }

  get theme() {
    return THEMES[this.isDark ? "dark" : "light"];
  }

  wire() {
    byId("play").addEventListener("click", () => this.player.toggle());
    byId("before").addEventListener("click", () => this.step(-1));
    byId("after").addEventListener("click", () => this.step(1));
    byId("time").addEventListener("input", (event) => this.player.set(Number(event.target.value)));
    byId("fit").addEventListener("click", () => this.fit());
    byId("compare").addEventListener("click", () => this.compare());
    byId("theme").addEventListener("click", () => this.setTheme(!this.isDark));
    byId("help").addEventListener("click", () => byId("keys").showModal());
    const speeds = SPEEDS.map((speed) => element("option", { value: speed }, `× ${speed}`));
    byId("speed").append(...speeds);
    byId("speed").addEventListener("change", (event) => {
      this.player.speed = Number(event.target.value);
    });
    byId("which").addEventListener("change", (event) =>
      this.activate(this.panes[Number(event.target.value)]),
    );
    this.wireTabs();
    this.wireFilters();
    document.addEventListener("keydown", (event) => this.pressed(event));
    addEventListener("beforeprint", () => this.print(true));
    addEventListener("afterprint", () => this.print(false));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", (event) =>
      this.setTheme(event.matches),
    );
  }

  wireTabs() {
    const tabs = [...document.querySelectorAll("[role=tab]")];
    tabs.forEach((tab, k) => {
      tab.addEventListener("click", () => this.openTab(tab));
      tab.addEventListener("keydown", (event) => {
        const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
        if (!step) return;
        event.stopPropagation();
        const next = tabs[(k + step + tabs.length) % tabs.length];
        this.openTab(next);
        next.focus();
      });
    });
  }

  openTab(tab) {
    for (const other of document.querySelectorAll("[role=tab]")) {
      const isOpen = other === tab;
      other.setAttribute("aria-selected", String(isOpen));
      other.tabIndex = isOpen ? 0 : -1;
      byId(other.getAttribute("aria-controls")).hidden = !isOpen;
    }
    this.fillSide();
  }

  wireFilters() {
    for (const [name, kinds] of Object.entries(KINDS)) {
      const box = element("input", { type: "checkbox", checked: "" });
      box.addEventListener("change", () => {
        for (const kind of kinds) this.kinds[box.checked ? "add" : "delete"](kind);
        this.fillSide();
        this.redraw();
      });
      byId("filters").append(element("label", {}, box, ` ${name}`));
    }
  }

  /** One map or two. */
  compare() {
    if (this.panes.length === 2) {
      this.panes.pop().article.remove();
    } else {
      const [which, run] = this.other();
      this.panes.push(new Pane(this, this.scenes, which, run));
      byId("panes").append(this.panes[1].article);
    }
    byId("panes").classList.toggle("two", this.panes.length === 2);
    byId("compare").setAttribute("aria-pressed", String(this.panes.length === 2));
    this.active = this.panes[0];
    this.changed();
    this.fit();
  }

  /** What the second map shows first: the other plan, another run, or the plan itself. */
  other() {
    const { which, run } = this.panes[0];
    if (this.scenes.length > 1)
      return [1 - which, Math.min(run, this.scenes[1 - which].runs.length - 1)];
    return [0, run < 0 ? Math.min(0, this.scenes[0].runs.length - 1) : -1];
  }

  /** Something else is shown: the end of time, names, tables. */
  changed() {
    this.player.end = Math.max(...this.panes.map((pane) => pane.timeline.end), 1e-9);
    byId("time").max = String(this.player.end);
    this.player.t = Math.min(this.player.t, this.player.end);
    const which = byId("which");
    which.replaceChildren(
      ...this.panes.map((pane, k) => element("option", { value: k }, k ? "right" : "left")),
    );
    which.value = String(this.panes.indexOf(this.active));
    byId("which-label").hidden = this.panes.length < 2;
    this.fillSide();
    this.redraw();
  }

  /** Show a scene as it has become, from where it was looked at. */
  replaceScene(which, scene) {
    this.scenes[which] = scene;
    for (const pane of this.panes) pane.choose(pane.which, pane.run);
    this.changed();
  }

  activate(pane) {
    if (this.active === pane) return;
    this.active = pane;
    this.changed();
  }

  /** Build the tables of the open tab anew. */
  fillSide() {
    const { active: pane, theme } = this;
    const { scene, timeline } = pane;
    const what = timeline.isRun ? `${timeline.label} of ${scene.runs.length} runs` : timeline.label;
    byId("subtitle").textContent =
      `${scene.routes.length} AUVs · ${scene.ids.length} nodes · ${what} · fiveroute ${scene.version}`;
    this.tables = [];
    if (!byId("panel-fleet").hidden) {
      this.tables.push(fleetTable(byId("fleet"), pane, theme, (auv) => this.pick(pane, auv, 0)));
      this.tables[0].kind = "auv";
    }
    if (!byId("panel-nodes").hidden) {
      this.tables.push(
        nodeTable(byId("panel-nodes"), pane, theme, (node) => this.pick(pane, -1, node)),
      );
      this.tables[0].kind = "node";
    }
    if (!byId("panel-events").hidden) this.events.show(scene, timeline, theme, this.kinds);
    if (!byId("panel-key").hidden) showKey(byId("panel-key"), this);
    this.tables.forEach((table) => table.mark(pane.marked[table.kind]));
    this.updateSide(true);
  }

  /** Mark what was chosen in a table, and bring it into sight. */
  pick(pane, auv, node) {
    pane.mark(auv, node);
    const place = pane.placeOfMarked();
    if (place && !pane.isInSight(place)) [this.camera.x, this.camera.y] = [place.x, place.y];
  }

  marked(pane) {
    this.tables.forEach((table) => table.mark(pane.marked[table.kind]));
    this.editor?.marked(pane);
    this.redraw();
  }

  /** Jump to an event and say it. */
  go(event) {
    this.player.pause();
    this.player.set(event.t);
    byId("said").textContent = `${clock(event.t)}: ${sentence(this.active.scene, event)}`;
  }

  step(sign) {
    const events = this.active.timeline.events.filter((event) => this.kinds.has(event.kind));
    const now = this.player.t;
    const next =
      sign > 0 ? events.find((event) => event.t > now) : events.findLast((event) => event.t < now);
    if (next) this.go(next);
  }

  fit() {
    const canvas = this.panes[0].canvas;
    const [width, height] = [canvas.clientWidth || 800, canvas.clientHeight || 600];
    const regions = this.panes.map((pane) => pane.scene.region);
    const region = [0, 1, 2, 3].map((k) =>
      Math[k < 2 ? "min" : "max"](...regions.map((one) => one[k])),
    );
    this.camera.fit(region, width, height);
    this.fitScale = this.camera.scale;
    this.redraw();
  }

  resized() {
    const isWhole = this.camera.scale === this.fitScale;
    if (isWhole) this.fit();
    this.redraw();
  }

  setTheme(isDark) {
    this.isDark = isDark;
    document.documentElement.dataset.theme = isDark ? "dark" : "light";
    byId("theme").textContent = isDark ? "Light" : "Dark";
    byId("theme").setAttribute("aria-label", isDark ? "Light colours" : "Dark colours");
    this.fillSide();
    this.redraw();
  }

  /** Paper is light. */
  print(isBegun) {
    if (isBegun) this.wasDark = this.isDark;
    if (!this.wasDark) return;
    this.setTheme(!isBegun);
    this.draw();
  }

  showState() {
    const { isPlaying, speed } = this.player;
    byId("play").classList.toggle("playing", isPlaying);
    byId("play").setAttribute("aria-label", isPlaying ? "Pause" : "Play");
    byId("speed").value = String(speed);
  }

  /** The camera moves, until nothing more is heard of it for a moment. */
  moved() {
    this.isMoving = true;
    clearTimeout(this.resting);
    this.resting = setTimeout(() => {
      this.isMoving = false;
      this.redraw();
    }, REST);
    this.redraw();
  }

  redraw() {
    if (this.isDue) return;
    this.isDue = true;
    requestAnimationFrame(() => {
      this.isDue = false;
      this.draw();
    });
  }

  draw() {
    const { t, end, speed } = this.player;
    const look = { life: LIFE * speed, kinds: this.kinds, isCalm: this.isCalm };
    for (const pane of this.panes) {
      pane.draw(t, this.theme, this.shows, look);
      pane.showFigures();
    }
    if (!byId("panel-fleet").hidden) this.bars.draw(this.active, end, t, this.theme);
    this.strip.draw(this.panes, end, t, this.theme);
    byId("time").value = String(t);
    byId("time").setAttribute("aria-valuetext", clock(t));
    byId("clock").textContent = `${clock(t)} / ${clock(end)}`;
    this.updateSide(false);
  }

  /** Tables follow the clock a few times a second. */
  updateSide(isNow) {
    const { t, isPlaying } = this.player;
    const now = performance.now();
    if (!isNow && (t === this.told || (isPlaying && now - this.toldAt < 120))) return;
    [this.told, this.toldAt] = [t, now];
    this.tables.forEach((table) => table.update());
    if (!byId("panel-events").hidden) this.events.at(t);
  }

  showTip(x, y, lines) {
    const tip = byId("tip");
    tip.replaceChildren(...lines.map((line) => element("div", { dir: "auto" }, line)));
    tip.hidden = false;
    const box = tip.getBoundingClientRect();
    tip.style.left = `${Math.min(x + 14, innerWidth - box.width - 6)}px`;
    tip.style.top = `${y + 18 + box.height > innerHeight ? y - box.height - 10 : y + 18}px`;
  }

  hideTip() {
    byId("tip").hidden = true;
  }

  pressed(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || byId("keys").open) return;
    const { target } = event;
    if (target.matches("select, input:not([type=range])")) return;
    const isPressable = target.matches("button, [role=tab], tr");
    if (isPressable && [" ", "Enter"].includes(event.key)) return;
    const action = this.actionOf(event);
    if (!action) return;
    event.preventDefault();
    action();
  }

  actionOf(event) {
    const { player } = this;
    const hundredth = player.end / 100;
    if (event.shiftKey && event.key.startsWith("Arrow")) {
      const [dx, dy] = {
        ArrowLeft: [60, 0],
        ArrowRight: [-60, 0],
        ArrowUp: [0, 60],
        ArrowDown: [0, -60],
      }[event.key];
      return () => {
        this.camera.pan(dx, dy);
        this.moved();
      };
    }
    const zoom = (factor) => () => {
      this.camera.zoomAt(factor, 0, 0);
      this.moved();
    };
    return {
      " ": () => player.toggle(),
      ArrowLeft: () => player.set(player.t - hundredth),
      ArrowRight: () => player.set(player.t + hundredth),
      ArrowUp: () => player.faster(1),
      ArrowDown: () => player.faster(-1),
      Home: () => player.set(0),
      End: () => player.set(player.end),
      "[": () => this.step(-1),
      "]": () => this.step(1),
      "+": zoom(1.4),
      "=": zoom(1.4),
      "-": zoom(1 / 1.4),
      "?": () => byId("keys").showModal(),
      f: () => this.fit(),
      c: () => this.compare(),
      d: () => this.setTheme(!this.isDark),
    }[event.key.length === 1 ? event.key.toLowerCase() : event.key];
  }
}

function start() {
  const { scenes } = JSON.parse(byId("data").textContent);
  return new App(scenes.map(unpackScene));
}
