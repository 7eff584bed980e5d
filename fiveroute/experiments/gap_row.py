"""One instance, measured: the planner, an exact method, and other people's solvers.

The planner plans. The exact method starts from its plan and proves what it can in a time of its
own; alone, it makes a start for itself. Peers get the planner's problem and its time. All run one
after the other on one core, and all plans are judged alike.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from functools import cache
from typing import Any, Literal

from pydantic import TypeAdapter, ValidationError

from fiveroute.exact import solve_from_good_plan
from fiveroute.generate import scenario
from fiveroute.limits import Limits, ProgressCallback
from fiveroute.mission import plan_mission
from fiveroute.models import METHODS, solve
from fiveroute.models.bounds import quick_bound
from fiveroute.paths.voyage import Voyage
from fiveroute.peers import PeerAnswer, ask
from fiveroute.problem import TeamOrienteering
from fiveroute.result import Result, Status, is_closed, optimality_gap
from fiveroute.routes import Plan

__all__ = ["GapRow", "GapSettings", "Side", "measure"]

Side = Literal["both", "heuristic", "exact"]

_TOY_NODES = 14
"""So few that everything ends at once, so many that the search for a good start runs."""


@dataclass(frozen=True, slots=True)
class GapSettings:
    """How every instance is measured.

    Parameters
    ----------
    time_limit
        Wall-clock seconds of the planner, and of every peer.
    exact_time_limit
        Wall-clock seconds of the exact method, which come on top.
    method
        Exact method, ``auto`` or a name in `fiveroute.models.METHODS`.
    side
        Whether planner, exact method or both run.
    fleet_size
        Number of AUVs; None takes that of the instance, or the planner's estimate.
    peers
        Names in `fiveroute.peers.PEERS`.
    straight_lines
        Whether the ocean is ignored.
    seed
        Seed of all random numbers.
    """

    time_limit: float = math.inf
    exact_time_limit: float = math.inf
    method: str = "auto"
    side: Side = "both"
    fleet_size: int | None = None
    peers: tuple[str, ...] = ()
    straight_lines: bool = False
    seed: int = 0


@dataclass(frozen=True, slots=True)
class GapRow:
    """One instance.

    Parameters
    ----------
    instance
        Its name.
    nodes, fleet_size
        Number of sensor nodes that can be reached, and of AUVs.
    heuristic
        Data that the planner's plan collects; None without a plan.
    bound
        Least proven upper bound; None where none was computed.
    best_known
        Best value known: of planner, exact method, peers and reference.
    gap
        (bound - value) / value of the planner's plan, or of the exact method's if that runs
        alone; 0 where the bound proves it, None without both.
    status
        How well that plan is known: ``optimal`` where the bound proves it.
    seconds
        Wall-clock time of the planner alone, or of the exact method alone.
    exact
        Data of the best plan that the exact method knows; None where it did not run.
    exact_status
        ``optimal`` where the instance is solved, as a plan or as proof that there is none.
    exact_method
        Who proved the bound.
    exact_seconds
        Wall-clock time of the exact method.
    reference
        Best value that others have published; None where it is not known.
    unreachable
        Number of sensor nodes that the ocean cuts off.
    peers
        Answers of other people's solvers, by name.
    """

    instance: str
    nodes: int
    fleet_size: int
    heuristic: float | None
    bound: float | None
    best_known: float | None
    gap: float | None
    status: str
    seconds: float
    exact: float | None = None
    exact_status: str | None = None
    exact_method: str | None = None
    exact_seconds: float | None = None
    reference: float | None = None
    unreachable: int = 0
    peers: Mapping[str, PeerAnswer] = field(default_factory=dict)

    @classmethod
    def of_document(cls, document: Mapping[str, Any]) -> GapRow | None:
        """The row that `as_document` made a document of; None for any other document."""
        try:
            return TypeAdapter(cls).validate_json(json.dumps(document), strict=True)
        except ValidationError:
            return None

    def as_document(self) -> dict[str, Any]:
        """What JSON can hold."""
        return asdict(self)

    @property
    def values(self) -> dict[str, float | None]:
        """Data that everybody has collected, by name; None without a plan."""
        ours = {"heuristic": self.heuristic, "exact": self.exact}
        return ours | {name: answer.objective for name, answer in self.peers.items()}

    @property
    def is_solved(self) -> bool:
        """Whether the exact method has proved its answer."""
        return self.exact_status in (Status.OPTIMAL, Status.INFEASIBLE)

    @property
    def contradicts(self) -> bool:
        """Whether somebody collects more than the bound allows: somebody is wrong."""
        if self.bound is None or self.best_known is None:
            return False
        return not is_closed(self.bound, self.best_known)

    def beside(self, reference: float | None) -> GapRow:
        """The row, compared with a published value."""
        known = (reference, *self.values.values())
        best = max((value for value in known if value is not None), default=None)
        return replace(self, reference=reference, best_known=best)


def measure(
    voyage: Voyage,
    settings: GapSettings,
    limits: Limits | None = None,
    progress: ProgressCallback | None = None,
) -> GapRow:
    """Measure one instance.

    Parameters
    ----------
    voyage
        The instance, and its leg times.
    settings
        How it is measured.
    limits
        Carries an interrupt; the settings have the time limits.
    progress
        Called as the run goes on.
    """
    limits = limits or Limits()
    _warm_up(settings.side, settings.method)
    planned = exact = None
    if settings.side == "exact":
        problem = voyage.instance.problem(settings.fleet_size, voyage.travel)
    else:
        mission = plan_mission(
            voyage.instance,
            travel=voyage.travel,
            fleet_size=settings.fleet_size,
            limits=limits.within(settings.time_limit),
            seed=settings.seed,
            progress=progress,
        )
        problem, planned = mission.problem, mission.result
    if settings.side != "heuristic":
        exact = _proved(problem, planned, settings, limits, progress)
    row = _row(voyage, problem, planned, exact)
    peers = {}
    for name in settings.peers:
        if not limits.interrupt.is_set():
            peers[name] = ask(name, problem, limits.within(settings.time_limit), settings.seed)
    return replace(row, peers=peers).beside(None)


@cache
def _warm_up(side: Side, method: str) -> None:
    """Compile kernels, or load those that are compiled, once in a process before any clock runs."""
    toy = scenario("uniform", _TOY_NODES, seed=0, fleet_size=2)
    problem = toy.problem()
    plan = plan_mission(toy).result.plan
    if side != "heuristic":
        quick_bound(problem, Limits())
        if method == "auto" or METHODS[method].supports(problem):
            solve_from_good_plan(problem, method)
            solve(problem, method, warm_start=plan)


def _proved(
    problem: TeamOrienteering,
    planned: Result | None,
    settings: GapSettings,
    limits: Limits,
    progress: ProgressCallback | None,
) -> Result:
    """The exact method's answer, with the best bound to be had."""
    limits = limits.within(settings.exact_time_limit)
    if planned is None:
        return solve_from_good_plan(
            problem, settings.method, limits, seed=settings.seed, progress=progress
        )
    clock = limits.start()
    plan = planned.plan
    quick = quick_bound(problem, limits)
    known = Result.judged(
        problem, plan, method=quick.method, seconds=clock.seconds, bound=quick.value
    )
    if known.status is Status.OPTIMAL or clock.expired:
        return known
    exact = solve(problem, settings.method, clock.rest(), warm_start=plan, progress=progress)
    if exact.status is Status.INFEASIBLE:
        return replace(exact, seconds=clock.seconds)
    bound = min(quick.value, math.inf if exact.bound is None else exact.bound)
    best = _better(problem, plan, exact.plan)
    return Result.judged(problem, best, method=exact.method, seconds=clock.seconds, bound=bound)


def _better(problem: TeamOrienteering, one: Plan | None, other: Plan | None) -> Plan | None:
    if one is None or other is None:
        return one or other
    return other if other.objective(problem) > one.objective(problem) else one


def _row(
    voyage: Voyage, problem: TeamOrienteering, planned: Result | None, exact: Result | None
) -> GapRow:
    shown = planned or exact
    assert shown is not None, "planner or exact method must run"
    bound = None if exact is None else exact.bound
    status = _status(shown, bound)
    return GapRow(
        instance=voyage.instance.name,
        nodes=problem.n,
        fleet_size=problem.fleet_size,
        heuristic=None if planned is None else planned.objective,
        bound=bound,
        best_known=None,
        gap=0.0 if status is Status.OPTIMAL else optimality_gap(shown.objective, bound),
        status=status.value,
        seconds=shown.seconds,
        exact=None if exact is None else exact.objective,
        exact_status=None if exact is None else exact.status.value,
        exact_method=None if exact is None else exact.method,
        exact_seconds=None if exact is None else exact.seconds,
        unreachable=len(voyage.unreachable),
    )


def _status(shown: Result, bound: float | None) -> Status:
    if shown.plan is not None and shown.objective is not None and bound is not None:
        return Status.OPTIMAL if is_closed(shown.objective, bound) else shown.status
    return shown.status
