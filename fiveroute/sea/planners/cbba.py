"""CBBA: the consensus-based bundle algorithm on board, as the peer of the auction.

Every AUV is an agent that knows what it has sensed and what has reached it over the acoustic
channel. Its route as planned is its first bundle, and not for sale; nodes that the plan leaves out
or that are discarded under way belong to nobody, and all AUVs bid psi (27) for them, by
`fiveroute.sea.agents.bundle` and `fiveroute.sea.agents.consensus`. At a node an AUV first plans its
own route anew over its own and the idle nodes, by `fiveroute.sea.courses.replanning`, and bids for
each node that this picks up what it earns a second there; then it fills its bundle behind its next
node.

Of the variants this is the strongest that we know. Bidding for all unvisited nodes anew at every
event, as in a first assignment, throws away plans that are better than any bundle; without
the search on board it cannot exchange a poor node for a rich one.

Consensus needs no keeper and no confirmation, and so has no protection against lost messages
either: two AUVs may both believe to have a node, and what is collected twice is counted. A node won
is not sailed for before the others have had time to object. A teammate that has not been heard of
for `silence` seconds, not even through others, is taken to have failed, and its nodes are idle.

References: see `fiveroute.sea.agents.consensus` and `fiveroute.sea.agents.bundle`.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from fiveroute.routes import Plan
from fiveroute.sea.agents.bundle import Bundle
from fiveroute.sea.agents.channel import Channel, Radio
from fiveroute.sea.agents.consensus import (
    COLLECTED,
    HELD,
    NOBODY,
    Beliefs,
    View,
    longest_view,
)
from fiveroute.sea.agents.messages import Message
from fiveroute.sea.agents.teammates import BEAT, SILENCE
from fiveroute.sea.courses.course import Course
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.sea.courses.picking import offers
from fiveroute.sea.courses.replanning import TRIALS, replan
from fiveroute.sea.run import Run, course_of
from fiveroute.sea.seeds import decision_seed

__all__ = ["Cbba"]


class Cbba:
    """Steers the fleet of one run.

    Parameters
    ----------
    run
        The run.
    view
        What the AUVs expect.
    plan
        What they set out with.
    channel
        What they talk over.
    points
        Positions of all vertices in metres, shape (n + 2, 2).
    rng
        Draws losses and delays.
    silence
        Seconds after which a silent AUV is suspected; infinite where none ever fails.
    """

    def __init__(
        self,
        run: Run,
        view: Outlook,
        plan: Plan,
        *,
        channel: Channel,
        points: NDArray[np.float64],
        rng: np.random.Generator,
        silence: float = SILENCE,
    ) -> None:
        longest = longest_view(run.problem.n, len(plan.routes))
        self.radio = Radio(run, channel, points, rng, self._hear, longest)
        self.agents = [
            _Agent(auv, run, self.radio, view, plan, silence) for auv in range(len(plan.routes))
        ]

    @property
    def false_takeovers(self) -> int:
        """Nodes taken from AUVs that still worked."""
        return sum(agent.false_takeovers for agent in self.agents)

    def steer(self, auv: int, t: float) -> int:
        """The next vertex of an AUV."""
        return self.agents[auv].steer(t)

    def come_home(self, auv: int, t: float) -> None:
        """An AUV has reached the destination."""
        self.agents[auv].speak(t)

    def _hear(self, t: float, auv: int, message: Message) -> None:
        if isinstance(message, View):
            self.agents[auv].hear(t, message)


class _Agent:
    """One AUV: owner of its bundle."""

    def __init__(
        self,
        number: int,
        run: Run,
        radio: Radio,
        view: Outlook,
        plan: Plan,
        silence: float,
    ) -> None:
        vertices, fleet = run.problem.n + 2, len(plan.routes)
        self.number, self.route = number, list(plan.routes[number])
        self.beliefs = Beliefs(number, [NOBODY] * vertices, [0.0] * vertices, [0.0] * fleet)
        for auv, route in enumerate(plan.routes):
            for node in route:
                self.beliefs.winners[node], self.beliefs.bids[node] = auv, HELD
        self.bundle = Bundle(self, self.beliefs)
        self.target: int | None = None
        self.false_takeovers = 0
        self._run, self._radio, self._view = run, radio, view
        self._vessel, self._silence = run.vessels[number], silence
        self._now = self._spoken = 0.0
        self._is_to_speak = False
        self._claimed: dict[int, float] = {}
        run.schedule(BEAT, self._beat)

    # What its bundle asks of it.

    def worth(self, nodes: Sequence[int]) -> list[float]:
        """Psi of nodes, (27); 0 once it sails home."""
        psi, _ = offers(self._view, self._course(), np.array(nodes, dtype=np.int64))
        return [0.0] * len(nodes) if self._is_homebound else psi.tolist()

    def add(self, node: int) -> None:
        """Insert a node where it costs least."""
        _, place = offers(self._view, self._course(), np.array([node]))
        self.route.insert(int(place[0]), node)
        self._claimed[node] = self._now

    def remove(self, node: int) -> None:
        """Take a node off the route."""
        self.route.remove(node)
        if self._claimed.pop(node, None) is None:
            self._run.note(self._now, self.number, "discard", node)

    # What happens to it.

    def steer(self, t: float) -> int:
        """The next vertex, now that it is done where it is."""
        vessel, self._now = self._vessel, t
        vessel.target = vessel.at
        if self.target is not None:
            self.beliefs.claim(self.target, COLLECTED)
        self._replan()
        self.target = self.route.pop(0) if self.route else None
        vessel.left = t
        vessel.target = self._run.problem.destination
        if self.target is not None:
            self.beliefs.claim(self.target, HELD)
            if self.target in self.bundle.nodes:
                self.bundle.nodes.remove(self.target)
            vessel.target = self.target
        self.bundle.build()
        self.speak(t)
        return vessel.target

    def hear(self, t: float, message: View) -> None:
        """Weigh what a teammate believes, and tell if it has changed anything."""
        self._now = t
        if not self.bundle.hear(message):
            return
        winners = self.beliefs.winners
        self.route[:] = [node for node in self.route if winners[node] == self.number]
        if not self._is_to_speak:
            self._is_to_speak = True
            self._run.schedule(max(t, self._spoken + self._radio.cycle), self._speak_up)

    def speak(self, t: float) -> None:
        """Tell all that it believes."""
        self._is_to_speak, self._spoken = False, t
        self._radio.send(t, self.beliefs.view(t))

    # How it decides.

    @property
    def _is_homebound(self) -> bool:
        return self._vessel.target == self._run.problem.destination

    def _course(self) -> Course:
        return course_of(self._view, self._vessel, self._now, tuple(self.route))

    def _replan(self) -> None:
        """The best course over its own and idle nodes that begins with a node of its own."""
        beliefs, course = self.beliefs, self._course()
        idle = [n for n in range(1, len(beliefs.winners) - 1) if beliefs.winners[n] == NOBODY]
        seed = decision_seed(self._run.luck.run, self.number, len(self._run.log))
        better, _ = replan(self._view, course, idle, TRIALS, seed)
        fresh = {*idle, *self._unsettled()}
        if better.route and better.route[0] in fresh:
            safe = replace(course, route=tuple(n for n in course.route if n not in fresh))
            better, _ = replan(self._view, safe, (), TRIALS, seed)
        self._discard(set(course.route).difference(better.route))
        self.route[:] = better.route
        self._settle()
        self._bid_for(set(better.route).intersection(idle))

    def _unsettled(self) -> list[int]:
        """Nodes won so lately that others may still object."""
        wait = 2.0 * self._radio.patience
        return [node for node, since in self._claimed.items() if self._now - since < wait]

    def _settle(self) -> None:
        """Log nodes as picked up that nobody has objected to in time."""
        for node in sorted(self._claimed.keys() - self._unsettled()):
            self._run.note(self._now, self.number, "pick_up", node)
            del self._claimed[node]

    def _discard(self, nodes: Collection[int]) -> None:
        """Give nodes of its route up: anybody may bid for them."""
        for node in sorted(nodes):
            self.beliefs.forget(node)
            if self._claimed.pop(node, None) is None:
                self._run.note(self._now, self.number, "discard", node)
            if node in self.bundle.nodes:
                self.bundle.nodes.remove(node)

    def _bid_for(self, nodes: Collection[int]) -> None:
        """Bid for idle nodes on the route what each earns there a second, the best first."""
        here, bids = self._course(), []
        for node in nodes:
            without = replace(here, route=tuple(n for n in here.route if n != node))
            bids.append((float(offers(self._view, without, np.array([node]))[0][0]), node))
        for psi, node in sorted(bids, reverse=True):
            last = self.beliefs.bids[self.bundle.nodes[-1]] if self.bundle.nodes else HELD
            self.beliefs.claim(node, min(psi, last))
            self.bundle.nodes.append(node)
            self._claimed[node] = self._now

    # What it does by the clock.

    def _speak_up(self, t: float) -> None:
        if self._is_to_speak and self._vessel.is_alive:
            self.speak(t)

    def _beat(self, t: float) -> None:
        """Now and then: a sign of life, and a look for signs of others."""
        self._now = t
        if not self._vessel.is_alive or t > self._run.problem.budgets.max():
            return
        if t - self._spoken >= BEAT:
            self.speak(t)
        self._look_round(t)
        self._run.schedule(t + BEAT, self._beat)

    def _look_round(self, t: float) -> None:
        """Let nodes of teammates go that nobody has heard of for too long."""
        beliefs = self.beliefs
        for auv, stamp in enumerate(beliefs.stamps):
            if auv == self.number or t - stamp <= self._silence:
                continue
            for node, winner in enumerate(beliefs.winners):
                if winner == auv and beliefs.bids[node] != COLLECTED:
                    beliefs.forget(node)
                    self.false_takeovers += self._run.vessels[auv].is_alive
        if self._silence < float("inf") and self.bundle.build():
            self.speak(t)
