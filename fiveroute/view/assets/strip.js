// Over the slider: how much data is collected as time goes by, and marks where things happen.

const STRIP_RIM = 8;

class Strip {
  constructor(canvas) {
    [this.canvas, this.layer] = [canvas, new Layer()];
  }

  draw(panes, end, t, theme) {
    const { context, width, height } = sized(this.canvas);
    const x = (time) => STRIP_RIM + ((width - 2 * STRIP_RIM) * time) / (end || 1);
    const causes = [theme, end, ...panes.map((pane) => pane.timeline)];
    this.layer.draw(causes, this.canvas, (picture) => drawCurves(picture, panes, x, height, theme));
    context.clearRect(0, 0, width, height);
    overlay(context, this.layer.canvas);
    context.fillStyle = theme.ink;
    context.fillRect(x(t) - 0.75, 0, 1.5, height);
  }
}

function drawCurves(context, panes, x, height, theme) {
  const most = Math.max(
    ...panes.map((pane) => Math.max(pane.scene.bound || 0, pane.scene.objective)),
    1e-12,
  );
  const y = (data) => height - 4 - (height - 10) * Math.min(data / most, 1);
  panes.forEach(({ timeline }, k) => {
    traceSteps(context, timeline, x, y);
    context.strokeStyle = theme.ink;
    context.setLineDash(k ? [4, 3] : []);
    context.lineWidth = 1.6;
    context.stroke();
    if (panes.length === 1) {
      context.lineTo(x(timeline.end), y(0));
      context.lineTo(x(0), y(0));
      context.globalAlpha = 0.1;
      context.fillStyle = theme.ink;
      context.fill();
      context.globalAlpha = 1;
    }
    drawMarks(context, timeline, x, height, theme);
  });
}

function traceSteps(context, { collected, end }, x, y) {
  context.beginPath();
  context.moveTo(x(0), y(0));
  collected.t.forEach((time, step) => {
    context.lineTo(x(time), y(step ? collected.data[step - 1] : 0));
    context.lineTo(x(time), y(collected.data[step]));
  });
  context.lineTo(x(end), y(collected.data[collected.data.length - 1]));
}

const MARKED = new Set(["discard", "pick_up", "fail"]);

function drawMarks(context, timeline, x, height, theme) {
  for (const { t, auv, kind } of timeline.events) {
    if (!MARKED.has(kind)) continue;
    const [top, colour] =
      kind === "fail" ? [0, theme.alarm] : [height - 4, auvColour(theme, auv)];
    context.fillStyle = colour;
    context.fillRect(x(t) - 1, top, 2, height - top);
  }
}
