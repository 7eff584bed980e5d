// Routes on the map: faint as planned, bold as sailed.

/** Points beyond which routes are drawn with plain corners, and sharply only while the map rests. */
const MANY_POINTS = 2000;

/** Pixels that a drawn track may be off. */
const TOLERANCE = 0.4;

/** Whether the tracks take too long to be drawn in every frame of a movement. */
function isLong(view, tracks) {
  const points = tracks.map((track) => simplified(track, TOLERANCE / view.scale).length);
  return points.reduce((sum, count) => sum + count, 0) > MANY_POINTS;
}

/** Trace the part of a track between two points of time, where it is in sight, as a path. */
function traceTrack(context, view, track, until, since = -Infinity) {
  const rim = 40;
  const [right, bottom] = [view.width + rim, view.height + rim];
  let isDown = false;
  let px = NaN;
  let py = NaN;
  const to = ({ x, y }) => {
    const [sx, sy] = [view.sx(x), view.sy(y)];
    const isSeen =
      Math.min(sx, px) < right &&
      Math.max(sx, px) > -rim &&
      Math.min(sy, py) < bottom &&
      Math.max(sy, py) > -rim;
    if (isSeen) {
      if (!isDown) context.moveTo(px, py);
      context.lineTo(sx, sy);
    }
    [px, py, isDown] = [sx, sy, isSeen];
  };
  const at = (when) => to(positionAt(track, when));
  if (since > -Infinity) at(since);
  for (const k of simplified(track, TOLERANCE / view.scale)) {
    if (track.t[k] > until) break;
    if (track.t[k] >= since) to({ x: track.x[k], y: track.y[k] });
  }
  at(until);
}

/** Every AUV's planned route, faint, with a chevron in the middle of each longer leg. */
function drawPlanned(context, view, scene, theme, isDim) {
  const plan = timelineOf(scene, -1);
  const isCrowded = isLong(view, plan.tracks);
  plan.tracks.forEach((track, auv) => {
    const colour = auvColour(theme, auv);
    context.globalAlpha = isDim ? 0.45 : 0.75;
    context.setLineDash(isDim ? [2, 5] : auvDash(theme, auv));
    context.beginPath();
    traceTrack(context, view, track, Infinity);
    if (isDim) {
      context.strokeStyle = colour;
      context.lineWidth = 1.4;
      context.lineCap = "round";
      context.stroke();
    } else {
      strokeHaloed(context, colour, 1.5, theme.halo, isCrowded);
    }
    context.setLineDash([]);
    if (!isDim) drawChevrons(context, view, plan.legs[auv], track, colour);
  });
  context.globalAlpha = 1;
}

function drawChevrons(context, view, legs, track, colour) {
  context.fillStyle = colour;
  for (const [, left, reached] of legs) {
    const from = positionAt(track, left);
    const to = positionAt(track, reached);
    if (Math.hypot(to.x - from.x, to.y - from.y) * view.scale < 46) continue;
    const middle = positionAt(track, (left + reached) / 2);
    drawHead(context, view.sx(middle.x), view.sy(middle.y), Math.atan2(-middle.v, middle.u), 4.5);
  }
}

/** What has been sailed from one time to another, bold. */
function drawSailed(context, view, timeline, theme, until, since) {
  const isCrowded = isLong(view, timeline.tracks);
  timeline.tracks.forEach((track, auv) => {
    context.setLineDash(auvDash(theme, auv));
    context.beginPath();
    traceTrack(context, view, track, until, since);
    strokeHaloed(context, auvColour(theme, auv), 3, theme.halo, isCrowded);
    drawGuessed(context, view, timeline.guessed[auv], track, theme, until);
  });
  context.setLineDash([]);
}

/** Gaps in the straight lines that stand for ways nobody has told. */
function drawGuessed(context, view, spans, track, theme, t) {
  context.beginPath();
  for (const [left, reached] of spans) {
    if (left >= t) break;
    for (const [k, when] of [left, Math.min(reached, t)].entries()) {
      const { x, y } = positionAt(track, when);
      if (k) context.lineTo(view.sx(x), view.sy(y));
      else context.moveTo(view.sx(x), view.sy(y));
    }
  }
  context.setLineDash([5, 7]);
  context.lineCap = "butt";
  context.strokeStyle = theme.halo;
  context.lineWidth = 3.5;
  context.stroke();
}

/** Tracks as thin as the screen can draw them, which takes no time. */
function drawHairlines(context, view, tracks, theme) {
  context.lineWidth = 1 / (window.devicePixelRatio || 1);
  tracks.forEach((track, auv) => {
    context.beginPath();
    traceTrack(context, view, track, Infinity);
    context.strokeStyle = auvColour(theme, auv);
    context.stroke();
  });
}
