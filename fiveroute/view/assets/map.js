// Tracks, nodes, AUVs and events on a canvas.

/** Trace the part of a track between two points of time as a path of the context. */
function traceTrack(context, view, track, until, tolerance = 0.4) {
  const points = simplified(track, tolerance / view.scale);
  const rim = 40;
  let wasIn = false;
  let px = 0;
  let py = 0;
  let isFirst = true;
  const to = (x, y) => {
    const [sx, sy] = [view.sx(x), view.sy(y)];
    const isIn = sx > -rim && sy > -rim && sx < view.width + rim && sy < view.height + rim;
    const crosses =
      Math.min(sx, px) < view.width + rim &&
      Math.max(sx, px) > -rim &&
      Math.min(sy, py) < view.height + rim &&
      Math.max(sy, py) > -rim;
    if (!isFirst && (isIn || wasIn || crosses)) {
      if (!wasIn) context.moveTo(px, py);
      context.lineTo(sx, sy);
      wasIn = true;
    } else {
      wasIn = false;
    }
    [px, py, isFirst] = [sx, sy, false];
  };
  for (const k of points) {
    if (track.t[k] > until) break;
    to(track.x[k], track.y[k]);
  }
  const now = positionAt(track, until);
  to(now.x, now.y);
}

function strokeHaloed(context, colour, width, halo) {
  context.lineJoin = context.lineCap = "round";
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

/** Every AUV's planned route, faint, with a chevron in the middle of each longer leg. */
function drawPlanned(context, view, scene, theme, isDim) {
  const plan = timelineOf(scene, -1);
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
      strokeHaloed(context, colour, 1.5, theme.halo);
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

/** What has been sailed so far, bold. */
function drawSailed(context, view, timeline, theme, t) {
  timeline.tracks.forEach((track, auv) => {
    context.setLineDash(auvDash(theme, auv));
    context.beginPath();
    traceTrack(context, view, track, t);
    strokeHaloed(context, auvColour(theme, auv), 3, theme.halo);
    drawGuessed(context, view, timeline.guessed[auv], track, theme, t);
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

function nodeRadius(scene, node, view) {
  const shrink = Math.min(1, Math.max(0.25, 9 / Math.sqrt(scene.ids.length + 1)));
  const zoom = Math.min(1.6, Math.max(1, (view.scale / view.least) ** 0.3));
  return (3.2 + 6.8 * Math.sqrt(scene.data[node - 1] / scene.most)) * shrink * zoom;
}

/**
 * Nodes on a layer of their own, of which only those are drawn again whose state has changed since:
 * thousands of them are too many for every frame.
 */
class NodeLayer {
  constructor() {
    this.canvas = document.createElement("canvas");
    this.key = "";
  }

  /** Bring the layer up to a time; another key or none, or an earlier time, begins anew. */
  draw({ width, height }, key, view, scene, timeline, theme, t) {
    const context = this.canvas.getContext("2d");
    if (!key || key !== this.key || t < this.t) {
      [this.canvas.width, this.canvas.height] = [width, height];
      context.setTransform(width / view.width, 0, 0, height / view.height, 0, 0);
      [this.key, this.shown] = [key, new Array(scene.ids.length + 1)];
    }
    this.t = t;
    for (let node = 1; node <= scene.ids.length; node += 1) {
      const change = stateAt(timeline.changes[node - 1], t);
      const before = this.shown[node];
      if (change === before) continue;
      this.shown[node] = change;
      const [x, y] = [view.sx(scene.points[2 * node]), view.sy(scene.points[2 * node + 1])];
      if (x < -20 || y < -20 || x > view.width + 20 || y > view.height + 20) continue;
      const colour = change.auv < 0 ? theme.quiet : auvColour(theme, change.auv);
      const radius = nodeRadius(scene, node, view);
      if (before) wipe(context, x, y, radius + 1.5);
      drawNode(context, x, y, radius, change.state, colour, theme);
    }
  }
}

function wipe(context, x, y, radius) {
  context.globalCompositeOperation = "destination-out";
  context.fillStyle = "#000";
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.fill();
  context.globalCompositeOperation = "source-over";
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
    context.arc(x, y, radius - 1, Math.PI / 4, (5 * Math.PI) / 4);
    context.fillStyle = theme.quiet;
    context.fill();
  }
  context.globalAlpha = 1;
}

/** Names of the nodes in sight, if they are few; none over another. */
function drawNames(context, view, scene, theme) {
  const inSight = [];
  for (let node = 1; node <= scene.ids.length; node += 1) {
    const [x, y] = [view.sx(scene.points[2 * node]), view.sy(scene.points[2 * node + 1])];
    if (x > 0 && y > 0 && x < view.width && y < view.height) inSight.push([x, y, node]);
    if (inSight.length > 120) return;
  }
  context.font = "11px system-ui, sans-serif";
  context.textAlign = "left";
  context.textBaseline = "middle";
  const taken = [];
  for (const [x, y, node] of inSight) {
    const text = scene.ids[node - 1].slice(0, 24);
    const left = x + nodeRadius(scene, node, view) + 3;
    const box = [left, y - 6, left + context.measureText(text).width, y + 6];
    if (
      taken.some((one) => box[0] < one[2] && one[0] < box[2] && box[1] < one[3] && one[1] < box[3])
    )
      continue;
    taken.push(box);
    haloedText(context, text, left, y, theme.quiet, theme.halo);
  }
}

function haloedText(context, text, x, y, colour, halo) {
  context.lineJoin = "round";
  context.strokeStyle = halo;
  context.lineWidth = 3;
  context.strokeText(text, x, y);
  context.fillStyle = colour;
  context.fillText(text, x, y);
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

function drawAuvs(context, view, timeline, theme, t, marked) {
  timeline.tracks.forEach((track, auv) => {
    const now = positionAt(track, t);
    const [x, y] = [view.sx(now.x), view.sy(now.y)];
    const fate = timeline.fates[auv];
    const isOver = t >= fate.t;
    if (isOver && fate.kind === "arrive") return;
    if (marked === auv) drawRing(context, x, y, 17, theme.ink, 2, 1);
    context.strokeStyle = theme.halo;
    context.lineWidth = 5;
    context.lineJoin = "round";
    const angle = Math.atan2(-now.v, now.u);
    context.fillStyle = auvColour(theme, auv);
    drawHead(context, x, y, angle, 9);
    context.stroke();
    context.fill();
    context.strokeStyle = theme.ink;
    context.lineWidth = 1.3;
    context.stroke();
    if (isOver) drawCross(context, x, y, 11, theme.alarm);
    context.font = "600 12px system-ui, sans-serif";
    context.textAlign = "center";
    context.textBaseline = "middle";
    haloedText(
      context,
      String(auv + 1),
      x - 15 * Math.cos(angle),
      y - 15 * Math.sin(angle),
      theme.ink,
      theme.halo,
    );
  });
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

/** Events of the last moment: each grows or shrinks and fades over `life` seconds of the mission. */
function drawEvents(context, view, scene, timeline, theme, t, { life, kinds, isCalm }) {
  for (let k = countUpTo(timeline.times, t) - 1; k >= 0 && timeline.times[k] > t - life; k -= 1) {
    const event = timeline.events[k];
    if (!kinds.has(event.kind)) continue;
    const age = isCalm ? 0.3 : (t - event.t) / life;
    const place = event.node
      ? { x: scene.points[2 * event.node], y: scene.points[2 * event.node + 1] }
      : positionAt(timeline.tracks[event.auv], event.t);
    drawEvent(context, view.sx(place.x), view.sy(place.y), event, age, theme);
  }
}

function drawEvent(context, x, y, event, age, theme) {
  const colour = auvColour(theme, event.auv);
  const fade = 1 - age;
  if (event.kind === "send") {
    for (const lag of [0, 0.25]) {
      if (age >= lag) drawRing(context, x, y, 10 + 46 * (age - lag), colour, 2, 0.8 * fade);
    }
  } else if (event.kind === "receive") {
    drawRing(context, x, y, 20 - 10 * age, colour, 1.5, 0.6 * fade);
  } else if (event.kind === "collect") {
    drawRing(context, x, y, 8 + 16 * age, colour, 4 * fade + 0.5, fade);
  } else if (event.kind === "fail") {
    drawRing(context, x, y, 10 + 60 * age, theme.alarm, 5, fade);
  } else if (event.kind === "manoeuvre") {
    label(context, "avoids", x, y - 18 - 8 * age, theme, fade);
  } else if (event.kind === "discard" || event.kind === "pick_up") {
    drawRing(
      context,
      x,
      y,
      event.kind === "discard" ? 12 + 12 * age : 26 - 14 * age,
      colour,
      3,
      fade,
    );
    label(
      context,
      event.kind === "discard" ? "dropped" : `to AUV ${event.auv + 1}`,
      x,
      y - 18 - 10 * age,
      theme,
      fade,
    );
  }
}

function label(context, text, x, y, theme, alpha) {
  context.globalAlpha = alpha;
  context.font = "600 12px system-ui, sans-serif";
  context.textAlign = "center";
  context.textBaseline = "middle";
  haloedText(context, text, x, y, theme.ink, theme.halo);
  context.globalAlpha = 1;
}

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
