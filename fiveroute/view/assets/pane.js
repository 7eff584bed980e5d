// One map: a scene, the plan or one run of it, its figures, and what the pointer does.

/** Nodes beyond which a map draws only those again that change. */
const MANY_NODES = 2000;

class Pane {
  constructor(app, scenes, which, run) {
    this.app = app;
    this.scenes = scenes;
    this.t = 0;
    this.marked = { auv: -1, node: 0 };
    this.sea = document.createElement("canvas");
    this.seaKey = "";
    this.nodes = new NodeLayer();
    this.canvas = element("canvas", { tabindex: 0, role: "img" });
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
    this.listen();
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
    this.seaKey = "";
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
    this.drawStill(view, theme, shows, width, height);
    context.drawImage(this.sea, 0, 0, width, height);
    drawSailed(context, view, this.timeline, theme, t);
    // an editor moves nodes about, and a node that is wiped takes a bite out of those it touches
    const isKept = !this.app.editor && this.scene.ids.length > MANY_NODES;
    const key = isKept ? this.viewKey(view, theme) : "";
    this.nodes.draw(this.canvas, key, view, this.scene, this.timeline, theme, t);
    context.drawImage(this.nodes.canvas, 0, 0, width, height);
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

  /** All that decides where things are drawn, and in which colours. */
  viewKey(view, theme) {
    const { x, y, scale } = this.app.camera;
    const { width, height } = view;
    const shown = [theme.water, window.devicePixelRatio, this.which, this.run];
    return [x, y, scale, width, height, ...shown].join();
  }

  /** The sea and the planned routes, drawn anew only when the view changes. */
  drawStill(view, theme, shows, width, height) {
    const frame = this.scene.chart ? frameAt(this.scene.chart, this.t) : 0;
    const key = [this.viewKey(view, theme), frame, shows.arrows, shows.routes].join();
    if (key === this.seaKey) return;
    this.seaKey = key;
    [this.sea.width, this.sea.height] = [this.canvas.width, this.canvas.height];
    const context = this.sea.getContext("2d");
    const ratio = window.devicePixelRatio || 1;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    drawSea(context, view, this.scene, theme, this.t, shows);
    if (shows.routes) drawPlanned(context, view, this.scene, theme, this.timeline.isRun);
  }

  drawMarkedNode(context, view, theme) {
    const { node } = this.marked;
    const [x, y] = [view.sx(this.scene.points[2 * node]), view.sy(this.scene.points[2 * node + 1])];
    drawRing(context, x, y, nodeRadius(this.scene, node, view) + 5, theme.ink, 2, 1);
  }

  listen() {
    const { canvas, app } = this;
    const fingers = new Map();
    let moved = 0;
    let grip = null;
    const spread = () => {
      const [a, b] = [...fingers.values()];
      return {
        x: (a.x + b.x) / 2,
        y: (a.y + b.y) / 2,
        size: Math.hypot(a.x - b.x, a.y - b.y) || 1,
      };
    };
    canvas.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        const { dx, dy } = this.fromCentre(event);
        app.camera.zoomAt(
          Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : event.ctrlKey ? 0.01 : 0.0016)),
          dx,
          dy,
        );
        app.redraw();
      },
      { passive: false },
    );
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
      moved = 0;
      grip?.drop(false);
      grip = fingers.size === 1 && app.editor ? app.editor.grip(this, event) : null;
      app.hideTip();
    });
    canvas.addEventListener("pointermove", (event) => {
      const last = fingers.get(event.pointerId);
      if (!last) {
        this.hover(event);
        return;
      }
      const before = fingers.size === 2 ? spread() : null;
      const [dx, dy] = [event.clientX - last.x, event.clientY - last.y];
      fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
      moved += Math.hypot(dx, dy);
      if (before) {
        const after = spread();
        const at = this.fromCentre({ clientX: after.x, clientY: after.y });
        app.camera.pan(after.x - before.x, after.y - before.y);
        app.camera.zoomAt(after.size / before.size, at.dx, at.dy);
      } else if (grip) {
        if (moved >= 4) grip.move(event);
      } else if (fingers.size === 1) {
        app.camera.pan(dx, dy);
      }
      app.redraw();
    });
    const release = (event) => {
      if (!fingers.delete(event.pointerId)) return;
      const isClick = event.type === "pointerup" && moved < 4;
      grip?.drop(event.type === "pointerup" && !isClick);
      grip = null;
      if (isClick) this.click(event);
    };
    canvas.addEventListener("pointerup", release);
    canvas.addEventListener("pointercancel", release);
    canvas.addEventListener("pointerleave", () => app.hideTip());
    canvas.addEventListener("focus", () => app.activate(this));
    canvas.addEventListener("dblclick", (event) => {
      const { dx, dy } = this.fromCentre(event);
      app.camera.zoomAt(event.shiftKey ? 0.5 : 2, dx, dy);
      app.redraw();
    });
  }

  fromCentre(event) {
    const box = this.canvas.getBoundingClientRect();
    return {
      dx: event.clientX - box.left - box.width / 2,
      dy: event.clientY - box.top - box.height / 2,
    };
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
    const found = this.under(px, py);
    const lines =
      found.auv >= 0
        ? this.auvLines(found.auv)
        : found.node
          ? this.nodeLines(found.node)
          : this.seaLines(px, py);
    this.app.showTip(event.clientX, event.clientY, lines);
  }

  auvLines(auv) {
    const { doing, node } = doingAt(this.scene, this.timeline, auv, this.t);
    const { count, sum } = this.dataOf(auv);
    const now = positionAt(this.timeline.tracks[auv], this.t);
    const place = placeText(this.scene, now.x, now.y);
    return [
      `AUV ${auv + 1}`,
      `${doing}${node ? ` ${this.scene.ids[node - 1]}` : ""}`,
      `${count} nodes, ${amount(sum)} data so far`,
      ...(place ? [place] : []),
    ];
  }

  nodeLines(node) {
    const { state, auv, t } = stateAt(this.timeline.changes[node - 1], this.t);
    const { scene } = this;
    const who = auv < 0 ? "" : `, AUV ${auv + 1}`;
    const when = t > 0 ? ` at ${clock(t)}` : "";
    const depth = scene.depths[node - 1];
    const deep = depth === null ? "" : `, ${amount(depth)} m deep`;
    const place = placeText(scene, scene.points[2 * node], scene.points[2 * node + 1]);
    return [
      scene.ids[node - 1],
      `data ${amount(scene.data[node - 1])}, service ${amount(scene.service[node - 1])} s${deep}`,
      `${STATES[state]}${who}${when}`,
      ...(place ? [place] : []),
    ];
  }

  seaLines(px, py) {
    const [x, y] = [this.view.wx(px), this.view.wy(py)];
    const { chart, metres } = this.scene;
    const east = `${length(Math.abs(x), metres)} ${x < 0 ? "west" : "east"}`;
    const north = `${length(Math.abs(y), metres)} ${y < 0 ? "south" : "north"}`;
    const place = placeText(this.scene, x, y);
    const lines = place ? [place, `${east}, ${north}`] : [`${east}, ${north}`];
    const what = maskAt(chart, x, y);
    const velocity = chart && !what ? velocityAt(chart, x, y, this.t) : null;
    if (what) lines.push(what === LAND ? "land" : "no data");
    if (velocity)
      lines.push(`current ${Math.hypot(...velocity).toFixed(2)} m/s to ${bearing(...velocity)}`);
    return lines;
  }
}
