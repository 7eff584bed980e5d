// What becomes of every node, and how much has been collected, event by event.

const STATES = {
  planned: "planned",
  collected: "collected",
  dropped: "dropped",
  idle: "idle",
  unplanned: "not planned",
};

/**
 * Changes of state of every node (index 0 is node 1), each { t, state, auv }, and the collected
 * data as steps { t, data }. A node is dropped when its AUV discards it and nobody has picked it
 * up since, and idle when its AUV has failed or gone home without it.
 */
function historyOf(scene, events) {
  const changes = scene.ids.map(() => [{ t: -Infinity, state: "unplanned", auv: -1 }]);
  scene.routes.forEach((route, auv) => {
    for (const node of route) changes[node - 1] = [{ t: -Infinity, state: "planned", auv }];
  });
  const collected = { t: [0], data: [0] };
  const last = (node) => changes[node - 1][changes[node - 1].length - 1];
  for (const { t, auv, kind, node } of events) {
    if (kind === "fail" || kind === "arrive") {
      changes.forEach((own, k) => {
        const now = last(k + 1);
        if (now.state === "planned" && now.auv === auv) own.push({ t, state: "idle", auv });
      });
    }
    if (!node || last(node).state === "collected") continue;
    const state = { collect: "collected", discard: "dropped", pick_up: "planned" }[kind];
    if (!state) continue;
    changes[node - 1].push({ t, state, auv });
    if (kind === "collect") {
      collected.t.push(t);
      collected.data.push(collected.data[collected.data.length - 1] + scene.data[node - 1]);
    }
  }
  return { changes, collected };
}

/** The last of a node's changes at a time. */
function stateAt(changes, t) {
  let k = changes.length - 1;
  while (k > 0 && changes[k].t > t) k -= 1;
  return changes[k];
}

function collectedAt(timeline, t) {
  return timeline.collected.data[Math.max(countUpTo(timeline.collected.t, t) - 1, 0)];
}

/** What an AUV is doing at a time: { doing, node }. */
function doingAt(scene, timeline, auv, t) {
  const fate = timeline.fates[auv];
  if (fate.kind === "fail" && t >= fate.t) return { doing: "failed", node: 0 };
  if (fate.kind === "arrive" && t >= fate.t) return { doing: "home", node: 0 };
  const home = scene.ids.length + 1;
  for (const [head, , reached, done] of timeline.legs[auv]) {
    if (t < reached)
      return { doing: head === home ? "going home" : "sailing to", node: head === home ? 0 : head };
    if (t < done) return { doing: "collecting", node: head };
  }
  return { doing: "under way", node: 0 };
}

const SAID = {
  depart: "departs",
  collect: "has collected",
  discard: "drops",
  pick_up: "picks up",
  send: "sends a message",
  receive: "receives a message",
  manoeuvre: "avoids an obstacle",
  fail: "fails",
  arrive: "is home",
};

function sentence(scene, event) {
  if (event.message) return event.kind === "send" ? told(event.message) : heard(event);
  const object = event.node ? ` ${scene.ids[event.node - 1]}` : "";
  return `AUV ${event.auv + 1} ${SAID[event.kind]}${object}`;
}

/** Who said what to whom, and whom it did not reach. */
function told({ says, sender, receiver, bits, heard, lost }) {
  const whom = receiver === null ? "all" : `AUV ${receiver + 1}`;
  const numbers = lost.map((auv) => auv + 1).join(", ");
  const fate = !lost.length ? "" : heard.length ? `, lost to ${numbers}` : ", lost";
  return `AUV ${sender + 1} sends ${says} to ${whom}${fate} (${bits} bits)`;
}

function heard({ t, auv, message: { says, sender, sent } }) {
  return `AUV ${auv + 1} hears ${says} of AUV ${sender + 1} after ${(t - sent).toFixed(1)} s`;
}
