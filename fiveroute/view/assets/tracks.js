// Where an AUV is when, and how much of its track must be drawn.

const STRETCH = 1024;

/** Positions and times along the legs of one AUV. */
function trackOf(legs, shapes, points) {
  const xs = [points[0]];
  const ys = [points[1]];
  const ts = [0];
  let tail = 0;
  for (const [head, left, reached, done, shape] of legs) {
    const [first, last] = shape < 0 ? [0, 2] : [shapes.first[shape], shapes.first[shape + 1]];
    for (let k = first; k < last; k += 1) {
      if (shape < 0) {
        const stop = k === 0 ? tail : head;
        xs.push(points[2 * stop]);
        ys.push(points[2 * stop + 1]);
        ts.push(k === 0 ? left : reached);
      } else {
        xs.push(shapes.points[3 * k]);
        ys.push(shapes.points[3 * k + 1]);
        ts.push(left + shapes.points[3 * k + 2] * (reached - left));
      }
    }
    if (done > reached) {
      xs.push(xs[xs.length - 1]);
      ys.push(ys[ys.length - 1]);
      ts.push(done);
    }
    tail = head;
  }
  const track = { x: Float64Array.from(xs), y: Float64Array.from(ys), t: Float64Array.from(ts) };
  return { ...track, weight: weights(track.x, track.y), levels: new Map() };
}

/** A track as it was sailed: x, y and t, one position after the other. */
function sailedTrack(table) {
  const part = (k) => Float64Array.from({ length: table.length / 3 }, (_, at) => table[3 * at + k]);
  const [x, y, t] = [part(0), part(1), part(2)];
  return { x, y, t, weight: weights(x, y), levels: new Map() };
}

/**
 * How far the track would be off if it were drawn without each point, in metres: the distance at
 * which Douglas and Peucker's (1973) method drops it, made to fall along each branch, so that
 * the points above any tolerance are a line of their own. Long tracks are cut into stretches,
 * whose ends are always drawn, so that no shape makes this slow.
 */
function weights(x, y) {
  const weight = new Float64Array(x.length);
  const spans = [];
  for (let first = 0; first < x.length; first += STRETCH) {
    const last = Math.min(first + STRETCH, x.length - 1);
    weight[first] = weight[last] = Infinity;
    spans.push([first, last, Infinity]);
  }
  while (spans.length) {
    const [first, last, most] = spans.pop();
    let far = -1;
    let at = -1;
    for (let k = first + 1; k < last; k += 1) {
      const away = distanceToLeg(x[k], y[k], x[first], y[first], x[last], y[last]);
      if (away > far) [far, at] = [away, k];
    }
    if (at < 0) continue;
    weight[at] = Math.min(far, most);
    spans.push([first, at, weight[at]], [at, last, weight[at]]);
  }
  return weight;
}

function distanceToLeg(x, y, x0, y0, x1, y1) {
  const [dx, dy] = [x1 - x0, y1 - y0];
  const squared = dx * dx + dy * dy;
  const share = squared ? Math.min(Math.max(((x - x0) * dx + (y - y0) * dy) / squared, 0), 1) : 0;
  return Math.hypot(x - x0 - share * dx, y - y0 - share * dy);
}

/** Numbers of the points that must be drawn so that nothing is off by more than the tolerance. */
function simplified(track, tolerance) {
  const level = Math.floor(Math.log2(Math.max(tolerance, 1e-9)));
  if (!track.levels.has(level)) {
    const kept = [];
    const least = 2 ** level;
    track.weight.forEach((weight, k) => {
      if (weight >= least) kept.push(k);
    });
    track.levels.set(level, Int32Array.from(kept));
  }
  return track.levels.get(level);
}

/** Position and heading at a time; before the beginning and after the end it lies still. */
function positionAt(track, t) {
  const after = countUpTo(track.t, t);
  if (after === 0) return { x: track.x[0], y: track.y[0], u: 0, v: 0, at: 0 };
  const k = after - 1;
  if (after === track.t.length)
    return { x: track.x[k], y: track.y[k], ...lastHeading(track, k), at: k };
  const span = track.t[after] - track.t[k];
  const share = span > 0 ? (t - track.t[k]) / span : 0;
  const [dx, dy] = [track.x[after] - track.x[k], track.y[after] - track.y[k]];
  const heading = dx || dy ? { u: dx, v: dy } : lastHeading(track, k);
  return { x: track.x[k] + share * dx, y: track.y[k] + share * dy, ...heading, at: k };
}

function lastHeading(track, from) {
  for (let k = from; k > 0; k -= 1) {
    const [u, v] = [track.x[k] - track.x[k - 1], track.y[k] - track.y[k - 1]];
    if (u || v) return { u, v };
  }
  return { u: 0, v: 1 };
}
