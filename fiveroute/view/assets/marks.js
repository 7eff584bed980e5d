// What stands out on the map: marks, labels, start and destination, AUVs.

/** Stroke the path of the context on a halo; where there is much of it, with plain corners. */
function strokeHaloed(context, colour, width, halo, isCrowded = false) {
  context.lineJoin = isCrowded ? "bevel" : "round";
  context.lineCap = isCrowded ? "butt" : "round";
  const dash = context.getLineDash();
  context.setLineDash([]);
  context.strokeStyle = halo;
  context.lineWidth = width + 2.5;
  context.stroke();
  context.setLineDash(dash);
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.stroke();
}

function haloedText(context, text, x, y, colour, halo) {
  context.lineJoin = "round";
  context.strokeStyle = halo;
  context.lineWidth = 3;
  context.strokeText(text, x, y);
  context.fillStyle = colour;
  context.fillText(text, x, y);
}

function label(context, text, x, y, theme, alpha) {
  context.globalAlpha = alpha;
  context.font = "600 12px system-ui, sans-serif";
  context.textAlign = "center";
  context.textBaseline = "middle";
  haloedText(context, text, x, y, theme.ink, theme.halo);
  context.globalAlpha = 1;
}

/** A triangle that points along an angle on the screen. */
function drawHead(context, x, y, angle, size) {
  context.beginPath();
  for (const [turn, reach] of [
    [0, 1.3],
    [2.5, 1],
    [-2.5, 1],
  ]) {
    context.lineTo(
      x + reach * size * Math.cos(angle + turn),
      y + reach * size * Math.sin(angle + turn),
    );
  }
  context.closePath();
  context.fill();
}

function drawCross(context, x, y, reach, colour) {
  context.beginPath();
  context.moveTo(x - reach, y - reach);
  context.lineTo(x + reach, y + reach);
  context.moveTo(x + reach, y - reach);
  context.lineTo(x - reach, y + reach);
  context.strokeStyle = colour;
  context.lineWidth = 3;
  context.stroke();
}

function drawRing(context, x, y, radius, colour, width, alpha) {
  context.beginPath();
  context.arc(x, y, Math.max(radius, 0.1), 0, 2 * Math.PI);
  context.globalAlpha = alpha;
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.stroke();
  context.globalAlpha = 1;
}

/** Start: a triangle; destination: a star; both black on their halo. */
function drawEnds(context, view, scene, theme) {
  const last = scene.points.length - 2;
  const place = (k) => [view.sx(scene.points[k]), view.sy(scene.points[k + 1])];
  const shapes = [
    [place(0), 3, 0, 10],
    [place(last), 5, 0.45, 11],
  ];
  for (const [[x, y], corners, inner, size] of shapes) {
    context.beginPath();
    const count = inner ? 2 * corners : corners;
    for (let k = 0; k < count; k += 1) {
      const reach = inner && k % 2 ? inner * size : size;
      const angle = -Math.PI / 2 + (2 * Math.PI * k) / count;
      context.lineTo(x + reach * Math.cos(angle), y + reach * Math.sin(angle));
    }
    context.closePath();
    context.lineJoin = "round";
    context.strokeStyle = theme.halo;
    context.lineWidth = 4;
    context.stroke();
    context.fillStyle = theme.ink;
    context.fill();
  }
}

/** AUVs that are not home yet, each with its number where that hides no other's. */
function drawAuvs(context, view, timeline, theme, t, marked) {
  const numbers = [];
  timeline.tracks.forEach((track, auv) => {
    const { kind, t: end } = timeline.fates[auv];
    const isOver = t >= end;
    if (isOver && kind === "arrive") return;
    const now = positionAt(track, t);
    const [x, y] = [view.sx(now.x), view.sy(now.y)];
    const angle = Math.atan2(-now.v, now.u);
    if (marked === auv) drawRing(context, x, y, 17, theme.ink, 2, 1);
    drawAuv(context, x, y, angle, auvColour(theme, auv), theme);
    if (isOver) drawCross(context, x, y, 11, theme.alarm);
    const place = [x - 15 * Math.cos(angle), y - 15 * Math.sin(angle)];
    if (numbers.some(([px, py]) => Math.hypot(place[0] - px, place[1] - py) < 13)) return;
    numbers.push(place);
    label(context, String(auv + 1), ...place, theme, 1);
  });
}

function drawAuv(context, x, y, angle, colour, theme) {
  context.lineJoin = "round";
  context.strokeStyle = theme.halo;
  context.lineWidth = 5;
  context.fillStyle = colour;
  drawHead(context, x, y, angle, 9);
  context.stroke();
  context.fill();
  context.strokeStyle = theme.ink;
  context.lineWidth = 1.3;
  context.stroke();
}
