"""The simulation: one plan, carried out in many runs.

`simulate_fleet` is where to start reading. It lets the fleet sail as often as asked, each time
with other luck. Who steers is one of `PLANNERS`; the luck of a run, its failures, and the rule by
which time is kept in hand are the same for all of them.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fiveroute.check import check
from fiveroute.errors import InputError
from fiveroute.instance import Instance
from fiveroute.limits import Limits, Progress, ProgressCallback
from fiveroute.problem import TIME_TOLERANCE
from fiveroute.routes import Plan
from fiveroute.sea.agents.channel import PRESETS, Channel
from fiveroute.sea.agents.teammates import SILENCE
from fiveroute.sea.bounds.clairvoyant import clairvoyant_plan
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.sea.luck import Luck
from fiveroute.sea.planners.alone import Alone, sail_alone
from fiveroute.sea.planners.cbba import Cbba
from fiveroute.sea.planners.five_tier import FiveTier, ShortSighted
from fiveroute.sea.planners.ftcmp import Ftcmp
from fiveroute.sea.planners.of_one_mind import OfOneMind
from fiveroute.sea.planners.own_pick_up import OwnPickUp
from fiveroute.sea.planners.re_optimising import ReOptimising
from fiveroute.sea.planners.rmmp import Rmmp
from fiveroute.sea.planners.to_the_letter import ToTheLetter
from fiveroute.sea.run import Crew, Run
from fiveroute.sea.run_result import RunResult, SimulationResult
from fiveroute.sea.sailed_luck import SailedLuck
from fiveroute.sea.seeds import Purpose, generator
from fiveroute.sea.world import World

__all__ = ["PLANNERS", "failure_times", "simulate_fleet"]

_KNOWING: dict[str, Callable[[Run, Outlook, Plan], Crew]] = {
    "ftcmp": Ftcmp,
    "rmmp": Rmmp,
    "to-the-letter": ToTheLetter,
    "of-one-mind": OfOneMind,
    "own-pick-up": OwnPickUp,
    "re-optimising": ReOptimising,
}

_TALKING: dict[str, type[FiveTier | Cbba]] = {
    "five-tier": FiveTier,
    "short-sighted": ShortSighted,
    "cbba": Cbba,
}

PLANNERS = (*_TALKING, "no-coordination", *_KNOWING)
"""Who can steer: the five-tiered planner with and without its fifth tier, the two that the paper
compares with, a peer that agrees without an auction, and five to learn from, see their modules."""


def simulate_fleet(
    mission: Instance | World,
    plan: Plan,
    *,
    planner: str = "five-tier",
    runs: int = 50,
    first_run: int = 0,
    reserve: float = 1.645,
    loss: float | None = None,
    failures: float = 0.0,
    channel: Channel = PRESETS["unlimited"],
    seed: int = 0,
    log: bool = True,
    gap: bool = False,
    limits: Limits | None = None,
    progress: ProgressCallback | None = None,
) -> SimulationResult:
    """Let a fleet carry a plan out, again and again.

    Parameters
    ----------
    mission
        The mission; an instance is sailed in straight lines, see `World.of`.
    plan
        The routes with which the fleet sets out.
    planner
        Who steers, one of `PLANNERS`.
    runs, first_run
        Number of runs, and the number of the first: a campaign may be split up.
    reserve
        Standard deviations of the remaining time kept in hand; 0 as in the paper.
    loss
        Probability that a message is lost; None takes that of the channel.
    failures
        Probability that an AUV fails in mid-mission.
    channel
        What the AUVs of the five-tiered planner talk over.
    seed
        Seed of luck, failures and losses; the same for all planners to be compared.
    log
        Whether to keep the events.
    gap
        Whether to look for the clairvoyant plan of every run; not where a vehicle sails the legs.
    limits
        When to stop; the runs done so far are returned, one at least.
    progress
        Called after every run.

    Raises
    ------
    InputError
        If an option or the plan makes no sense.
    """
    world = World.of(mission, len(plan.routes)) if isinstance(mission, Instance) else mission
    _check_options(world, plan, planner, runs, reserve, failures)
    sea = _Sea(
        world,
        world.outlook(reserve),
        channel if loss is None else replace(channel, loss=loss),
        failures,
        seed,
    )
    clock, done = (limits or Limits()).start(), []
    for number in range(first_run, first_run + runs):
        done.append(_run(sea, plan, planner, number, log, gap))
        if progress is not None:
            progress(Progress(clock.seconds, message=f"run {len(done)} of {runs}"))
        if clock.expired:
            break
    planned = world.completion(plan.objective(world.problem))
    return SimulationResult(planner, world.problem.fleet_size, planned, tuple(done), clock.seconds)


@dataclass(frozen=True, slots=True)
class _Sea:
    """What all runs have in common."""

    world: World
    view: Outlook
    channel: Channel
    failures: float
    seed: int


def _run(sea: _Sea, plan: Plan, planner: str, number: int, log: bool, gap: bool) -> RunResult:
    problem, luck = sea.world.problem, sea.world.luck(sea.seed, number)
    fails = failure_times(problem.budgets, sea.failures, sea.seed, number)
    if planner == "no-coordination" and isinstance(luck, Luck) and not (log or gap):
        return _run_alone(sea.world, sea.view, plan, luck, fails)
    run = Run(problem, luck, fails)
    crew = _crew(sea, run, plan, planner)
    run.sail(crew)
    nodes = [event.node for event in run.log if event.kind == "collect"]
    collected = problem.collected(sorted({node for node in nodes if node is not None}))
    arrivals = [math.inf] * problem.fleet_size
    for event in run.log:
        if event.kind == "arrive":
            arrivals[event.auv] = event.t
    result = RunResult(
        number,
        sea.world.completion(collected),
        tuple(arrivals),
        _late(sea.world, arrivals),
        len(nodes) - len(set(nodes)),
    )
    if log:
        legs = tuple(tuple(vessel.sailed) for vessel in run.vessels)
        result = replace(result, events=tuple(run.log), legs=legs)
    if isinstance(luck, SailedLuck):
        result = replace(result, **_safety(luck, run))
    elif gap:
        result = replace(result, clairvoyant=_best(sea.world, run, luck))
    if isinstance(crew, FiveTier | Cbba):
        sent, delivered = crew.radio.sent, crew.radio.delivered
        takeovers = crew.false_takeovers
        return replace(result, sent=sent, delivered=delivered, false_takeovers=takeovers)
    return result


def _safety(luck: SailedLuck, run: Run) -> dict[str, Any]:
    """What the tracks of a run prove."""
    least = luck.least_clearance
    lost = sum(
        vessel.due <= fails and not luck.leg(*vessel.sailed[-1]).arrives
        for vessel, fails in zip(run.vessels, run.failures, strict=True)
        if vessel.sailed
    )
    return {
        "min_clearance": least if math.isfinite(least) else None,
        "collisions": luck.collisions,
        "lost": lost,
    }


def _best(world: World, run: Run, luck: Luck) -> float:
    """Completion rate of the clairvoyant plan."""
    routes: list[list[int]] = [[] for _ in run.vessels]
    for event in run.log:
        if event.kind == "collect" and event.node is not None:
            routes[event.auv].append(event.node)
    real, plan = clairvoyant_plan(world.problem, luck, Plan.of(routes))
    return world.completion(plan.objective(real))


def _crew(sea: _Sea, run: Run, plan: Plan, planner: str) -> Crew:
    """Whoever steers this run."""
    if planner in _TALKING:
        return _TALKING[planner](
            run,
            sea.view,
            plan,
            channel=sea.channel,
            points=sea.world.points,
            rng=generator(Purpose.CHANNEL, sea.seed, run.luck.run),
            silence=SILENCE if sea.failures > 0.0 else math.inf,
        )
    if planner == "no-coordination":
        return Alone(run, sea.view, plan)
    return _KNOWING[planner](run, sea.view, plan)


def failure_times(
    budgets: NDArray[np.float64], failures: float, seed: int, run: int
) -> tuple[float, ...]:
    """When each AUV fails in a run, in seconds: at any time of its endurance, or never."""
    rng = generator(Purpose.FAILURES, seed, run)
    fails, when = rng.random(len(budgets)) < failures, rng.random(len(budgets)) * budgets
    return tuple(np.where(fails, when, np.inf).tolist())


def _run_alone(
    world: World, view: Outlook, plan: Plan, luck: Luck, fails: tuple[float, ...]
) -> RunResult:
    """Without coordination and without a log: every AUV in the kernel."""
    problem, key = world.problem, luck.key
    collected, arrivals = 0.0, []
    for route, budget, fail in zip(plan.routes, problem.budgets.tolist(), fails, strict=True):
        stops = np.array([0, *route, problem.destination])
        data, arrival = sail_alone(world.law, key, view, stops, budget, fail)
        collected += data
        arrivals.append(arrival)
    completion = world.completion(collected)
    return RunResult(luck.run, completion, tuple(arrivals), _late(world, arrivals))


def _late(world: World, arrivals: list[float]) -> int:
    """Number of AUVs that arrived after their time."""
    times, allowed = np.array(arrivals), world.problem.budgets * (1.0 + TIME_TOLERANCE)
    return int(((times > allowed) & np.isfinite(times)).sum())


def _check_options(
    world: World, plan: Plan, planner: str, runs: int, reserve: float, failures: float
) -> None:
    if planner not in PLANNERS:
        raise InputError(
            f"no such planner; take one of {', '.join(PLANNERS)}",
            field="planner",
            value=planner,
        )
    if runs < 1:
        raise InputError("at least one run", field="runs", value=runs)
    if not (math.isfinite(reserve) and reserve >= 0.0):
        raise InputError("must be finite and not negative", field="reserve", value=reserve)
    if not 0.0 <= failures <= 1.0:
        raise InputError("a probability lies between 0 and 1", field="failures", value=failures)
    wrong = [v for v in check(world.problem, plan) if v.kind != "over_budget"]
    if wrong:
        raise InputError("must be a plan of this mission", field="plan", value=wrong[0])
