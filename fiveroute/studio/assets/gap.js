// How far the plan can be from optimal: a bar of all data, and how it came about.

/** Words and shares of the bar: collected, open up to the bound, out of reach. */
function gapShares(objective, bound, total) {
  const whole = total > 0 ? total : 1;
  const collected = Math.min((objective || 0) / whole, 1);
  const most = bound === null ? 1 : Math.min(Math.max(bound / whole, collected), 1);
  return { collected, open: most - collected, most };
}

function gapWords(gap, status) {
  if (gap === null || gap === undefined) return "unknown";
  return status === "optimal" ? "0 (proved)" : percent(gap);
}

/** Seconds of a search that are worth a picture of its course. */
const SHORTEST = 0.5;

class GapView {
  constructor() {
    this.value = element("output", { id: "gap-now" }, "unknown");
    this.filled = element("div", { class: "filled" });
    this.open = element("div", { class: "open" });
    this.bar = element("div", { class: "gap-bar", role: "img" }, this.filled, this.open);
    this.words = element("p", { class: "hint", id: "gap-words" });
    this.canvas = element("canvas", { class: "gap-course", "aria-hidden": "true" });
    this.box = element(
      "div",
      { class: "gap" },
      element("div", { class: "gap-head" }, element("span", {}, "Gap to the optimum"), this.value),
      this.bar,
      this.words,
      this.canvas,
    );
  }

  show({ objective, bound, gap, total, status }) {
    const shares = gapShares(objective, bound, total);
    this.value.textContent = gapWords(gap, status);
    this.filled.style.width = `${100 * shares.collected}%`;
    this.open.style.width = `${100 * shares.open}%`;
    const most = bound === null ? "no bound yet" : `no plan can collect more than ${amount(bound)}`;
    const has = objective === null ? "nothing planned yet" : `${amount(objective)} planned`;
    this.words.textContent = `${has} of ${amount(total)}; ${most}.`;
    this.bar.setAttribute("aria-label", this.words.textContent);
  }

  /** Data of the best plan and the bound over the seconds of the search, from its first plan on. */
  drawCourse(job, total, theme) {
    const points = job ? job.points : [];
    const first = points.find((point) => point[1] !== null);
    const [begin, end] = first ? [first[0], job.seconds] : [0, 0];
    this.canvas.hidden = points.length < 2 || end - begin < SHORTEST;
    if (this.canvas.hidden) return;
    const { context, width, height } = sized(this.canvas);
    context.clearRect(0, 0, width, height);
    const known = points.map((point) => point[1]).filter((value) => value !== null);
    const low = known.length ? Math.min(...known) : 0;
    const high = Math.max(total, low + 1e-9);
    const x = (seconds) => 4 + ((width - 8) * Math.max(seconds - begin, 0)) / (end - begin);
    const y = (value) => height - 16 - ((height - 24) * (value - low)) / (high - low);
    drawSteps(context, points, 2, end, x, y, theme.quiet, [4, 3]);
    drawSteps(context, points, 1, end, x, y, auvColour(theme, 0), []);
    context.font = "11px system-ui, sans-serif";
    context.fillStyle = theme.quiet;
    context.textAlign = "right";
    context.fillText(`${begin.toFixed(1)} to ${end.toFixed(1)} s`, width - 4, height - 3);
    context.textAlign = "left";
    context.fillText("— best plan   - - bound", 4, height - 3);
  }
}

/** A staircase of one column of the points. */
function drawSteps(context, points, column, end, x, y, colour, dash) {
  context.beginPath();
  let last = null;
  for (const point of points) {
    if (point[column] === null) continue;
    if (last === null) context.moveTo(x(point[0]), y(point[column]));
    else {
      context.lineTo(x(point[0]), y(last));
      context.lineTo(x(point[0]), y(point[column]));
    }
    last = point[column];
  }
  if (last !== null) context.lineTo(x(end), y(last));
  context.setLineDash(dash);
  context.lineWidth = 1.8;
  context.strokeStyle = colour;
  context.stroke();
  context.setLineDash([]);
}
