// Fields of a form. Each knows its text, and tells when another one was entered.

/** A number or nothing, as somebody typed it; throws what to do about anything else. */
function numberOf(text, name) {
  const trimmed = text.trim();
  if (!trimmed) return null;
  const value = Number(trimmed);
  if (!Number.isFinite(value)) throw new Error(`${name}: '${trimmed}' is no number`);
  return value;
}

/** One number, or several with commas between them, as a list. */
function numbersOf(text, name) {
  if (!text.includes(",")) return numberOf(text, name);
  return text.split(",").map((part) => {
    const value = numberOf(part, name);
    if (value === null) throw new Error(`${name}: a number is missing beside a comma`);
    return value;
  });
}

/** Names with commas between them, or nothing. */
function namesOf(text) {
  return text.trim() ? text.split(",").map((name) => name.trim()) : null;
}

function shownNumber(value) {
  if (value === null || value === undefined) return "";
  return Array.isArray(value) ? value.join(", ") : String(Number(value.toPrecision(12)));
}

class Field {
  constructor(id, name, { unit = "", hint = "", isText = false, onChange = null } = {}) {
    this.name = name;
    this.input = element("input", {
      id,
      type: "text",
      inputmode: isText ? "text" : "decimal",
      autocomplete: "off",
      spellcheck: "false",
      dir: isText ? "auto" : null,
      placeholder: hint,
    });
    const label = element("label", { for: id }, name);
    const tail = element("span", { class: "unit" }, unit);
    this.unit = tail;
    this.line = element("div", { class: "field" }, label, this.input, tail);
    if (onChange) this.input.addEventListener("change", onChange);
    this.input.addEventListener("keydown", (event) => {
      if (event.key === "Escape") this.restore();
    });
  }

  get text() {
    return this.input.value;
  }

  get number() {
    return numberOf(this.text, this.name);
  }

  show(text) {
    this.shown = text;
    this.input.value = text;
  }

  restore() {
    this.input.value = this.shown;
    this.input.blur();
  }
}

/** A choice among named values: { value: words }. */
function choiceOf(id, name, options, onChange) {
  const select = element("select", { id });
  for (const [value, words] of Object.entries(options))
    select.append(element("option", { value }, words));
  if (onChange) select.addEventListener("change", onChange);
  const line = element("div", { class: "field" }, element("label", { for: id }, name), select);
  return { select, line };
}

function button(id, words, onclick, attributes = {}) {
  return element("button", { id, type: "button", onclick, ...attributes }, words);
}
