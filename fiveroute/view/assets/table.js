// A table that is sorted, walked through by keys, and as long as one likes.

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
