// The sea on a canvas: speed of the current as an image, arrows, land, obstacles.

/** The speed at one time as an image, a pixel a grid point, north up. */
function speedImage(chart, theme, frame) {
  const key = `${frame} ${theme.water}`;
  if (chart.images.has(key)) return chart.images.get(key);
  const { rows, columns, uv } = chart;
  const image = new ImageData(columns, rows);
  const shades = Array.from({ length: 256 }, (_, k) => rampColour(theme.ramp, k / 255));
  for (let i = 0; i < rows; i += 1) {
    for (let j = 0; j < columns; j += 1) {
      const at = 2 * ((frame * rows + i) * columns + j);
      const shade =
        shades[Math.min(Math.round((Math.hypot(uv[at], uv[at + 1]) * 255) / 32767), 255)];
      image.data.set([...shade, 255], 4 * ((rows - 1 - i) * columns + j));
    }
  }
  return kept(chart, key, image);
}

/** Land and missing data of a mask as an image. */
function maskImage(chart, theme) {
  const key = `mask ${theme.water}`;
  if (chart.images.has(key)) return chart.images.get(key);
  const { rows, columns, codes } = chart.mask;
  const image = new ImageData(columns, rows);
  const [land, missing] = [parseHex(theme.land), parseHex(theme.noData)];
  for (let i = 0; i < rows; i += 1) {
    for (let j = 0; j < columns; j += 1) {
      const code = codes[i * columns + j];
      if (!code) continue;
      const colour = code === LAND ? [...land, 255] : [...missing, 255];
      image.data.set(colour, 4 * ((rows - 1 - i) * columns + j));
    }
  }
  return kept(chart, key, image);
}

function kept(chart, key, image) {
  const canvas = document.createElement("canvas");
  canvas.width = image.width;
  canvas.height = image.height;
  canvas.getContext("2d").putImageData(image, 0, 0);
  chart.images.set(key, canvas);
  return canvas;
}

function drawGrid(context, view, image, grid, isSmooth) {
  const half = grid.step / 2;
  const west = view.sx(grid.west - half);
  const north = view.sy(grid.south + (grid.rows - 1) * grid.step + half);
  const size = grid.step * view.scale;
  context.imageSmoothingEnabled = isSmooth;
  context.imageSmoothingQuality = "high";
  context.drawImage(image, west, north, grid.columns * size, grid.rows * size);
}

/** Arrows at fixed places of the sea, so that they do not swim when the map is panned. */
function drawArrows(context, view, chart, theme, t) {
  const spacing = 2 ** Math.ceil(Math.log2(34 / view.scale));
  const longest = 0.8 * spacing * view.scale;
  const first = [view.wx(0), view.wy(view.height)].map(
    (value) => Math.floor(value / spacing) * spacing,
  );
  context.strokeStyle = context.fillStyle = theme.arrow;
  context.lineWidth = 1.2;
  context.lineCap = "round";
  context.beginPath();
  for (let x = first[0]; x <= view.wx(view.width) + spacing; x += spacing) {
    for (let y = first[1]; y <= view.wy(0) + spacing; y += spacing) {
      const velocity = velocityAt(chart, x, y, t);
      if (!velocity || maskAt(chart, x, y)) continue;
      const factor = longest / (chart.fastest || 1);
      arrow(context, view.sx(x), view.sy(y), velocity[0] * factor, -velocity[1] * factor);
    }
  }
  context.stroke();
}

/** An arrow centred at (x, y) along (dx, dy). */
function arrow(context, x, y, dx, dy) {
  const size = Math.hypot(dx, dy);
  if (size < 1.5) {
    context.moveTo(x + 0.7, y);
    context.arc(x, y, 0.7, 0, 2 * Math.PI);
    return;
  }
  const [tx, ty] = [x + dx / 2, y + dy / 2];
  const head = Math.min(0.4 * size, 6) / size;
  context.moveTo(x - dx / 2, y - dy / 2);
  context.lineTo(tx, ty);
  context.lineTo(tx - head * (dx + 0.55 * dy), ty - head * (dy - 0.55 * dx));
  context.moveTo(tx, ty);
  context.lineTo(tx - head * (dx - 0.55 * dy), ty - head * (dy + 0.55 * dx));
}

function drawBarriers(context, view, barriers, theme) {
  for (const barrier of barriers) {
    context.beginPath();
    if (barrier.circle) {
      const [x, y, radius] = barrier.circle;
      context.arc(view.sx(x), view.sy(y), Math.max(radius * view.scale, 1), 0, 2 * Math.PI);
    } else {
      for (let k = 0; k < barrier.polygon.length; k += 2) {
        context.lineTo(view.sx(barrier.polygon[k]), view.sy(barrier.polygon[k + 1]));
      }
      context.closePath();
    }
    context.fillStyle = barrier.kind === "land" ? theme.land : theme.obstacle;
    context.strokeStyle = theme.coast;
    context.lineWidth = 1.2;
    context.setLineDash(barrier.kind === "land" ? [] : [5, 3]);
    context.fill();
    context.stroke();
  }
  context.setLineDash([]);
}

/** The sea without anything that moves but the current. */
function drawSea(context, view, scene, theme, t, shows) {
  context.fillStyle = theme.water;
  context.fillRect(0, 0, view.width, view.height);
  const { chart } = scene;
  if (chart) {
    drawGrid(context, view, speedImage(chart, theme, frameAt(chart, t)), chart, true);
    if (chart.mask) drawGrid(context, view, maskImage(chart, theme), chart.mask, false);
    if (shows.arrows) drawArrows(context, view, chart, theme, t);
  }
  drawBarriers(context, view, scene.barriers, theme);
}
