// What the pointer is told about an AUV, a node or the water under it, a line each.

function auvLines({ scene, timeline, t }, { count, sum }, auv) {
  const { doing, node } = doingAt(scene, timeline, auv, t);
  const now = positionAt(timeline.tracks[auv], t);
  return [
    `AUV ${auv + 1}`,
    `${doing}${node ? ` ${scene.ids[node - 1]}` : ""}`,
    `${count} nodes, ${amount(sum)} data so far`,
    placeText(scene, now.x, now.y),
  ];
}

function nodeLines({ scene, timeline, t }, node) {
  const change = stateAt(timeline.changes[node - 1], t);
  const who = change.auv < 0 ? "" : `, AUV ${change.auv + 1}`;
  const when = change.t > 0 ? ` at ${clock(change.t)}` : "";
  const depth = scene.depths[node - 1];
  const deep = depth === null ? "" : `, ${amount(depth)} m deep`;
  return [
    scene.ids[node - 1],
    `data ${amount(scene.data[node - 1])}, service ${amount(scene.service[node - 1])} s${deep}`,
    `${STATES[change.state]}${who}${when}`,
    placeText(scene, scene.points[2 * node], scene.points[2 * node + 1]),
  ];
}

function seaLines({ scene, t }, x, y) {
  const { chart, metres } = scene;
  const east = `${length(Math.abs(x), metres)} ${x < 0 ? "west" : "east"}`;
  const north = `${length(Math.abs(y), metres)} ${y < 0 ? "south" : "north"}`;
  const what = maskAt(chart, x, y);
  const velocity = chart && !what ? velocityAt(chart, x, y, t) : null;
  const speed = velocity && `${Math.hypot(...velocity).toFixed(2)} m/s`;
  return [
    placeText(scene, x, y),
    `${east}, ${north}`,
    what ? (what === LAND ? "land" : "no data") : null,
    velocity ? `current ${speed} to ${bearing(...velocity)}` : null,
  ];
}
