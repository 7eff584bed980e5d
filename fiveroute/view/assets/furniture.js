// What every map has: scale bar, north, and the ramp of the current.

/** Scale bar, north, and the ramp of the current's speed. */
function drawFurniture(context, view, scene, theme) {
  const bar = roundLength(110 / view.scale);
  const [x, y] = [16, view.height - 16];
  context.font = "12px system-ui, sans-serif";
  context.textAlign = "left";
  context.textBaseline = "alphabetic";
  context.beginPath();
  context.moveTo(x, y - 5);
  context.lineTo(x, y);
  context.lineTo(x + bar * view.scale, y);
  context.lineTo(x + bar * view.scale, y - 5);
  context.lineCap = "butt";
  context.lineJoin = "miter";
  context.strokeStyle = theme.halo;
  context.lineWidth = 4.5;
  context.stroke();
  context.strokeStyle = theme.ink;
  context.lineWidth = 1.6;
  context.stroke();
  haloedText(context, length(bar, scene.metres), x + 3, y - 7, theme.ink, theme.halo);
  context.fillStyle = theme.ink;
  context.strokeStyle = theme.halo;
  drawHead(context, view.width - 22, 24, -Math.PI / 2, 7);
  context.textAlign = "center";
  haloedText(context, "N", view.width - 22, 46, theme.ink, theme.halo);
  if (scene.chart) drawRamp(context, view, scene.chart, theme);
}

function drawRamp(context, view, chart, theme) {
  const [wide, x, y] = [100, view.width - 174, view.height - 24];
  const ramp = context.createLinearGradient(x, 0, x + wide, 0);
  theme.ramp.forEach((colour, k) =>
    ramp.addColorStop(k / (theme.ramp.length - 1), `rgb(${colour})`),
  );
  context.fillStyle = ramp;
  context.fillRect(x, y, wide, 8);
  context.strokeStyle = theme.quiet;
  context.lineWidth = 1;
  context.strokeRect(x - 0.5, y - 0.5, wide + 1, 9);
  context.textAlign = "right";
  haloedText(context, "current 0", x - 6, y + 8, theme.ink, theme.halo);
  haloedText(
    context,
    `${chart.fastest.toFixed(2)} m/s`,
    view.width - 12,
    y + 8,
    theme.ink,
    theme.halo,
  );
}
