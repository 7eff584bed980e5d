// The key: what the marks mean, and what is to be seen.

function showKey(host, app) {
  const { theme, shows } = app;
  const marks = Object.entries(STATES).map(([state, name]) => {
    const canvas = element("canvas", { class: "mark", "aria-hidden": "true" });
    requestAnimationFrame(() => {
      const { context } = sized(canvas);
      const isOwned = state === "planned" || state === "collected" || state === "dropped";
      drawNode(context, 13, 13, 8, state, isOwned ? auvColour(theme, 0) : theme.quiet, theme);
    });
    return element(
      "div",
      {},
      element("dt", {}, canvas),
      element("dd", {}, `${name}: ${MEANING[state]}`),
    );
  });
  const fleet = app.active.scene.routes.map((_, auv) =>
    element("div", {}, element("dt", {}, swatch(theme, auv)), element("dd", {}, `AUV ${auv + 1}`)),
  );
  const switches = Object.entries(SWITCHES).map(([name, words]) => {
    const box = element("input", { type: "checkbox" });
    box.checked = shows[name];
    box.addEventListener("change", () => {
      shows[name] = box.checked;
      app.redraw();
    });
    return element("label", {}, box, ` ${words}`);
  });
  host.replaceChildren(
    element("fieldset", {}, element("legend", {}, "Show"), ...switches),
    element("h2", {}, "Nodes, their area grows with their data"),
    element("dl", { class: "marks" }, ...marks),
    element("h2", {}, "Fleet"),
    element("dl", { class: "marks" }, ...fleet),
    element(
      "p",
      {},
      "▲ start, ★ destination. Thin: planned; bold: sailed, and in pieces where only the ends of a leg are known. Messages are lines to those who hear them, broken and crossed where they are lost. Over the slider the collected data, with marks where nodes change hands.",
    ),
  );
}

const SWITCHES = {
  arrows: "arrows of the current",
  routes: "planned routes",
  names: "names of nodes",
  events: "events",
};

const MEANING = {
  planned: "an AUV means to visit it",
  collected: "its data are aboard",
  dropped: "its AUV had no time for it, and nobody has picked it up",
  idle: "its AUV failed or went home without it",
  unplanned: "on no route",
};
