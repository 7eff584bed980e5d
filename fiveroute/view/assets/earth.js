// Where on Earth the metres of a map lie: the planner's plane keeps distance and direction from its
// origin, so that the way back is the geodesic of that length and direction on the WGS84 ellipsoid,
// by Vincenty's series (1975), doi 10.1179/sre.1975.23.176.88.

const EQUATOR = 6378137;
const FLATTENING = 1 / 298.257223563;

/** Longitude and latitude in degrees of a point x metres east and y metres north of the origin. */
function onEarth([lon, lat], x, y) {
  const pole = EQUATOR * (1 - FLATTENING);
  const degree = Math.PI / 180;
  const way = Math.hypot(x, y);
  const [sine, cosine] = way ? [x / way, y / way] : [0, 1];
  const reduced = Math.atan((1 - FLATTENING) * Math.tan(lat * degree));
  const [sinU, cosU] = [Math.sin(reduced), Math.cos(reduced)];
  const first = Math.atan2(sinU, cosU * cosine);
  const crossing = cosU * sine;
  const square = 1 - crossing * crossing;
  const u = (square * (EQUATOR ** 2 - pole ** 2)) / pole ** 2;
  const a = 1 + (u / 16384) * (4096 + u * (-768 + u * (320 - 175 * u)));
  const b = (u / 1024) * (256 + u * (-128 + u * (74 - 47 * u)));
  let arc = way / (pole * a);
  for (let round = 0; round < 8; round += 1) {
    const c = Math.cos(2 * first + arc);
    const s = Math.sin(arc);
    const bend = (b / 6) * c * (4 * s * s - 3) * (4 * c * c - 3);
    arc = way / (pole * a) + b * s * (c + (b / 4) * (Math.cos(arc) * (2 * c * c - 1) - bend));
  }
  const [s, c] = [Math.sin(arc), Math.cos(arc)];
  const north = Math.atan2(
    sinU * c + cosU * s * cosine,
    (1 - FLATTENING) * Math.hypot(crossing, sinU * s - cosU * c * cosine),
  );
  const turned = Math.atan2(s * sine, cosU * c - sinU * s * cosine);
  const f = (FLATTENING / 16) * square * (4 + FLATTENING * (4 - 3 * square));
  const k = Math.cos(2 * first + arc);
  const slip = arc + f * s * (k + f * c * (2 * k * k - 1));
  const east = lon + (turned - (1 - f) * FLATTENING * crossing * slip) / degree;
  return [((east + 540) % 360) - 180, north / degree];
}

/** A position as people at sea read it, to a metre or so; null where the map is not on Earth. */
function placeText(scene, x, y) {
  if (!scene.origin) return null;
  const [lon, lat] = onEarth(scene.origin, x, y);
  const part = (value, letters) => `${Math.abs(value).toFixed(5)}° ${letters[value < 0 ? 1 : 0]}`;
  return `${part(lat, "NS")}, ${part(lon, "EW")}`;
}
