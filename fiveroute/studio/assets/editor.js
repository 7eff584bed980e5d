// Editing on the map: stops are taken and dragged, and new nodes are put down.

const REACH = 14;

/** Pixels that an arrow key moves a stop. */
const NUDGE = 8;

class Editor {
  constructor(studio) {
    this.studio = studio;
    this.selected = -1;
    this.dragged = -1;
    this.isAdding = false;
  }

  /** The stop under a pixel, or -1; nodes come before start and destination. */
  stopAt(pane, px, py) {
    const { scene, view } = pane;
    if (!view) return -1;
    const last = scene.ids.length + 1;
    const order = [...Array(scene.ids.length).keys()].map((k) => k + 1);
    let best = { vertex: -1, distance: REACH };
    for (const vertex of [...order, 0, last]) {
      const distance = Math.hypot(
        view.sx(scene.points[2 * vertex]) - px,
        view.sy(scene.points[2 * vertex + 1]) - py,
      );
      if (distance < best.distance) best = { vertex, distance };
    }
    return best.vertex;
  }

  /** Take the stop under the pointer; null if there is none. */
  grip(pane, event) {
    if (event.button || this.isAdding || this.studio.isBusy) return null;
    const vertex = this.stopAt(pane, ...pane.place(event));
    if (vertex < 0) return null;
    const { points } = pane.scene;
    const moving = this.together(pane.scene, vertex, event.altKey);
    const before = moving.map((one) => [points[2 * one], points[2 * one + 1]]);
    const put = (x, y) => {
      for (const one of moving) [points[2 * one], points[2 * one + 1]] = [x, y];
      pane.app.redraw();
    };
    return {
      move: (now) => {
        this.dragged = vertex;
        const [px, py] = pane.place(now);
        put(pane.view.wx(px), pane.view.wy(py));
        this.select(pane, vertex);
      },
      drop: (isMeant) => {
        if (this.dragged < 0) return;
        this.dragged = -1;
        const [x, y] = [points[2 * vertex], points[2 * vertex + 1]];
        if (isMeant) this.studio.edit({ do: "move", vertex, x, y, alone: event.altKey });
        else put(...before[0]);
      },
    };
  }

  /** Start and destination move together where they coincide. */
  together(scene, vertex, isAlone) {
    const last = scene.ids.length + 1;
    if (vertex !== 0 && vertex !== last) return [vertex];
    const { points } = scene;
    const isOne = points[0] === points[2 * last] && points[1] === points[2 * last + 1];
    return isOne && !isAlone ? [0, last] : [vertex];
  }

  /** Put a node down, or select a stop; whether the click was for the editor. */
  click(pane, event) {
    const [px, py] = pane.place(event);
    if (this.isAdding) {
      this.addAt(pane.view.wx(px), pane.view.wy(py));
      return true;
    }
    const vertex = this.stopAt(pane, px, py);
    if (vertex < 0) {
      this.select(pane, -1);
      return false;
    }
    this.select(pane, this.selected === vertex ? -1 : vertex);
    return true;
  }

  addAt(x, y) {
    this.setAdding(false);
    this.studio.edit({ do: "add", x, y }).then((isDone) => {
      const { panes } = this.studio.app;
      if (isDone) this.select(panes[0], panes[0].scene.ids.length);
    });
  }

  /** Add a node where the middle of the map is. */
  addInMiddle() {
    const { camera } = this.studio.app;
    this.addAt(camera.x, camera.y);
  }

  setAdding(isAdding) {
    this.isAdding = isAdding;
    this.studio.showAdding();
  }

  remove() {
    const { scene } = this.studio.app.panes[0];
    if (this.selected < 1 || this.selected > scene.ids.length) return;
    const vertex = this.selected;
    this.select(this.studio.app.panes[0], -1);
    this.studio.edit({ do: "remove", vertex });
  }

  nudge(dx, dy) {
    const { scene, view } = this.studio.app.panes[0];
    const vertex = this.selected;
    if (vertex < 0) return;
    const x = scene.points[2 * vertex] + (dx * NUDGE) / view.scale;
    const y = scene.points[2 * vertex + 1] + (dy * NUDGE) / view.scale;
    this.studio.edit({ do: "move", vertex, x, y });
  }

  select(pane, vertex) {
    const isNode = vertex >= 1 && vertex <= pane.scene.ids.length;
    this.selected = vertex;
    pane.marked = { auv: -1, node: isNode ? vertex : 0 };
    pane.app.marked(pane);
  }

  /** Something was marked on the map or in a table. */
  marked(pane) {
    if (pane.marked.node) this.selected = pane.marked.node;
    else if (this.isNode(pane, this.selected)) this.selected = -1;
    this.studio.showStop();
  }

  isNode(pane, vertex) {
    return vertex >= 1 && vertex <= pane.scene.ids.length;
  }

  hover(pane, px, py) {
    const cursor = this.isAdding ? "crosshair" : this.stopAt(pane, px, py) >= 0 ? "move" : "";
    pane.canvas.style.cursor = cursor;
  }

  draw(context, view, pane, theme) {
    if (this.dragged >= 0) this.drawBands(context, view, pane.scene, theme);
    const { selected } = this;
    if (selected < 0 || this.isNode(pane, selected)) return;
    const { points } = pane.scene;
    const [x, y] = [view.sx(points[2 * selected]), view.sy(points[2 * selected + 1])];
    drawRing(context, x, y, 16, theme.ink, 2, 1);
  }

  /** The legs of the dragged stop as rubber bands. */
  drawBands(context, view, scene, theme) {
    const last = scene.ids.length + 1;
    const moving = this.together(scene, this.dragged, false);
    const at = (vertex) => [view.sx(scene.points[2 * vertex]), view.sy(scene.points[2 * vertex + 1])];
    context.setLineDash([6, 5]);
    context.lineWidth = 2;
    scene.routes.forEach((route, auv) => {
      const stops = [0, ...route, last];
      context.strokeStyle = auvColour(theme, auv);
      for (let k = 1; k < stops.length; k += 1) {
        if (!moving.includes(stops[k - 1]) && !moving.includes(stops[k])) continue;
        context.beginPath();
        context.moveTo(...at(stops[k - 1]));
        context.lineTo(...at(stops[k]));
        context.stroke();
      }
    });
    context.setLineDash([]);
  }
}
