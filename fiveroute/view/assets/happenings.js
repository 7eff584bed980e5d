// What happens on the map, for a moment: rings and words where it happens.

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

