// Messages between AUVs: a line to each who hears one, a broken one to each who does not.

/** Messages of the last moment; they fade over `life` seconds of the mission. */
function drawLinks(context, view, timeline, theme, t, { life, kinds, isCalm }) {
  if (!kinds.has("send")) return;
  for (let k = countUpTo(timeline.times, t) - 1; k >= 0 && timeline.times[k] > t - life; k -= 1) {
    const { kind, message } = timeline.events[k];
    if (kind !== "send" || !message) continue;
    const fade = isCalm ? 0.9 : 1 - ((t - message.sent) / life) ** 2;
    drawMessage(context, view, timeline, theme, message, fade);
  }
}

function drawMessage(context, view, timeline, theme, message, fade) {
  const place = (auv, at) => {
    const { x, y } = positionAt(timeline.tracks[auv], at);
    return [view.sx(x), view.sy(y)];
  };
  const from = place(message.sender, message.sent);
  const colour = auvColour(theme, message.sender);
  context.globalAlpha = fade;
  for (const [auv, at] of message.heard) drawHeard(context, from, place(auv, at), colour, theme);
  for (const auv of message.lost) drawLost(context, from, place(auv, message.sent), theme);
  context.globalAlpha = 1;
  const only = message.receiver === null ? null : place(message.receiver, message.sent);
  const [x, y] = only ? between(from, only, 0.4) : [from[0], from[1] - 24];
  label(context, message.says, x, y, theme, fade);
}

function between([x0, y0], [x1, y1], share) {
  return [x0 + share * (x1 - x0), y0 + share * (y1 - y0)];
}

function traceLine(context, from, to) {
  context.beginPath();
  context.moveTo(...from);
  context.lineTo(...to);
}

/** A line with a head a little before the AUV that hears. */
function drawHeard(context, from, to, colour, theme) {
  const reach = Math.hypot(to[0] - from[0], to[1] - from[1]);
  if (reach < 1) return;
  const tip = between(from, to, Math.max(0, 1 - 15 / reach));
  traceLine(context, from, tip);
  strokeHaloed(context, colour, 1.8, theme.halo);
  context.fillStyle = colour;
  drawHead(context, ...tip, Math.atan2(to[1] - from[1], to[0] - from[0]), 6);
}

/** A dashed line in the colour of alarm that ends half-way in a cross. */
function drawLost(context, from, to, theme) {
  const end = between(from, to, 0.6);
  if (Math.hypot(end[0] - from[0], end[1] - from[1]) < 1) return;
  traceLine(context, from, end);
  context.setLineDash([5, 5]);
  strokeHaloed(context, theme.alarm, 1.8, theme.halo);
  context.setLineDash([]);
  drawCross(context, ...end, 6, theme.alarm);
}
