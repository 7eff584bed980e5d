// The studio: the page of the view, with panels to edit the mission and to plan it anew.

/** Milliseconds between two looks at the work in the background, and before it begins by itself. */
const POLL = 200;
const PAUSE = 350;

/** The work that has been asked for, before the server says more. */
const ASKED = {
  state: "running",
  message: "starting",
  seconds: 0,
  objective: null,
  bound: null,
  gap: null,
  points: [],
};

class Studio {
  constructor(client, formats) {
    this.client = client;
    this.editor = new Editor(this);
    this.planPart = new PlanPart(this);
    this.missionPart = new MissionPart(this);
    this.stopPart = new StopPart(this);
    this.filesPart = new FilesPart(this, formats);
    this.isBusy = false;
    this.build();
  }

  /** Add what the page of the view does not have. */
  build() {
    const edit = [this.planPart.box, this.missionPart.box, this.stopPart.box];
    this.addTab("edit", "Edit", element("div", {}, ...edit), true);
    this.addTab("files", "Files", this.filesPart.box, false);
    this.undo = button("undo", "Undo", () => this.step("/api/undo"), { title: "Undo (Ctrl+Z)" });
    this.redo = button("redo", "Redo", () => this.step("/api/redo"), {
      title: "Redo (Ctrl+Shift+Z)",
    });
    document.querySelector(".actions").prepend(this.undo, this.redo);
    byId("compare").hidden = true;
    this.toast = element("div", { id: "toast", role: "alert", hidden: "" });
    this.dialog = element("dialog", { id: "ask" });
    document.body.append(this.toast, this.dialog);
    addKeys();
    document.addEventListener("keydown", (event) => this.pressed(event), true);
  }

  addTab(name, words, content, isFirst) {
    const tab = element(
      "button",
      {
        role: "tab",
        type: "button",
        id: `tab-${name}`,
        "aria-controls": `panel-${name}`,
        "aria-selected": "false",
        tabindex: -1,
      },
      words,
    );
    const panel = element(
      "div",
      { role: "tabpanel", id: `panel-${name}`, "aria-labelledby": tab.id, tabindex: 0, hidden: "" },
      content,
    );
    const tabs = document.querySelector("[role=tablist]");
    if (isFirst) tabs.prepend(tab);
    else byId("which-label").before(tab);
    byId("side").append(panel);
  }

  async open() {
    const state = await this.client.ask("/api/state");
    this.state = state;
    this.app = new App([sceneOf(state)], this.editor);
    this.app.openTab(byId("tab-edit"));
    this.show(state);
    this.watch();
    const { setTheme } = this.app;
    this.app.setTheme = (isDark) => {
      setTheme.call(this.app, isDark);
      this.showPlan();
    };
  }

  get scene() {
    return this.app.scenes[0];
  }

  show(state) {
    this.state = state;
    this.undo.disabled = !state.undo;
    this.redo.disabled = !state.redo;
    document.title = `${state.saved ? "" : "• "}${state.mission.name}: fiveroute studio`;
    byId("title").textContent = state.mission.name;
    this.missionPart.show(state);
    this.filesPart.show(state);
    this.showPlan();
    this.showStop();
  }

  showPlan() {
    this.planPart.show(this.state, this.scene, this.app.theme);
  }

  showStop() {
    const count = this.state.mission.nodes.length;
    if (this.editor.selected > count + 1) this.editor.selected = -1;
    this.stopPart.show(this.state, this.editor.selected);
  }

  showAdding() {
    const { isAdding } = this.editor;
    this.stopPart.add.setAttribute("aria-pressed", String(isAdding));
    this.stopPart.add.textContent = isAdding ? "Click on the map" : "Add a node";
  }

  /** Show another state of the mission on the map and in the panels. */
  take(state) {
    const before = this.scene;
    const scene = sceneOf(state);
    const pane = this.app.panes[0];
    const wasEmpty = !before.routes.length;
    if (pane.marked.node > scene.ids.length) pane.marked = { auv: -1, node: 0 };
    if (pane.marked.auv >= scene.routes.length) pane.marked = { auv: -1, node: 0 };
    this.state = state;
    this.app.replaceScene(0, scene);
    if (wasEmpty && scene.routes.length) this.app.player.suit(this.app.player.end);
    this.app.showState();
    this.show(state);
  }

  /** Do something that may be refused; whether it was done. */
  async attempt(action) {
    try {
      const answer = await action();
      return answer !== false;
    } catch (error) {
      this.say(error.message, true);
      return false;
    }
  }

  async edit(edit) {
    this.isBusy = true;
    const isDone = await this.attempt(async () => {
      const body = () => ({ revision: this.state.revision, edit });
      this.take(await this.client.ask("/api/edit", body));
      this.hush();
      this.planSoon();
    });
    this.isBusy = false;
    if (!isDone) await this.reload();
    return isDone;
  }

  async reload() {
    await this.attempt(async () => this.take(await this.client.ask("/api/state")));
  }

  step(address) {
    return this.attempt(async () => {
      this.take(await this.client.ask(address, () => ({})));
      this.hush();
    });
  }

  planSoon() {
    clearTimeout(this.soon);
    if (!this.planPart.auto.checked || this.state.planned) return;
    this.soon = setTimeout(() => this.start(this.planPart.quickWish()), PAUSE);
  }

  plan() {
    return this.attempt(() => this.start(this.planPart.wish()));
  }

  async start(wish) {
    clearTimeout(this.soon);
    this.hush();
    this.state.job = { ...ASKED, limit: wish.seconds };
    this.showPlan();
    const isDone = await this.attempt(async () => {
      this.state.job = (await this.client.ask("/api/plan", () => wish)).job;
      this.watch();
    });
    if (!isDone) await this.reload();
  }

  stop() {
    return this.attempt(() => this.client.ask("/api/stop", () => ({})));
  }

  /** Look at the work in the background until it is over. */
  async watch() {
    if (this.isWatching) return;
    this.isWatching = true;
    await this.attempt(async () => {
      while (this.state.job?.state === "running") {
        await new Promise((go) => setTimeout(go, POLL));
        const { revision, job } = await this.client.ask("/api/progress");
        if (revision !== this.state.revision) this.take(await this.client.ask("/api/state"));
        else this.state.job = job;
        this.showPlan();
        if (job?.state === "failed") this.say(job.error, true);
      }
    });
    this.isWatching = false;
  }

  /** Write files; if some exist, ask whether they may go. */
  async write(address, body, words) {
    return this.attempt(async () => {
      let answer;
      try {
        answer = await this.client.ask(address, () => body);
      } catch (error) {
        if (!error.exists) throw error;
        if (!(await this.confirm(`Overwrite ${error.exists.join(" and ")}?`))) return false;
        return this.write(address, { ...body, overwrite: true }, words);
      }
      this.say(words(answer), false);
      if (address === "/api/save") this.show(await this.client.ask("/api/state"));
      return true;
    });
  }

  /** Ask a question; the answer is whether it was agreed to. */
  confirm(question) {
    const yes = button("ask-yes", "Overwrite", () => this.dialog.close("yes"), { class: "main" });
    const no = button("ask-no", "Leave it", () => this.dialog.close(""));
    this.dialog.replaceChildren(
      element("h2", { dir: "auto" }, question),
      element("div", { class: "row" }, no, yes),
    );
    this.dialog.returnValue = "";
    this.dialog.showModal();
    return new Promise((go) => {
      this.dialog.addEventListener("close", () => go(this.dialog.returnValue === "yes"), {
        once: true,
      });
    });
  }

  say(words, isError) {
    clearTimeout(this.fading);
    const close = button("hush", "×", () => this.hush(), { "aria-label": "Close" });
    this.toast.replaceChildren(element("span", { dir: "auto" }, words), close);
    this.toast.classList.toggle("error", isError);
    this.toast.hidden = false;
    if (!isError) this.fading = setTimeout(() => this.hush(), 6000);
  }

  hush() {
    this.toast.hidden = true;
  }

  /** Keys of the studio come before those of the view. */
  pressed(event) {
    if (!this.app || this.dialog.open || byId("keys").open || event.altKey) return;
    if (event.target.matches("input:not([type=range]):not([type=checkbox]), select")) return;
    const action = event.ctrlKey || event.metaKey ? this.withControl(event) : this.plain(event);
    if (!action) return;
    event.preventDefault();
    event.stopPropagation();
    action();
  }

  withControl({ key, shiftKey }) {
    const name = key.toLowerCase();
    if (name === "z") return () => this.step(shiftKey ? "/api/redo" : "/api/undo");
    if (name === "y") return () => this.step("/api/redo");
    if (name === "s") return () => this.filesPart.save(this.state.planned);
    return null;
  }

  plain({ key, target, shiftKey }) {
    const isOnMap = target.matches(".pane canvas");
    const arrow = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[key];
    if (arrow && isOnMap && !shiftKey && this.editor.selected >= 0)
      return () => this.editor.nudge(...arrow);
    return {
      a: () => this.editor.setAdding(!this.editor.isAdding),
      n: () => this.editor.addInMiddle(),
      p: () => this.plan(),
      c: () => {},
      Delete: () => this.editor.remove(),
      Backspace: () => this.editor.remove(),
      Escape: this.editor.isAdding ? () => this.editor.setAdding(false) : null,
    }[key.length === 1 ? key.toLowerCase() : key];
  }
}

/** The scene of a state, named for what it is. */
function sceneOf({ view, planned }) {
  const scene = unpackScene(view.scenes[0]);
  const label = planned ? "plan" : scene.routes.length ? "draft" : "no plan yet";
  return Object.assign(scene, { label });
}

const KEYS = {
  "A": "add a node with a click on the map",
  "N": "add a node in the middle of the map",
  "Delete": "remove the selected node",
  "← ↑ → ↓": "on the map: move the selected stop",
  "alt + drag": "part start and destination",
  "P": "plan anew",
  "Ctrl + Z": "undo; with shift redo",
  "Ctrl + S": "save",
};

function addKeys() {
  const list = document.querySelector("#keys dl");
  for (const line of list.children)
    if (line.textContent.includes("side by side")) line.hidden = true;
  const lines = Object.entries(KEYS).map(([key, words]) =>
    element("div", {}, element("dt", {}, element("kbd", {}, key)), element("dd", {}, words)),
  );
  list.prepend(...lines);
}

function startStudio() {
  const { formats } = JSON.parse(byId("data").textContent);
  const token = new URLSearchParams(location.search).get("token") || "";
  const studio = new Studio(new Client(token), formats);
  byId("title").textContent = "Reading the mission ...";
  studio.open().catch((error) => studio.say(error.message, true));
  return studio;
}
