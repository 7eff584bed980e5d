"""Plans against an ensemble: chosen on some of its members, judged on the others.

A member is one ocean that may be: a file of a forecast centre's ensemble, or a truth drawn from
the vortices of the instance. Paths are planned in the instance's own current; in a member their
legs take other times. An AUV on its way knows the current as far as the next node and from there
home (a nowcast). It leaves a node out where it could not do both in time: that is its recourse.

The candidates are fleet-search plans for the planned times, for the mean of the training members,
and for quantiles of each leg's time over them, which are more and more cautious. The one of the
best mean over the worst share alpha of the training members is taken, the conditional value at risk

    CVaR_alpha = mean of the ceil(alpha K) lowest completion rates of K members,

(Rockafellar and Uryasev 2000, doi 10.21314/JOR.2000.038); alpha = 1 is the mean. What it is worth
is told by the held-out members, which it has never seen.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fiveroute.decide.sweep import Row, Sweep
from fiveroute.errors import InputError
from fiveroute.limits import Limits, Progress, ProgressCallback
from fiveroute.mission import plan_mission
from fiveroute.paths.voyage import Voyage
from fiveroute.problem import TeamOrienteering, completion_rate
from fiveroute.routes import Plan

__all__ = [
    "Candidate",
    "EnsemblePlan",
    "cvar",
    "ensemble_sweep",
    "held_out_of",
    "plan_against_ensemble",
    "recourse_completion",
]

Floats = NDArray[np.float64]

_QUANTILES = (0.5, 0.6, 0.7, 0.8, 0.9)


@dataclass(frozen=True, slots=True)
class Candidate:
    """A plan and what it collects in every member.

    Parameters
    ----------
    name
        What it was planned for.
    plan
        Its routes.
    training, held_out
        Completion rates in the members of either kind.
    """

    name: str
    plan: Plan
    training: tuple[float, ...]
    held_out: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class EnsemblePlan:
    """The candidates, the best of the training members first.

    Parameters
    ----------
    alpha
        Share of the worst training members that decides.
    candidates
        All candidates in the order of their CVaR in the training members.
    """

    alpha: float
    candidates: tuple[Candidate, ...]

    @property
    def chosen(self) -> Candidate:
        """The plan to sail."""
        return self.candidates[0]


def plan_against_ensemble(
    voyage: Voyage,
    times: Sequence[Floats],
    held_out: int,
    *,
    alpha: float = 0.2,
    fleet_size: int | None = None,
    limits: Limits | None = None,
    seed: int = 0,
    progress: ProgressCallback | None = None,
) -> EnsemblePlan:
    """Choose a plan on the first members, and judge it on the last ones.

    Parameters
    ----------
    voyage
        The mission and its planned leg times.
    times
        Leg times of every member in seconds, shape (n + 2, n + 2) each, see `member_times`.
    held_out
        Number of members, the last ones, that are not planned with.
    alpha
        Share of the worst training members that decides, above 0 and at most 1.
    fleet_size
        Number of AUVs; None takes that of the instance, or else estimates it.
    limits
        When to stop, shared among the candidates.
    seed
        Seed of the random numbers.
    progress
        Told what is at work.

    Raises
    ------
    InputError
        If no member is left to train with or to test on, or alpha is out of range.
    """
    held_out = held_out_of(len(times), held_out)
    if not 0.0 < alpha <= 1.0:
        raise InputError("must be above 0 and at most 1", field="alpha", value=alpha)
    clock = (limits or Limits()).start()
    total = voyage.mission.total_data
    within_reach = completion_rate(total - voyage.out_of_reach, total)
    training = np.array(times[: len(times) - held_out])
    wanted = _wanted(voyage, training)
    candidates: list[Candidate] = []
    for done, (name, travel) in enumerate(wanted.items()):
        if candidates and clock.expired:
            break
        if progress is not None:
            progress(Progress(clock.seconds, message=f"plan for {name}"))
        until = clock.limits.within(clock.left / (len(wanted) - done))
        planned = plan_mission(
            voyage.instance, travel=travel, fleet_size=fleet_size, limits=until, seed=seed
        )
        fleet_size = planned.problem.fleet_size
        if planned.result.plan is None:
            continue
        rates = [
            within_reach * recourse_completion(planned.problem, planned.result.plan, travel)
            for travel in times
        ]
        split = len(training)
        candidates.append(
            Candidate(name, planned.result.plan, tuple(rates[:split]), tuple(rates[split:]))
        )
    if not candidates:
        raise InputError(
            "no AUV reaches the destination in time; give it a longer endurance",
            field="fleet.endurance",
        )
    candidates.sort(key=lambda candidate: -cvar(candidate.training, alpha))
    return EnsemblePlan(alpha, tuple(candidates))


def held_out_of(count: int, held_out: int | None = None) -> int:
    """How many of so many members are held out, half of them unless a number is given.

    Raises
    ------
    InputError
        If no member is left to plan with or to test on.
    """
    tested = max(count // 2, 1) if held_out is None else held_out
    if not 0 < tested < count:
        raise InputError(
            f"must leave a member to plan with and one to test on, of {count}",
            field="held_out",
            value=tested,
        )
    return tested


def ensemble_sweep(voyage: Voyage, planned: EnsemblePlan) -> Sweep:
    """The candidates as a table, the chosen one first and pointed out."""
    rows: tuple[Row, ...] = tuple(
        {
            "planned_for": candidate.name,
            "training_mean": float(np.mean(candidate.training)),
            "training_cvar": cvar(candidate.training, planned.alpha),
            "held_out_mean": float(np.mean(candidate.held_out)),
            "held_out_cvar": cvar(candidate.held_out, planned.alpha),
            **{
                f"held_out_p{q}": float(np.quantile(candidate.held_out, q / 100.0))
                for q in (5, 25, 50, 75, 95)
            },
            "routes": "; ".join(
                " ".join(voyage.instance.nodes[node - 1].id for node in route)
                for route in candidate.plan.routes
            ),
        }
        for candidate in planned.candidates
    )
    chosen = planned.chosen
    trained, tested = len(chosen.training), len(chosen.held_out)
    worst = _worst(trained, planned.alpha)
    because = f"best in the worst {worst} of {trained} planned with; {tested} held out"
    return Sweep(voyage.mission.name, "planned_for", "", rows, chosen.name, because)


def _wanted(voyage: Voyage, training: Floats) -> dict[str, Floats]:
    """Different leg times to plan with, by name."""
    instance = voyage.instance
    planned = instance.travel if voyage.travel is None else voyage.travel
    quantiles = {
        f"the {100 * q:.0f} % quantile": np.quantile(training, q, axis=0, method="higher")
        for q in _QUANTILES
    }
    wanted = {"the planned times": planned, "the mean": training.mean(axis=0), **quantiles}
    distinct: dict[str, Floats] = {}  # few members have few quantiles
    for name, times in wanted.items():
        if not any(np.array_equal(times, other) for other in distinct.values()):
            distinct[name] = times
    return distinct


def recourse_completion(problem: TeamOrienteering, plan: Plan, travel: Floats) -> float:
    """Completion rate of a plan whose legs take other times; AUVs turn home when they must.

    Parameters
    ----------
    problem
        The problem.
    plan
        Its routes.
    travel
        What legs really take, in seconds, shape (n + 2, n + 2).
    """
    collected: list[int] = []
    home = problem.destination
    for route, budget in zip(plan.routes, problem.allowed, strict=True):
        now, place = 0.0, 0
        for node in route:
            there = now + travel[place, node] + problem.service[node]
            if there + travel[node, home] <= budget:
                now, place = there, node
                collected.append(node)
    return completion_rate(problem.collected(collected), problem.total_profit)


def cvar(rates: Sequence[float], alpha: float) -> float:
    """Mean of the worst share alpha of some completion rates, one of them at least."""
    return float(np.mean(sorted(rates)[: _worst(len(rates), alpha)]))


def _worst(count: int, alpha: float) -> int:
    """How many of so many members are the worst share alpha of them."""
    return max(math.ceil(alpha * count - 1e-9), 1)
