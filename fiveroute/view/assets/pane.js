// One map: a scene, the plan or one run of it, its figures, and what the pointer does.

class Pane {
  constructor(app, scenes, which, run) {
    this.app = app;
    this.scenes = scenes;
    this.t = 0;
    this.marked = { auv: -1, node: 0 };
    this.canvas = element("canvas", { tabindex: 0, role: "img" });
    this.ground = new Ground(this.canvas);
    this.nodes = new NodeLayer();
    this.choice = element("select", {
      "aria-label": "What this map shows",
      onchange: () => this.chosen(),
    });
    this.figures = element("dl", { class: "figures" });
    this.notes = element("details", { class: "notes" });
    this.article = element(
      "article",
      { class: "pane" },
      element("header", {}, this.choice, this.figures),
      element("div", { class: "map" }, this.canvas, this.notes),
    );
    this.fillChoice();
    this.choose(which, run);
    new Gestures(this);
  }

  fillChoice() {
    this.scenes.forEach((scene, k) => {
      const options = [-1, ...scene.runs.keys()].map((run) => {
        const name = run < 0 ? "plan as filed" : `run ${scene.runs[run].run}`;
        return element("option", { value: `${k} ${run}` }, `${scene.title}: ${name}`);
      });
      this.choice.append(...options);
    });
  }

  chosen() {
    const [which, run] = this.choice.value.split(" ").map(Number);
    this.choose(which, run);
    this.app.changed();
  }

  choose(which, run) {
    [this.which, this.run] = [which, run];
    this.scene = this.scenes[which];
    this.timeline = timelineOf(this.scene, run);
    this.choice.value = `${which} ${run}`;
    const { notes } = this.scene;
    const count = notes.length === 1 ? "1 note" : `${notes.length} notes`;
    this.notes.replaceChildren(
      element("summary", {}, count),
      ...notes.map((note) => element("p", {}, note)),
    );
    this.notes.hidden = !notes.length;
    this.notes.open = notes.some((note) => note.startsWith("The current is not drawn"));
    const fleet = `${this.scene.routes.length} AUVs, ${this.scene.ids.length} nodes`;
    this.canvas.setAttribute(
      "aria-label",
      `Map of ${this.scene.title}: ${this.timeline.label}, ${fleet}. The tables tell the same.`,
    );
  }

  /** Nodes and data that an AUV has collected so far. */
  dataOf(auv) {
    if (this.tallied !== this.t || this.tallyOf !== this.timeline) this.count();
    return this.tally[auv];
  }

  count() {
    [this.tallied, this.tallyOf] = [this.t, this.timeline];
    this.tally = this.scene.routes.map(() => ({ count: 0, sum: 0 }));
    this.timeline.changes.forEach((own, k) => {
      const { state, auv } = stateAt(own, this.t);
      if (state !== "collected") return;
      this.tally[auv].count += 1;
      this.tally[auv].sum += this.scene.data[k];
    });
  }

  showFigures() {
    const { scene, timeline } = this;
    const now = collectedAt(timeline, this.t);
    const rate = (data) => (scene.total > 0 ? percent(data / scene.total) : "all");
    const figures = [
      [
        "collected",
        `${amount(now)} of ${amount(scene.total)}`,
        "Data collected so far, of all there is",
      ],
      ["completion", rate(now), "Share of all data collected so far"],
      [
        "plan",
        `${amount(scene.objective)} (${rate(scene.objective)})`,
        `${scene.status}, by ${scene.method}${scene.seed === null ? "" : `, seed ${scene.seed}`}`,
      ],
      ["bound", scene.bound === null ? "none" : amount(scene.bound), "No plan can collect more"],
      [
        "gap",
        scene.gap === null
          ? "unknown"
          : scene.status === "optimal"
            ? "0 (proved)"
            : percent(scene.gap),
        "(bound − plan) / plan",
      ],
    ];
    const text = figures.map((figure) => figure[1]).join("|");
    if (text === this.shownFigures) return;
    this.shownFigures = text;
    this.figures.replaceChildren(
      ...figures.map(([name, value, title]) =>
        element("div", { title }, element("dt", {}, name), element("dd", {}, value)),
      ),
    );
  }

  draw(t, theme, shows, look) {
    this.t = t;
    const { context, width, height } = sized(this.canvas);
    if (!width || !height) return;
    const view = (this.view = this.app.camera.view(width, height));
    view.least = this.app.fitScale;
    const shown = { scene: this.scene, timeline: this.timeline, theme, t, shows };
    const isSharp = this.ground.draw(context, view, shown, this.app.isMoving);
    this.canvas.setAttribute("aria-busy", String(!isSharp));
    this.nodes.draw(this.canvas, view, shown, this.app.editor?.dragged >= 0);
    overlay(context, this.nodes.canvas);
    if (shows.names) drawNames(context, view, this.scene, theme);
    drawEnds(context, view, this.scene, theme);
    if (this.marked.node) this.drawMarkedNode(context, view, theme);
    if (shows.events) {
      drawLinks(context, view, this.timeline, theme, t, look);
      drawEvents(context, view, this.scene, this.timeline, theme, t, look);
    }
    drawAuvs(context, view, this.timeline, theme, t, this.marked.auv);
    this.app.editor?.draw(context, view, this, theme);
    drawFurniture(context, view, this.scene, theme);
  }

  drawMarkedNode(context, view, theme) {
    const { node } = this.marked;
    const [x, y] = [view.sx(this.scene.points[2 * node]), view.sy(this.scene.points[2 * node + 1])];
    drawRing(context, x, y, nodeRadius(this.scene, node, view) + 5, theme.ink, 2, 1);
  }

  place(event) {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  /** The AUV or node under a pixel, if any. */
  under(px, py) {
    const { view, scene, timeline } = this;
    let best = { distance: 14, auv: -1, node: 0 };
    timeline.tracks.forEach((track, auv) => {
      const now = positionAt(track, this.t);
      const distance = Math.hypot(view.sx(now.x) - px, view.sy(now.y) - py);
      if (distance < best.distance) best = { distance, auv, node: 0 };
    });
    if (best.auv >= 0) return best;
    for (let node = 1; node <= scene.ids.length; node += 1) {
      const distance = Math.hypot(
        view.sx(scene.points[2 * node]) - px,
        view.sy(scene.points[2 * node + 1]) - py,
      );
      if (distance < best.distance) best = { distance, auv: -1, node };
    }
    return best;
  }

  click(event) {
    if (this.app.editor?.click(this, event)) return;
    const { auv, node } = this.under(...this.place(event));
    this.app.activate(this);
    this.mark(auv, node);
    if (event.pointerType === "touch") this.hover(event);
  }

  mark(auv, node) {
    const isSame = this.marked.auv === auv && this.marked.node === node;
    this.marked = isSame ? { auv: -1, node: 0 } : { auv, node };
    this.app.marked(this);
  }

  /** Where the marked AUV or node is, in metres; null if nothing is marked. */
  placeOfMarked() {
    const { auv, node } = this.marked;
    if (auv >= 0) return positionAt(this.timeline.tracks[auv], this.t);
    return node ? { x: this.scene.points[2 * node], y: this.scene.points[2 * node + 1] } : null;
  }

  isInSight({ x, y }) {
    const [px, py] = [this.view.sx(x), this.view.sy(y)];
    return px > 0 && py > 0 && px < this.view.width && py < this.view.height;
  }

  hover(event) {
    if (!this.view) return;
    const [px, py] = this.place(event);
    this.app.editor?.hover(this, px, py);
    const { auv, node } = this.under(px, py);
    const lines =
      auv >= 0
        ? auvLines(this, this.dataOf(auv), auv)
        : node
          ? nodeLines(this, node)
          : seaLines(this, this.view.wx(px), this.view.wy(py));
    this.app.showTip(event.clientX, event.clientY, lines.filter(Boolean));
  }
}
