// What lies under everything that moves: the sea with the planned routes, and what has been sailed.

/**
 * Both are kept as pictures. While the camera moves over routes that take long to draw, the pictures
 * move with it, with hairlines where they do not reach, and they are drawn anew as soon as it rests.
 */
class Ground {
  constructor(host) {
    [this.host, this.planned, this.sailed] = [host, new MapLayer(), new MapLayer()];
  }

  /** Draw it up to a time; the answer is whether it is as sharp as can be. */
  draw(context, view, shown, isMoving) {
    const { scene, timeline, t } = shown;
    const tracks = [...timeline.tracks, ...timelineOf(scene, -1).tracks];
    const isOther = timeline !== this.timeline || t < this.time;
    const isSharp = !isMoving || isOther || !isLong(view, tracks);
    if (isSharp) this.drawSharp(context, view, shown);
    else this.drawMoved(context, view, shown);
    return isSharp;
  }

  drawSharp(context, view, { scene, timeline, theme, t, shows }) {
    const frame = scene.chart ? frameAt(scene.chart, t) : 0;
    const causes = [theme, timeline, frame, shows.arrows, shows.routes];
    this.planned.draw(causes, this.host, view, (canvas) => {
      drawSea(canvas, view, scene, theme, t, shows);
      if (shows.routes) drawPlanned(canvas, view, scene, theme, timeline.isRun);
    });
    this.sailed.draw([theme, timeline, t], this.host, view, (canvas) =>
      drawSailed(canvas, view, timeline, theme, t),
    );
    [this.timeline, this.time] = [timeline, t];
    overlay(context, this.planned.canvas);
    overlay(context, this.sailed.canvas);
  }

  drawMoved(context, view, { scene, timeline, theme, t, shows }) {
    if (!this.planned.covers(view)) {
      drawSea(context, view, scene, theme, t, shows);
      drawHairlines(context, view, timeline.tracks, theme);
    }
    this.planned.show(context, view);
    this.sailed.show(context, view);
    if (t > this.time) drawSailed(context, view, timeline, theme, t, this.time);
  }
}
