// The tables of AUVs and of nodes.

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
