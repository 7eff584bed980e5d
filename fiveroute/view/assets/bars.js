// How each AUV spends its time: a bar an AUV, thin while it sails, thick while it collects.

const BAR_HEIGHT = 20;
const BAR_RIM = 30;

/** Bars as one picture: pale where they are still to come, full up to now. */
class Bars {
  constructor(canvas) {
    [this.canvas, this.layer] = [canvas, new Layer()];
  }

  draw({ scene, timeline }, end, t, theme) {
    const rows = timeline.legs.length * BAR_HEIGHT;
    this.canvas.style.height = `${rows + 22}px`;
    const { context, width, height } = sized(this.canvas);
    const latest = Math.max(end, ...(scene.budgets || []));
    const x = (time) => BAR_RIM + ((width - BAR_RIM - 8) * time) / (latest || 1);
    const causes = [theme, latest, timeline];
    this.layer.draw(causes, this.canvas, (picture) => drawBars(picture, timeline, x, theme));
    context.clearRect(0, 0, width, height);
    context.globalAlpha = 0.35;
    overlay(context, this.layer.canvas);
    context.globalAlpha = 1;
    context.save();
    context.beginPath();
    context.rect(0, 0, x(t), height);
    context.clip();
    overlay(context, this.layer.canvas);
    context.restore();
    timeline.fates.forEach((fate, auv) => drawLimits(context, scene, fate, auv, x, theme));
    drawScale(context, [x(0), width - 8], rows + 18, latest, theme);
    context.fillStyle = theme.ink;
    context.fillRect(x(t) - 0.75, 0, 1.5, rows);
  }
}

function drawBars(context, { legs }, x, theme) {
  legs.forEach((own, auv) => {
    const y = (auv + 0.5) * BAR_HEIGHT;
    context.fillStyle = auvColour(theme, auv);
    for (const [, left, reached, done] of own) {
      context.fillRect(x(left), y - 1.5, x(reached) - x(left), 3);
      if (done > reached)
        context.fillRect(x(reached), y - 5.5, Math.max(x(done) - x(reached), 1.5), 11);
    }
  });
}

/** The number of the AUV, its budget as a stroke, its failure as a cross. */
function drawLimits(context, scene, fate, auv, x, theme) {
  const y = (auv + 0.5) * BAR_HEIGHT;
  context.font = "600 12px system-ui, sans-serif";
  context.textAlign = "left";
  context.textBaseline = "middle";
  context.fillStyle = theme.ink;
  context.fillText(String(auv + 1), 6, y);
  if (scene.budgets) context.fillRect(x(scene.budgets[auv]) - 1, y - 8, 2, 16);
  if (fate.kind === "fail") drawCross(context, x(fate.t), y, 5, theme.alarm);
}

function drawScale(context, [left, right], y, latest, theme) {
  context.font = "11px system-ui, sans-serif";
  context.textBaseline = "alphabetic";
  context.fillStyle = theme.quiet;
  context.textAlign = "left";
  context.fillText("0", left, y);
  context.textAlign = "right";
  context.fillText(clock(latest), right, y);
}
