// Numbers as people read them.

/** Seconds as h:mm:ss. */
function clock(seconds) {
  const whole = Math.max(0, Math.round(seconds));
  const two = (value) => String(value).padStart(2, "0");
  return `${Math.floor(whole / 3600)}:${two(Math.floor(whole / 60) % 60)}:${two(whole % 60)}`;
}

/** A number with four significant digits, without trailing zeros. */
function amount(value) {
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-3) return value.toExponential(2);
  return String(Number(value.toPrecision(size >= 1000 ? 6 : 4)));
}

function percent(share) {
  return `${(100 * share).toFixed(1)} %`;
}

/** A length in metres or kilometres, or in the units of a benchmark file. */
function length(value, inMetres) {
  if (!inMetres) return amount(value);
  return Math.abs(value) >= 1000 ? `${amount(value / 1000)} km` : `${amount(value)} m`;
}

/** The largest of 1, 2, 5 times a power of ten that is at most `value`. */
function roundLength(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return [5, 2, 1].find((digit) => digit * power <= value * (1 + 1e-9)) * power;
}

const WINDS = ["N", "NE", "E", "SE", "S", "SW", "W", "NW"];

/** Where a velocity leads to, as a wind of the compass and degrees clockwise from north. */
function bearing(u, v) {
  const degrees = ((Math.atan2(u, v) * 180) / Math.PI + 360) % 360;
  return `${WINDS[Math.round(degrees / 45) % 8]} (${String(Math.round(degrees) % 360).padStart(3, "0")}°)`;
}

/** Number of sorted values that are at most `limit`. */
function countUpTo(values, limit, size = values.length) {
  let low = 0;
  let high = size;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (values[middle] <= limit) low = middle + 1;
    else high = middle;
  }
  return low;
}
