// Tables of AUVs and nodes, and the list of events. Text is only ever put in as text.

function element(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name === "class") node.className = value;
    else if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else if (value !== null && value !== undefined) node.setAttribute(name, String(value));
  }
  node.append(...children.filter((child) => child !== null));
  return node;
}

/** A swatch of an AUV's colour and dashes, drawn as SVG. */
function swatch(theme, auv) {
  const space = "http://www.w3.org/2000/svg";
  const image = document.createElementNS(space, "svg");
  image.setAttribute("viewBox", "0 0 26 8");
  image.setAttribute("class", "swatch");
  image.setAttribute("aria-hidden", "true");
  const line = document.createElementNS(space, "line");
  const set = { x1: 1, y1: 4, x2: 25, y2: 4, stroke: auvColour(theme, auv), "stroke-width": 4 };
  Object.entries(set).forEach(([name, value]) => line.setAttribute(name, value));
  const dash = auvDash(theme, auv);
  if (dash.length) line.setAttribute("stroke-dasharray", dash.join(" "));
  image.append(line);
  return image;
}

/** A table of any length of which only the rows in sight exist. */
class Table {
  /** columns: { name, value(row), show(row), isText, tip, width, most }; rows are numbers. What is shown
   * is a text, or { text, parts() } with elements that are made when the text changes. */
  constructor(host, caption, columns, rows, onPick) {
    Object.assign(this, { columns, onPick, rows: rows.slice(), marked: -1, pitch: 29 });
    this.order = { column: -1, sign: 1 };
    this.stop = rows[0];
    this.lines = new Map();
    this.heads = columns.map((column, k) => {
      const button = element(
        "button",
        { type: "button", onclick: () => this.sort(k), title: column.tip },
        column.name,
      );
      const head = element(
        "th",
        { scope: "col", "aria-sort": "none", class: column.isText ? "" : "number" },
        button,
      );
      if (column.width) head.style.width = column.width;
      return head;
    });
    this.body = element("tbody", { onkeydown: (event) => this.pressed(event) });
    const table = element(
      "table",
      { "aria-rowcount": rows.length + 1, class: columns[0].width ? "fixed" : "" },
      element("caption", { class: "unseen" }, caption),
      element("thead", {}, element("tr", { "aria-rowindex": 1 }, ...this.heads)),
      this.body,
    );
    this.space = element("div", {}, table);
    host.replaceChildren(this.space);
    this.scroller = host.closest("[role=tabpanel]");
    this.scroller.onscroll = () => this.update();
    this.update();
    if (!this.lines.size) return;
    this.pitch = this.body.rows[0].getBoundingClientRect().height || this.pitch;
    this.update();
  }

  /** Make the rows that are in sight, with a few around them, and put what has changed into them. */
  update() {
    const top = this.scroller.getBoundingClientRect().top - this.space.getBoundingClientRect().top;
    const room = Math.ceil(this.scroller.clientHeight / this.pitch) + 16;
    const last = Math.min(Math.max(Math.floor(top / this.pitch) - 8, 0) + room, this.rows.length);
    const first = Math.max(last - room, 0);
    this.space.style.paddingTop = `${first * this.pitch}px`;
    this.space.style.paddingBottom = `${(this.rows.length - last) * this.pitch}px`;
    const shown = this.rows.slice(first, last);
    this.drop(new Set(shown));
    const stop = shown.includes(this.stop) ? this.stop : shown[Math.min(8, shown.length - 1)];
    let next = this.body.firstChild;
    shown.forEach((row, k) => {
      const line = this.lines.get(row) || this.line(row);
      if (line === next) next = line.nextSibling;
      else this.body.insertBefore(line, next);
      line.setAttribute("aria-rowindex", String(first + k + 2));
      line.tabIndex = row === stop ? 0 : -1;
      line.classList.toggle("marked", row === this.marked);
      this.fill(row, line);
    });
  }

  /** Rows that are out of sight go; what is typed goes on to the panel. */
  drop(kept) {
    for (const [row, line] of this.lines) {
      if (kept.has(row)) continue;
      if (line === document.activeElement) this.scroller.focus({ preventScroll: true });
      line.remove();
      this.lines.delete(row);
    }
  }

  line(row) {
    const cells = this.columns.map((column) => {
      const cell = element("td", { class: column.isText ? "" : "number" });
      if (column.most) cell.style.maxWidth = column.most;
      return cell;
    });
    const line = element(
      "tr",
      {
        "data-row": row,
        onclick: () => this.onPick(row),
        onfocus: () => {
          this.stop = row;
        },
      },
      ...cells,
    );
    line.texts = [];
    this.lines.set(row, line);
    return line;
  }

  fill(row, line) {
    this.columns.forEach((column, k) => {
      const shown = column.show(row);
      const text = typeof shown === "string" ? shown : shown.text;
      if (line.texts[k] === text) return;
      line.texts[k] = text;
      const cell = line.cells[k];
      if (typeof shown === "string") cell.textContent = cell.title = text;
      else cell.replaceChildren(...shown.parts());
    });
  }

  /** Up and down go from row to row, Enter picks. */
  pressed(event) {
    const at = this.rows.indexOf(this.stop);
    const page = Math.max(Math.floor(this.scroller.clientHeight / this.pitch) - 2, 1);
    const to = {
      ArrowDown: at + 1,
      ArrowUp: at - 1,
      PageDown: at + page,
      PageUp: at - page,
      Home: 0,
      End: this.rows.length - 1,
    }[event.key];
    if (event.key === "Enter") this.onPick(this.stop);
    if (to === undefined || event.shiftKey) return;
    event.preventDefault();
    event.stopPropagation();
    this.stop = this.rows[Math.min(Math.max(to, 0), this.rows.length - 1)];
    this.reveal(this.stop);
    this.lines.get(this.stop).focus({ preventScroll: true });
  }

  mark(row) {
    const isNew = this.marked !== row;
    this.marked = row;
    if (isNew && this.rows.includes(row)) this.reveal(row);
    this.update();
  }

  /** Bring a row into sight, below the heads. */
  reveal(row) {
    const { scroller, pitch } = this;
    const box = scroller.getBoundingClientRect();
    const heads = this.heads[0].offsetHeight;
    const place = this.space.getBoundingClientRect().top - box.top + this.rows.indexOf(row) * pitch;
    if (place < 0) scroller.scrollTop += place;
    else if (place + heads + pitch > scroller.clientHeight)
      scroller.scrollTop += place + heads + pitch - scroller.clientHeight;
    this.update();
  }

  sort(column) {
    const sign = this.order.column === column ? -this.order.sign : 1;
    this.order = { column, sign };
    const { value } = this.columns[column];
    const keys = new Map(this.rows.map((row) => [row, value(row)]));
    this.rows.sort((a, b) => sign * compareValues(keys.get(a), keys.get(b)) || a - b);
    this.heads.forEach((head, k) => {
      head.setAttribute("aria-sort", k !== column ? "none" : sign > 0 ? "ascending" : "descending");
    });
    this.update();
  }
}

const WORDS = new Intl.Collator("en", { numeric: true });

function compareValues(a, b) {
  if (typeof a === "string") return WORDS.compare(a, b);
  return a === b ? 0 : a < b ? -1 : 1;
}

function fleetTable(host, pane, theme, onPick) {
  const { scene } = pane;
  const now = (auv) => doingAt(scene, pane.timeline, auv, pane.t);
  const done = (auv) => pane.timeline.fates[auv];
  const data = (auv) => pane.dataOf(auv);
  const used = (auv) => (done(auv).kind === "arrive" ? done(auv).t : NaN);
  const budget = (auv) => (scene.budgets ? scene.budgets[auv] : Infinity);
  return new Table(
    host,
    "AUVs",
    [
      {
        name: "AUV",
        isText: true,
        value: (auv) => auv,
        show: (auv) => ({
          text: `${auv} ${theme.water}`,
          parts: () => [swatch(theme, auv), ` ${auv + 1}`],
        }),
      },
      {
        name: "Now",
        isText: true,
        most: "7.5em",
        value: (auv) => now(auv).doing,
        show: (auv) =>
          `${DOING[now(auv).doing]}${now(auv).node ? ` ${scene.ids[now(auv).node - 1]}` : ""}`,
      },
      {
        name: "Nodes",
        value: (auv) => data(auv).count,
        show: (auv) => `${data(auv).count}/${scene.routes[auv].length}`,
        tip: "Collected so far, of those planned",
      },
      {
        name: "Data",
        value: (auv) => data(auv).sum,
        show: (auv) => amount(data(auv).sum),
        tip: "Collected so far",
      },
      {
        name: "Home",
        value: used,
        show: (auv) => homeText(done(auv), budget(auv)),
        tip: "When it reaches the destination",
      },
      {
        name: "Budget",
        value: budget,
        show: (auv) => (Number.isFinite(budget(auv)) ? clock(budget(auv)) : "none"),
        tip: "Endurance",
      },
    ],
    scene.routes.map((_, auv) => auv),
    onPick,
  );
}

const DOING = {
  "sailing to": "to",
  "going home": "to home",
  collecting: "at",
  "under way": "under way",
  home: "home",
  failed: "failed",
};

function homeText(fate, budget) {
  if (fate.kind !== "arrive") return "never";
  return fate.t > budget * (1 + 1e-9) + 0.5 ? `${clock(fate.t)} late` : clock(fate.t);
}

function nodeTable(host, pane, theme, onPick) {
  const { scene } = pane;
  const now = (row) => stateAt(pane.timeline.changes[row - 1], pane.t);
  const final = (row) =>
    pane.timeline.changes[row - 1].find((change) => change.state === "collected");
  return new Table(
    host,
    "Nodes",
    [
      {
        name: "Node",
        isText: true,
        width: "23%",
        value: (row) => scene.ids[row - 1],
        show: (row) => scene.ids[row - 1],
      },
      {
        name: "Data",
        width: "13%",
        value: (row) => scene.data[row - 1],
        show: (row) => amount(scene.data[row - 1]),
      },
      {
        name: "State",
        isText: true,
        width: "27%",
        value: (row) => now(row).state,
        show: (row) => STATES[now(row).state],
      },
      {
        name: "AUV",
        isText: true,
        width: "16%",
        value: (row) => now(row).auv,
        show: (row) => {
          const { auv } = now(row);
          return auv < 0
            ? ""
            : { text: `${auv} ${theme.water}`, parts: () => [swatch(theme, auv), ` ${auv + 1}`] };
        },
      },
      {
        name: "Collected",
        value: (row) => (final(row) ? final(row).t : Infinity),
        show: (row) => (final(row) ? clock(final(row).t) : "never"),
      },
    ],
    scene.ids.map((_, k) => k + 1),
    onPick,
  );
}

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
