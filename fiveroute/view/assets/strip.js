// Over the slider: how much data is collected as time goes by, and marks where things happen.

const STRIP_RIM = 8;

function drawStrip(canvas, panes, end, t, theme) {
  const { context, width, height } = sized(canvas);
  context.clearRect(0, 0, width, height);
  const most = Math.max(
    ...panes.map((pane) => Math.max(pane.scene.bound || 0, pane.scene.objective)),
    1e-12,
  );
  const x = (time) => STRIP_RIM + ((width - 2 * STRIP_RIM) * time) / (end || 1);
  const y = (data) => height - 4 - (height - 10) * Math.min(data / most, 1);
  panes.forEach((pane, k) => {
    const { collected } = pane.timeline;
    context.beginPath();
    context.moveTo(x(0), y(0));
    collected.t.forEach((time, step) => {
      context.lineTo(x(time), y(step ? collected.data[step - 1] : 0));
      context.lineTo(x(time), y(collected.data[step]));
    });
    context.lineTo(x(pane.timeline.end), y(collected.data[collected.data.length - 1]));
    context.strokeStyle = theme.ink;
    context.setLineDash(k ? [4, 3] : []);
    context.lineWidth = 1.6;
    context.stroke();
    if (panes.length === 1) {
      context.lineTo(x(pane.timeline.end), y(0));
      context.lineTo(x(0), y(0));
      context.globalAlpha = 0.1;
      context.fillStyle = theme.ink;
      context.fill();
      context.globalAlpha = 1;
    }
    drawMarks(context, pane.timeline, x, height, theme);
  });
  context.setLineDash([]);
  context.fillStyle = theme.ink;
  context.fillRect(x(t) - 0.75, 0, 1.5, height);
}

const MARKED = new Set(["discard", "pick_up", "fail"]);

function drawMarks(context, timeline, x, height, theme) {
  for (const event of timeline.events) {
    if (!MARKED.has(event.kind)) continue;
    context.fillStyle = event.kind === "fail" ? theme.alarm : auvColour(theme, event.auv);
    context.fillRect(
      x(event.t) - 1,
      event.kind === "fail" ? 0 : height - 4,
      2,
      event.kind === "fail" ? height : 4,
    );
  }
}

/** The context of a canvas made as sharp as the screen, in CSS pixels. */
function sized(canvas) {
  const ratio = window.devicePixelRatio || 1;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  return { context, width, height };
}
