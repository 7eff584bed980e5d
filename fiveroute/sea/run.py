"""One run: the fleet sails in an ocean that has its luck ready for every leg.

The simulation is driven by events. An AUV decides at its nodes and nowhere else: when a
service is done, whoever steers the fleet names the next vertex, and the AUV is committed to it. Its
leg takes what the luck of the run says. Everything else (messages on their way, timers) is an
action in the same agenda, and actions of equal time happen in the order in which they were
planned, so that a run is repeatable.
"""

from __future__ import annotations

import heapq
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Protocol

from fiveroute.problem import TeamOrienteering
from fiveroute.sea.courses.course import Course
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.sea.events import Event, Frame, Kind
from fiveroute.sea.luck import Luck
from fiveroute.sea.sailed_luck import SailedLuck

__all__ = ["Crew", "Run", "Vessel", "course_of"]

Action = Callable[[float], None]
"""Something that happens; it is told the time in seconds."""


class Crew(Protocol):
    """Whoever steers the AUVs of one run."""

    def steer(self, auv: int, t: float) -> int:
        """The vertex that an AUV sails to next, now that it is done where it is."""
        ...

    def come_home(self, auv: int, t: float) -> None:
        """An AUV has reached the destination."""
        ...


@dataclass(slots=True)
class Vessel:
    """Where an AUV really is.

    Parameters
    ----------
    budget
        T_max of the AUV in seconds.
    at
        Vertex that it was at last.
    target
        Vertex that it is under way to; `at` itself while it is there.
    left
        Time in seconds at which it left `at`.
    due
        Time in seconds at which it will reach the target, which it does not know.
    is_alive, is_home
        Whether it still works, and whether it has reached the destination.
    sailed
        Tail, head and beginning in seconds of every leg so far.
    """

    budget: float
    at: int = 0
    target: int = 0
    left: float = 0.0
    due: float = 0.0
    is_alive: bool = True
    is_home: bool = False
    sailed: list[tuple[int, int, float]] = field(default_factory=list)

    @property
    def is_active(self) -> bool:
        """Whether it is at sea and works."""
        return self.is_alive and not self.is_home


@dataclass(slots=True)
class Run:
    """One run of a mission.

    Parameters
    ----------
    problem
        The problem.
    luck
        What every leg takes in this run.
    failures
        When each AUV fails, in seconds; infinite where it does not.
    vessels
        The AUVs.
    log
        What happened, in the order of time.
    """

    problem: TeamOrienteering
    luck: Luck | SailedLuck
    failures: Sequence[float]
    vessels: list[Vessel] = field(init=False)
    log: list[Event] = field(default_factory=list)
    _agenda: list[tuple[float, int, Action]] = field(default_factory=list)
    _count: int = 0

    def __post_init__(self) -> None:
        self.vessels = [Vessel(float(budget)) for budget in self.problem.budgets]

    def note(
        self,
        t: float,
        auv: int,
        kind: Kind,
        node: int | None = None,
        frame: Frame | None = None,
    ) -> None:
        """Write an event into the log."""
        self.log.append(Event(t, auv, kind, node, frame))

    def schedule(self, t: float, action: Action) -> None:
        """Let something happen at a time in seconds."""
        heapq.heappush(self._agenda, (t, self._count, action))
        self._count += 1

    def sail(self, crew: Crew) -> None:
        """Sail until nothing is left to happen."""
        for auv, fails in enumerate(self.failures):
            if fails < float("inf"):
                self.schedule(fails, partial(self._fail, auv))
            self.note(0.0, auv, "depart")
            self.schedule(0.0, partial(self._leave, crew, auv))
        while self._agenda:
            t, _, action = heapq.heappop(self._agenda)
            action(t)

    def _leave(self, crew: Crew, auv: int, t: float) -> None:
        vessel = self.vessels[auv]
        if not vessel.is_alive:
            return
        target = crew.steer(auv, t)
        leg = self.luck.leg(vessel.at, target, t)
        vessel.sailed.append((vessel.at, target, t))
        vessel.target, vessel.left, vessel.due = target, t, t + leg.time
        for moment in leg.moments:
            self.schedule(t + moment, partial(self._manoeuvre, auv))
        end = partial(self._reach, crew, auv) if leg.arrives else partial(self._fail, auv)
        self.schedule(vessel.due, end)

    def _reach(self, crew: Crew, auv: int, t: float) -> None:
        vessel = self.vessels[auv]
        if not vessel.is_alive:
            return
        if vessel.target == self.problem.destination:
            vessel.at, vessel.is_home = vessel.target, True
            self.note(t, auv, "arrive")
            crew.come_home(auv, t)
            return
        done = t + float(self.problem.service[vessel.target])
        self.schedule(done, partial(self._collect, crew, auv))

    def _collect(self, crew: Crew, auv: int, t: float) -> None:
        vessel = self.vessels[auv]
        if not vessel.is_alive:
            return
        vessel.at = vessel.target
        self.note(t, auv, "collect", vessel.at)
        self._leave(crew, auv, t)

    def _manoeuvre(self, auv: int, t: float) -> None:
        if self.vessels[auv].is_alive:
            self.note(t, auv, "manoeuvre")

    def _fail(self, auv: int, t: float) -> None:
        vessel = self.vessels[auv]
        if vessel.is_active:
            vessel.is_alive = False
            self.note(t, auv, "fail")


def course_of(view: Outlook, vessel: Vessel, t: float, route: tuple[int, ...]) -> Course:
    """What an AUV has before it, as it can know it itself.

    Where it is under way it is committed to its target, and expects to be through there when the
    leg has taken its mean, or now, if it has taken that already.
    """
    if vessel.target == vessel.at:
        return Course(vessel.at, t, 0.0, vessel.budget, route)
    i, j = vessel.at, vessel.target
    through = max(vessel.left + float(view.legs[i, j]), t)
    return Course(j, through, float(view.variance[i, j]), vessel.budget, route)
