// Names of nodes: beside them, where they hide neither each other nor another node.

/** Nodes in sight beyond which no names are shown. */
const MANY_NAMES = 120;

const NAME_HEIGHT = 12;

/** Half the size of start and destination. */
const END_SIZE = 10;

/** Names of the nodes in sight, if they are few. */
function drawNames(context, view, scene, theme) {
  const nodes = nodesInSight(view, scene);
  if (!nodes) return;
  context.font = "11px system-ui, sans-serif";
  context.textAlign = "left";
  context.textBaseline = "middle";
  const last = scene.points.length - 2;
  const ends = [0, last].map((k) => [view.sx(scene.points[k]), view.sy(scene.points[k + 1])]);
  const named = nodes.map((node) => {
    const text = scene.ids[node.vertex - 1].slice(0, 24);
    return { ...node, text, width: context.measureText(text).width };
  });
  for (const [text, [left, top]] of placedNames(named, ends))
    haloedText(context, text, left, top + NAME_HEIGHT / 2, theme.quiet, theme.halo);
}

/** Names with their boxes; a name that would hide another one is left out. */
function placedNames(nodes, ends) {
  const marks = nodes.map(({ x, y, radius }) => boxAround(x, y, radius));
  marks.push(...ends.map(([x, y]) => boxAround(x, y, END_SIZE)));
  const taken = [];
  return nodes.flatMap(({ x, y, radius, text, width }) => {
    const places = placesBeside(x, y, radius, width);
    const hidesNo = (others) => (box) => !others.some((other) => isOver(box, other));
    const box = places.find(hidesNo([...marks, ...taken])) || places.find(hidesNo(taken));
    if (!box) return [];
    taken.push(box);
    return [[text, box]];
  });
}

/** The nodes in sight, in pixels; null if they are many. */
function nodesInSight(view, scene) {
  const nodes = [];
  for (let node = 1; node <= scene.ids.length; node += 1) {
    const [x, y] = [view.sx(scene.points[2 * node]), view.sy(scene.points[2 * node + 1])];
    if (!(x > 0 && y > 0 && x < view.width && y < view.height)) continue;
    if (nodes.length === MANY_NAMES) return null;
    nodes.push({ x, y, vertex: node, radius: nodeRadius(scene, node, view) });
  }
  return nodes;
}

/** Boxes [left, top, right, bottom] to the right, the left, above and below, the best first. */
function placesBeside(x, y, radius, width) {
  const away = radius + 3;
  const half = NAME_HEIGHT / 2;
  const corners = [
    [x + away, y - half],
    [x - away - width, y - half],
    [x - width / 2, y - away - NAME_HEIGHT],
    [x - width / 2, y + away],
  ];
  return corners.map(([left, top]) => [left, top, left + width, top + NAME_HEIGHT]);
}

function boxAround(x, y, radius) {
  return [x - radius, y - radius, x + radius, y + radius];
}

function isOver(one, other) {
  return one[0] < other[2] && other[0] < one[2] && one[1] < other[3] && other[1] < one[3];
}
