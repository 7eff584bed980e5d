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

class Table {
  /** columns: { name, value(row), show(row), isText, tip }; rows are numbers. What is shown is a
   * text, or { text, parts() } with elements that are made when the text changes. */
  constructor(host, caption, columns, rows, onPick) {
    this.columns = columns;
    this.rows = rows.slice();
    this.order = { column: -1, sign: 1 };
    this.cells = new Map();
    this.heads = columns.map((column, k) => {
      const button = element(
        "button",
        { type: "button", onclick: () => this.sort(k), title: column.tip },
        column.name,
      );
      return element(
        "th",
        { scope: "col", "aria-sort": "none", class: column.isText ? "" : "number" },
        button,
      );
    });
    this.body = element("tbody");
    for (const row of rows) this.body.append(this.line(row, onPick));
    const table = element(
      "table",
      {},
      element("caption", { class: "unseen" }, caption),
      element("thead", {}, element("tr", {}, ...this.heads)),
      this.body,
    );
    host.replaceChildren(table);
    this.update();
  }

  line(row, onPick) {
    const cells = this.columns.map((column) =>
      element("td", { class: column.isText ? "" : "number" }),
    );
    cells.texts = [];
    this.cells.set(row, cells);
    const pick = () => onPick(row);
    const keyed = (event) => {
      if (event.key === "Enter") pick();
    };
    return element(
      "tr",
      { tabindex: 0, "data-row": row, onclick: pick, onkeydown: keyed },
      ...cells,
    );
  }

  /** Put what has changed into the cells. */
  update() {
    for (const [row, cells] of this.cells) {
      this.columns.forEach((column, k) => {
        const shown = column.show(row);
        const text = typeof shown === "string" ? shown : shown.text;
        if (cells.texts[k] === text) return;
        cells.texts[k] = text;
        if (typeof shown === "string") cells[k].textContent = text;
        else cells[k].replaceChildren(...shown.parts());
      });
    }
  }

  mark(row) {
    for (const line of this.body.rows) {
      line.classList.toggle("marked", Number(line.dataset.row) === row);
    }
  }

  sort(column) {
    const sign = this.order.column === column ? -this.order.sign : 1;
    this.order = { column, sign };
    const { value } = this.columns[column];
    const keys = new Map(this.rows.map((row) => [row, value(row)]));
    const sorted = this.rows
      .slice()
      .sort((a, b) => sign * compareValues(keys.get(a), keys.get(b)) || a - b);
    const lines = new Map([...this.body.rows].map((line) => [Number(line.dataset.row), line]));
    this.body.append(...sorted.map((row) => lines.get(row)));
    this.heads.forEach((head, k) => {
      head.setAttribute("aria-sort", k !== column ? "none" : sign > 0 ? "ascending" : "descending");
    });
  }
}

function compareValues(a, b) {
  if (typeof a === "string") return a.localeCompare(b, "en", { numeric: true });
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
        value: (row) => scene.ids[row - 1],
        show: (row) => scene.ids[row - 1],
      },
      {
        name: "Data",
        value: (row) => scene.data[row - 1],
        show: (row) => amount(scene.data[row - 1]),
      },
      {
        name: "State",
        isText: true,
        value: (row) => now(row).state,
        show: (row) => STATES[now(row).state],
      },
      {
        name: "AUV",
        isText: true,
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
