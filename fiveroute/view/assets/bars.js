// How each AUV spends its time: a bar an AUV, thin while it sails, thick while it collects.

const BAR_HEIGHT = 20;
const BAR_RIM = 30;

function drawBars(canvas, pane, end, t, theme) {
  const { scene, timeline } = pane;
  const count = timeline.legs.length;
  canvas.style.height = `${count * BAR_HEIGHT + 22}px`;
  const { context, width, height } = sized(canvas);
  context.clearRect(0, 0, width, height);
  const latest = Math.max(end, ...(scene.budgets || []));
  const x = (time) => BAR_RIM + ((width - BAR_RIM - 8) * time) / (latest || 1);
  timeline.legs.forEach((legs, auv) => {
    const y = (auv + 0.5) * BAR_HEIGHT;
    drawBar(context, legs, x, y, t, auvColour(theme, auv));
    drawLimits(context, scene, timeline.fates[auv], auv, x, y, theme);
  });
  context.font = "11px system-ui, sans-serif";
  context.textBaseline = "alphabetic";
  context.fillStyle = theme.quiet;
  context.textAlign = "left";
  context.fillText("0", x(0), height - 4);
  context.textAlign = "right";
  context.fillText(clock(latest), width - 8, height - 4);
  context.fillStyle = theme.ink;
  context.fillRect(x(t) - 0.75, 0, 1.5, count * BAR_HEIGHT);
}

/** The legs of one AUV, pale where they are still to come. */
function drawBar(context, legs, x, y, t, colour) {
  context.fillStyle = colour;
  for (const [, left, reached, done] of legs) {
    for (const [from, to, thick] of [
      [left, reached, 3],
      [reached, done, 11],
    ]) {
      if (to <= from) continue;
      const now = Math.min(Math.max(t, from), to);
      context.globalAlpha = 1;
      context.fillRect(
        x(from),
        y - thick / 2,
        now > from ? Math.max(x(now) - x(from), 1.5) : 0,
        thick,
      );
      context.globalAlpha = 0.35;
      context.fillRect(x(now), y - thick / 2, x(to) - x(now), thick);
    }
  }
  context.globalAlpha = 1;
}

/** The number of the AUV, its budget as a stroke, its failure as a cross. */
function drawLimits(context, scene, fate, auv, x, y, theme) {
  context.font = "600 12px system-ui, sans-serif";
  context.textAlign = "left";
  context.textBaseline = "middle";
  context.fillStyle = theme.ink;
  context.fillText(String(auv + 1), 6, y);
  if (scene.budgets) context.fillRect(x(scene.budgets[auv]) - 1, y - 8, 2, 16);
  if (fate.kind === "fail") drawCross(context, x(fate.t), y, 5, theme.alarm);
}
