// The list of events.

const ROW_HEIGHT = 27;

/** A list of any length of which only the rows in sight exist. */
class EventList {
  constructor(host, onPick) {
    this.host = host;
    this.space = element("div", { class: "events-space" });
    host.replaceChildren(this.space);
    host.addEventListener("scroll", () => this.draw());
    this.onPick = onPick;
    this.shown = [];
  }

  show(scene, timeline, theme, kinds) {
    Object.assign(this, { scene, theme, timeline });
    this.shown = timeline.events.filter((event) => kinds.has(event.kind));
    this.times = Float64Array.from(this.shown, (event) => event.t);
    this.space.style.height = `${Math.max(this.shown.length, 1) * ROW_HEIGHT}px`;
    this.now = -1;
    this.first = -1;
    this.draw();
  }

  /** Mark the last event and bring it into sight. */
  at(t) {
    const now = countUpTo(this.times, t) - 1;
    if (now === this.now) return;
    this.now = now;
    const room = this.host.clientHeight;
    if (room) this.host.scrollTop = Math.max(0, now * ROW_HEIGHT - room / 2);
    this.draw();
  }

  draw() {
    const first = Math.max(0, Math.floor(this.host.scrollTop / ROW_HEIGHT) - 4);
    const count = Math.ceil(this.host.clientHeight / ROW_HEIGHT) + 8;
    const rows = this.shown
      .slice(first, first + count)
      .map((event, k) => this.row(event, first + k));
    this.space.replaceChildren(...rows);
    if (!this.shown.length) this.space.textContent = "Nothing of this kind happens.";
  }

  row(event, k) {
    const isLost = event.kind === "send" && event.message?.lost.length;
    const row = element(
      "button",
      {
        type: "button",
        class: `event${k === this.now ? " now" : k < this.now ? "" : " later"}${isLost ? " lost" : ""}`,
        title: sentence(this.scene, event),
        onclick: () => this.onPick(event),
      },
      element("time", {}, clock(event.t)),
      swatch(this.theme, event.auv),
      element("bdi", {}, sentence(this.scene, event)),
    );
    row.style.top = `${k * ROW_HEIGHT}px`;
    return row;
  }
}
