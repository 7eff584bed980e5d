// Canvases: as sharp as the screen, and layers that keep what was drawn on them.

/** The context of a canvas made as sharp as the screen, in CSS pixels. */
function sized(canvas, { clientWidth: width, clientHeight: height } = canvas) {
  const ratio = window.devicePixelRatio || 1;
  const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  return { context, width, height };
}

/** Lay one canvas over another of its size, pixel on pixel. */
function overlay(context, canvas) {
  if (!canvas.width || !canvas.height) return;
  context.save();
  context.resetTransform();
  context.drawImage(canvas, 0, 0);
  context.restore();
}

/** A picture behind a canvas that is drawn anew only when what it depends on becomes another. */
class Layer {
  constructor() {
    this.canvas = document.createElement("canvas");
    this.causes = [];
  }

  /** Bring the picture up to date by `paint(context)`; the host tells its size. */
  draw(causes, host, paint) {
    const all = [...causes, host.clientWidth, host.clientHeight, window.devicePixelRatio];
    if (all.length === this.causes.length && all.every((one, k) => one === this.causes[k])) return;
    this.causes = all;
    const { context, width, height } = sized(this.canvas, host);
    context.clearRect(0, 0, width, height);
    paint(context);
  }
}

/** A layer of the map, which can be shown from where the camera has got to since. */
class MapLayer extends Layer {
  draw(causes, host, view, paint) {
    super.draw([...causes, view.wx(0), view.wy(0), view.scale], host, (context) => {
      paint(context);
      this.view = view;
    });
  }

  /** Whether it fills a map that is seen like this. */
  covers(view) {
    const { left, top, width, height } = this.place(view);
    return left <= 0 && top <= 0 && left + width >= view.width && top + height >= view.height;
  }

  show(context, view) {
    const { left, top, width, height } = this.place(view);
    context.drawImage(this.canvas, left, top, width, height);
  }

  place(view) {
    const grown = view.scale / this.view.scale;
    return {
      left: view.sx(this.view.wx(0)),
      top: view.sy(this.view.wy(0)),
      width: this.view.width * grown,
      height: this.view.height * grown,
    };
  }
}
