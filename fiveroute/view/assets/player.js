// The clock of the mission: plays, stops, and can be set.

const SPEEDS = [1, 5, 10, 30, 60, 120, 300, 600, 1200, 3000, 6000];

class Player {
  constructor(onTick, onState) {
    Object.assign(this, { onTick, onState, t: 0, end: 1, speed: 300, isPlaying: false, last: 0 });
  }

  /** As fast as shows the whole mission in about forty seconds. */
  suit(end) {
    this.end = end;
    this.speed = SPEEDS.findLast((speed) => speed * 40 <= end) || SPEEDS[0];
  }

  toggle() {
    if (this.isPlaying) {
      this.pause();
      return;
    }
    if (this.t >= this.end) this.t = 0;
    this.isPlaying = true;
    this.last = performance.now();
    this.onState();
    requestAnimationFrame((now) => this.tick(now));
  }

  pause() {
    this.isPlaying = false;
    this.onState();
  }

  tick(now) {
    if (!this.isPlaying) return;
    const passed = Math.min(Math.max(now - this.last, 0), 200) / 1000;
    this.last = now;
    this.t = Math.min(this.t + passed * this.speed, this.end);
    this.onTick();
    if (this.t >= this.end) this.pause();
    else requestAnimationFrame((next) => this.tick(next));
  }

  set(t) {
    this.t = Math.min(Math.max(t, 0), this.end);
    this.onTick();
  }

  faster(steps) {
    const k = SPEEDS.indexOf(this.speed) + steps;
    this.speed = SPEEDS[Math.min(Math.max(k, 0), SPEEDS.length - 1)];
    this.onState();
  }
}
