// What wheel, mouse and fingers do on a map: zoom, pan, pinch, click, and drag for an editor.

/** Pixels that a pointer may stray in a click. */
const STRAY = 4;

class Gestures {
  constructor(pane) {
    Object.assign(this, { pane, app: pane.app, fingers: new Map(), strayed: 0, grip: null });
    const { canvas } = pane;
    const listen = (kind, action) =>
      canvas.addEventListener(kind, action.bind(this), { passive: false });
    listen("wheel", this.turned);
    listen("pointerdown", this.pressed);
    listen("pointermove", this.moved);
    listen("pointerup", this.released);
    listen("pointercancel", this.released);
    listen("pointerleave", () => this.app.hideTip());
    listen("focus", () => this.app.activate(pane));
    listen("dblclick", (event) => this.zoom(event.shiftKey ? 0.5 : 2, event));
  }

  zoom(factor, { clientX, clientY }) {
    const box = this.pane.canvas.getBoundingClientRect();
    const dx = clientX - box.left - box.width / 2;
    const dy = clientY - box.top - box.height / 2;
    this.app.camera.zoomAt(factor, dx, dy);
    this.app.moved();
  }

  turned(event) {
    event.preventDefault();
    const speed = event.deltaMode ? 0.05 : event.ctrlKey ? 0.01 : 0.0016;
    this.zoom(Math.exp(-event.deltaY * speed), event);
  }

  pressed(event) {
    const { app, fingers } = this;
    this.pane.canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, event);
    this.strayed = 0;
    this.grip?.drop(false);
    this.grip = fingers.size === 1 && app.editor ? app.editor.grip(this.pane, event) : null;
    app.hideTip();
  }

  moved(event) {
    const { app, fingers, grip } = this;
    const last = fingers.get(event.pointerId);
    if (!last) {
      this.pane.hover(event);
      return;
    }
    const before = this.spread();
    fingers.set(event.pointerId, event);
    const after = this.spread();
    const [dx, dy] = [event.clientX - last.clientX, event.clientY - last.clientY];
    this.strayed += Math.hypot(dx, dy);
    if (grip) {
      if (this.strayed >= STRAY) grip.move(event);
      app.redraw();
    } else if (fingers.size <= 2) {
      app.camera.pan(after.clientX - before.clientX, after.clientY - before.clientY);
      this.zoom(after.size / before.size, after);
    }
  }

  /** The middle of the fingers, and how far they are apart. */
  spread() {
    const [a, b = a] = this.fingers.values();
    return {
      clientX: (a.clientX + b.clientX) / 2,
      clientY: (a.clientY + b.clientY) / 2,
      size: Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY) || 1,
    };
  }

  released(event) {
    if (!this.fingers.delete(event.pointerId)) return;
    const isMeant = event.type === "pointerup";
    const isClick = isMeant && this.strayed < STRAY;
    this.grip?.drop(isMeant && !isClick);
    this.grip = null;
    if (isClick) this.pane.click(event);
  }
}
