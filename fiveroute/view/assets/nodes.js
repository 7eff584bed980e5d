// Nodes on the map: what has become of each.

/** Pixels of the screen between the sizes that nodes are drawn in. */
const SIZE_STEP = 0.5;

function nodeRadius(scene, node, view) {
  const shrink = Math.min(1, Math.max(0.25, 9 / Math.sqrt(scene.ids.length + 1)));
  const zoom = Math.min(1.6, Math.max(1, (view.scale / view.least) ** 0.3));
  return (3.2 + 6.8 * Math.sqrt(scene.data[node - 1] / scene.most)) * shrink * zoom;
}

/** Planned: a ring; collected: filled; dropped: a cross in a dashed ring; idle: half; not planned: dots. */
function drawNode(context, x, y, radius, state, colour, theme) {
  const isGrey = state === "unplanned" || state === "idle";
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.fillStyle = state === "collected" ? colour : theme.paper;
  context.globalAlpha = state === "unplanned" ? 0.75 : 1;
  context.fill();
  context.lineWidth = state === "collected" ? 1.2 : 2;
  context.strokeStyle = state === "collected" ? theme.halo : isGrey ? theme.quiet : colour;
  context.setLineDash({ dropped: [3, 2.5], unplanned: [1.5, 2.5] }[state] || []);
  context.stroke();
  context.setLineDash([]);
  if (state === "dropped") {
    const reach = 0.5 * radius;
    context.beginPath();
    context.moveTo(x - reach, y - reach);
    context.lineTo(x + reach, y + reach);
    context.moveTo(x + reach, y - reach);
    context.lineTo(x - reach, y + reach);
    context.stroke();
  } else if (state === "idle") {
    context.beginPath();
    context.arc(x, y, Math.max(radius - 1, 0), Math.PI / 4, (5 * Math.PI) / 4);
    context.fillStyle = theme.quiet;
    context.fill();
  }
  context.globalAlpha = 1;
}

/** Pictures of nodes, drawn once for every state, colour and size. */
class NodeStamps {
  constructor(theme, ratio) {
    Object.assign(this, { theme, ratio, stamps: new Map() });
    const canvas = document.createElement("canvas");
    this.context = canvas.getContext("2d", { willReadFrequently: true });
  }

  /** The picture of a node of so many steps in size: a square of pixels. */
  of({ state, auv }, steps) {
    const { auvs } = this.theme;
    const colour = auv < 0 ? auvs.length : auv % auvs.length;
    const key = (steps * (auvs.length + 1) + colour) * STATE_NAMES.length + STATE_NAMES.indexOf(state);
    if (!this.stamps.has(key)) this.stamps.set(key, this.drawn(state, auvs[colour], steps));
    return this.stamps.get(key);
  }

  drawn(state, colour, steps) {
    const { context, ratio, theme } = this;
    const radius = (steps * SIZE_STEP) / ratio;
    const size = 2 * Math.ceil((radius + 1.5) * ratio) + 1;
    context.canvas.width = context.canvas.height = size;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    const middle = size / 2 / ratio;
    drawNode(context, middle, middle, radius, state, colour || theme.quiet, theme);
    const { data } = context.getImageData(0, 0, size, size);
    return { size, pixels: new Uint32Array(data.buffer) };
  }
}

const STATE_NAMES = Object.keys(STATES);

/**
 * All nodes as one picture. A canvas takes a hundred times as long to draw a circle as it takes to copy
 * its pixels, so that ten thousand nodes can be drawn in every frame.
 */
class NodeLayer extends MapLayer {
  /** Bring the picture up to a time. */
  draw(host, view, { scene, timeline, theme, t }, isEdited) {
    const count = countUpTo(timeline.turns, t);
    // what is edited moves without a trace, and NaN is never what it was
    const causes = [theme, timeline, count, isEdited ? NaN : 0];
    super.draw(causes, host, view, (context) => {
      const { width, height } = context.canvas;
      const ratio = width / view.width;
      this.prepare(width, height, ratio, theme);
      this.paint(view, scene, timeline, t, ratio);
      context.putImageData(this.image, 0, 0);
    });
  }

  prepare(width, height, ratio, theme) {
    if (this.image?.width !== width || this.image.height !== height) {
      this.image = new ImageData(width, height);
      this.pixels = new Uint32Array(this.image.data.buffer);
    }
    this.pixels.fill(0);
    if (this.stamps?.theme !== theme || this.stamps.ratio !== ratio)
      this.stamps = new NodeStamps(theme, ratio);
  }

  paint(view, scene, timeline, t, ratio) {
    const { width, height } = this.image;
    const picture = { width, height, pixels: this.pixels };
    for (let node = 1; node <= scene.ids.length; node += 1) {
      const x = Math.floor(view.sx(scene.points[2 * node]) * ratio);
      const y = Math.floor(view.sy(scene.points[2 * node + 1]) * ratio);
      const steps = Math.round((nodeRadius(scene, node, view) * ratio) / SIZE_STEP);
      const far = steps + 4 * ratio;
      if (x < -far || y < -far || x > width + far || y > height + far) continue;
      stamp(picture, this.stamps.of(stateAt(timeline.changes[node - 1], t), steps), x, y);
    }
  }
}

/** Lay a square of pixels over a picture, its middle at (x, y). */
function stamp({ width, height, pixels }, { size, pixels: own }, x, y) {
  const [left, top] = [x - (size >> 1), y - (size >> 1)];
  const [first, last] = [Math.max(0, -left), Math.min(size, width - left)];
  const bottom = Math.min(size, height - top);
  for (let row = Math.max(0, -top); row < bottom; row += 1) {
    const from = row * size;
    const to = (top + row) * width + left;
    for (let column = first; column < last; column += 1) {
      const over = own[from + column];
      const under = pixels[to + column];
      if (over) pixels[to + column] = under && over >>> 24 < 255 ? blended(over, under) : over;
    }
  }
}

/** One pixel over another; red, green, blue and opacity are their bytes from the lowest on. */
function blended(over, under) {
  const alpha = over >>> 24;
  const whole = alpha + ((under >>> 24) * (255 - alpha)) / 255;
  const share = alpha / whole;
  const mixed = (shift) => {
    const low = (under >>> shift) & 255;
    return Math.floor(low + share * (((over >>> shift) & 255) - low) + 0.5) << shift;
  };
  return (((whole + 0.5) << 24) | mixed(16) | mixed(8) | mixed(0)) >>> 0;
}
