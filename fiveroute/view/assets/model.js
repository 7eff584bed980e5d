// The page's data: scenes, each with its plan and runs as timelines that can be played.

const LAND = 1;
const NO_DATA = 2;

function bytesOf(text) {
  return Uint8Array.from(atob(text), (sign) => sign.charCodeAt(0)).buffer;
}

/** A scene of the document with its arrays unpacked. */
function unpackScene(raw) {
  const shapes = { first: raw.shapes.first, points: new Float32Array(bytesOf(raw.shapes.points)) };
  const scene = { ...raw, shapes, most: Math.max(...raw.data, 1e-12), cache: new Map() };
  if (raw.chart) {
    scene.chart = { ...raw.chart, uv: new Int16Array(bytesOf(raw.chart.uv)), images: new Map() };
    if (raw.chart.mask) {
      const codes = new Uint8Array(bytesOf(raw.chart.mask.codes));
      scene.chart.mask = { ...raw.chart.mask, codes };
    }
  }
  return scene;
}

/** The plan (run -1) or one of the runs of a scene, made once. */
function timelineOf(scene, run) {
  if (!scene.cache.has(run)) {
    scene.cache.set(run, run < 0 ? planTimeline(scene) : runTimeline(scene, scene.runs[run]));
  }
  return scene.cache.get(run);
}

function planTimeline(scene) {
  const events = [];
  const home = scene.ids.length + 1;
  scene.legs.forEach((legs, auv) => {
    events.push({ t: 0, auv, kind: "depart", node: 0 });
    for (const [head, , , done] of legs) {
      if (head === home) events.push({ t: done, auv, kind: "arrive", node: 0 });
      else events.push({ t: done, auv, kind: "collect", node: head });
    }
  });
  events.sort((a, b) => a.t - b.t);
  return finished(scene, scene.label || "plan as filed", scene.legs, events, false);
}

function runTimeline(scene, run) {
  const events = run.t.map((t, k) => ({
    t,
    auv: run.auv[k],
    kind: run.kind[k],
    node: run.node[k],
    message: run.messages[run.message[k]] || null,
  }));
  return finished(scene, `run ${run.run}`, run.legs, events, true, run.tracks);
}

function finished(scene, label, legs, events, isRun, sailed) {
  const tracks = legs.map((own, auv) => {
    const known = sailed ? new Float32Array(bytesOf(sailed[auv])) : [];
    return known.length ? sailedTrack(known) : trackOf(own, scene.shapes, scene.points);
  });
  const { changes, collected } = historyOf(scene, events);
  const isKnown = (auv) => !isRun || (sailed && bytesOf(sailed[auv]).byteLength > 0);
  const guessed = legs.map((own, auv) => (isKnown(auv) ? [] : guessedLegs(scene, own)));
  const times = Float64Array.from(events, (event) => event.t);
  const turns = Float64Array.from(changes.flat(), (change) => change.t).sort();
  const ends = tracks.map((track) => track.t[track.t.length - 1]);
  const end = Math.max(...ends, times.length ? times[times.length - 1] : 0, 0);
  const fates = scene.legs.map((_, auv) => fateOf(events, auv));
  const history = { events, times, changes, turns, collected };
  return { label, legs, tracks, guessed, ...history, end, fates, isRun };
}

/** When an AUV leaves for and reaches the legs of which only the ends are known. */
function guessedLegs(scene, legs) {
  const hasPaths = scene.shapes.first.length > 1;
  return legs.filter((leg) => hasPaths && leg[4] < 0).map(([, left, reached]) => [left, reached]);
}

/** How an AUV's mission ended. */
function fateOf(events, auv) {
  const own = events.filter((event) => event.auv === auv);
  const failed = own.find((event) => event.kind === "fail");
  if (failed) return { kind: "fail", t: failed.t };
  const home = own.find((event) => event.kind === "arrive");
  return home ? { kind: "arrive", t: home.t } : { kind: "unknown", t: Infinity };
}

/** Velocity of the water in m/s at a position and time, bilinear; null beyond the chart. */
function velocityAt(chart, x, y, t) {
  const column = (x - chart.west) / chart.step;
  const row = (y - chart.south) / chart.step;
  const { rows, columns } = chart;
  if (!(column >= 0 && row >= 0 && column <= columns - 1 && row <= rows - 1)) return null;
  const [j, i] = [Math.min(Math.floor(column), columns - 2), Math.min(Math.floor(row), rows - 2)];
  const [a, b] = [column - j, row - i];
  const base = frameAt(chart, t) * rows * columns * 2;
  const unit = chart.fastest / 32767;
  const part = (k) => {
    const at = base + 2 * (i * columns + j) + k;
    const south = chart.uv[at] * (1 - a) + chart.uv[at + 2] * a;
    const north = chart.uv[at + 2 * columns] * (1 - a) + chart.uv[at + 2 * columns + 2] * a;
    return unit * (south * (1 - b) + north * b);
  };
  return [part(0), part(1)];
}

/** Number of the chart's time that is nearest. */
function frameAt(chart, t) {
  const after = countUpTo(chart.times, t);
  if (after === 0) return 0;
  if (after === chart.times.length) return after - 1;
  return t - chart.times[after - 1] < chart.times[after] - t ? after - 1 : after;
}

/** What the mask has at a position: 0 for water, or where there is no mask. */
function maskAt(chart, x, y) {
  const mask = chart && chart.mask;
  if (!mask) return 0;
  const column = Math.round((x - mask.west) / mask.step);
  const row = Math.round((y - mask.south) / mask.step);
  const isInside = column >= 0 && row >= 0 && column < mask.columns && row < mask.rows;
  return isInside ? mask.codes[row * mask.columns + column] : NO_DATA;
}
