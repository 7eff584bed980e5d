"""What each part of the five-tiered planner is worth: one of them changed at a time.

Every variant sails the same oceans on the same scenarios, M = 4, so that differences are taken
scenario by scenario. Variants set out with the plan of the whole planner, or with one of their own
where their names say so. What does not look ahead has a plan by rehearsal, which is made for that,
and is best compared with the short-sighted planner.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.generate import paper_scenario
from fiveroute.instance import Instance
from fiveroute.mission import plan_mission
from fiveroute.routes import Plan
from fiveroute.sea.departure import departure_plan
from fiveroute.sea.simulation import simulate_fleet
from fiveroute.sea.world import World

__all__ = [
    "FLEET",
    "VARIANTS",
    "WHOLE",
    "Ablation",
    "Trial",
    "Variant",
    "ablation_table",
    "gathered",
    "sail_variants",
    "slack_plan",
]

FLEET = 4
"""AUVs of all variants."""

_ALONE, _SHORT = "no-coordination", "short-sighted"
_RESAMPLES = 10_000
_SAMPLES = 50  # of the leg times, for S-GGARP

Planning = Callable[[Instance, int], Plan]
"""How a plan is made, of an instance and a seed."""


@dataclass(frozen=True, slots=True)
class Variant:
    """The planner with one part changed.

    Parameters
    ----------
    group, name
        What is changed, and to what.
    planner
        Who steers.
    reserve
        Standard deviations of the remaining time kept in hand.
    planning
        How its plan is made; None departs as a planner does with this reserve.
    departing_as
        That planner.
    loss
        Share of messages that are lost.
    """

    group: str
    name: str
    planner: str = "five-tier"
    reserve: float = 1.645
    planning: Planning | None = None
    departing_as: str = "five-tier"
    loss: float = 0.0


def _slack(slack: float) -> Planning:
    return lambda instance, seed: slack_plan(instance, slack, fleet_size=FLEET, seed=seed)


def slack_plan(instance: Instance, slack: float, *, fleet_size: int, seed: int = 0) -> Plan:
    """The plan of tiers 1 and 2 for straight legs that all take longer by one factor.

    Parameters
    ----------
    instance
        The mission.
    slack
        The factor, at least 1.
    fleet_size
        Number of AUVs.
    seed
        Seed of the random numbers.
    """
    legs = slack * instance.travel
    mission = plan_mission(instance, travel=legs, fleet_size=fleet_size, seed=seed)
    return mission.result.plan or Plan.empty(fleet_size)


def _paper(samples: int, quantile: float | None = None) -> Planning:
    """Tiers 1 and 2 of the paper alone, by GGA without samples or S-GGARP with them."""

    def plan(instance: Instance, seed: int) -> Plan:
        mission = plan_mission(
            instance,
            fleet_size=FLEET,
            search="paper",
            samples=samples,
            quantile=quantile,
            seed=seed,
        )
        return mission.result.plan or Plan.empty(FLEET)

    return plan


WHOLE = Variant("", "five-tier as it is")
"""What all others are compared with."""

VARIANTS = (
    Variant("coordination", "none: discarding only, its own plan", _ALONE, departing_as=_ALONE),
    Variant("coordination", "none: discarding only, the same plan", _ALONE),
    Variant("coordination", "every message lost", loss=1.0),
    Variant("coordination", "own pick-up with perfect knowledge, no auction", "own-pick-up"),
    Variant("coordination", "auction with perfect knowledge", "of-one-mind"),
    Variant("looking ahead", "none, its own plan", _SHORT, departing_as=_SHORT),
    Variant("looking ahead", "none, the same plan", _SHORT),
    Variant("looking ahead", "at sea, not before departure", departing_as=_SHORT),
    Variant("no looking ahead", "tier 5 as printed", "to-the-letter", departing_as=_SHORT),
    Variant("no looking ahead", "CBBA instead of the auction", "cbba", departing_as=_SHORT),
    Variant(
        "no looking ahead", "re-optimisation at every event", "re-optimising", departing_as=_SHORT
    ),
    Variant("reserve", "0, as in the paper", reserve=0.0),
    Variant("reserve", "0.8", reserve=0.8),
    Variant("plan", "best plan for planned times, no slack", planning=_slack(1.0)),
    Variant("plan", "slack 4 %", planning=_slack(1.04)),
    Variant("plan", "slack 8 %", planning=_slack(1.08)),
    Variant("plan", "Algorithm 1, GGA: no sampling", planning=_paper(0)),
    Variant("plan", "Algorithm 1, S-GGARP: sampled mean", planning=_paper(_SAMPLES)),
    Variant("plan", "Algorithm 1, S-GGARP: 0.9 quantile", planning=_paper(_SAMPLES, 0.9)),
)
"""All changes, one at a time."""


@dataclass(frozen=True, slots=True)
class Ablation:
    """What became of a variant.

    Parameters
    ----------
    variant
        The variant.
    completions
        Mean completion rate on every scenario.
    late_share
        Share of AUVs that came home late.
    """

    variant: Variant
    completions: tuple[float, ...]
    late_share: float


class Trial(NamedTuple):
    """What became of a variant on one scenario.

    Parameters
    ----------
    scenario
        Number of the paper scenario.
    variant
        The variant.
    completion
        Mean completion rate.
    late_share
        Share of AUVs that came home late.
    """

    scenario: int
    variant: Variant
    completion: float
    late_share: float


def sail_variants(
    scenarios: int, runs: int, *, seed: int = 0, variants: Sequence[Variant] = VARIANTS
) -> Generator[Trial]:
    """Sail all variants, the whole planner first, scenario by scenario."""
    for scenario in range(1, scenarios + 1):
        instance = paper_scenario(scenario)
        world = World.of(instance, FLEET)
        plans: dict[tuple[float, str], Plan] = {}
        for variant in (WHOLE, *variants):
            plan = _plan_of(variant, instance, world, plans, seed)
            result = simulate_fleet(
                world,
                plan,
                planner=variant.planner,
                runs=runs,
                reserve=variant.reserve,
                loss=variant.loss,
                seed=seed * 1000 + scenario,
                log=False,
            )
            late = result.late_returns / (runs * FLEET)
            yield Trial(scenario, variant, float(result.completions.mean()), late)


def _plan_of(
    variant: Variant,
    instance: Instance,
    world: World,
    plans: dict[tuple[float, str], Plan],
    seed: int,
) -> Plan:
    """The plan of a variant; one that was made before is taken again."""
    if variant.planning is not None:
        return variant.planning(instance, seed)
    key = variant.reserve, variant.departing_as
    if key not in plans:
        reserve, planner = key
        plans[key] = departure_plan(world, planner, reserve=reserve, seed=seed)
    return plans[key]


def gathered(trials: Sequence[Trial]) -> tuple[Ablation, ...]:
    """One row a variant, over the scenarios that all variants have sailed."""
    last = Counter(trial.scenario for trial in trials)
    whole = {scenario for scenario, count in last.items() if count == last.most_common(1)[0][1]}
    sailed: dict[Variant, list[Trial]] = {}
    for trial in trials:
        if trial.scenario in whole:
            sailed.setdefault(trial.variant, []).append(trial)
    return tuple(
        Ablation(
            variant,
            tuple(trial.completion for trial in rows),
            float(np.mean([trial.late_share for trial in rows])),
        )
        for variant, rows in sailed.items()
    )


def ablation_table(rows: Sequence[Ablation]) -> str:
    """The table as Markdown: means, and differences to the first row in points."""
    lines = [
        "| | | completion | difference, points | late |",
        "|---|---|---|---|---|",
    ]
    base = np.array(rows[0].completions)
    for row in rows:
        values = np.array(row.completions)
        difference = "" if row is rows[0] else _interval(100.0 * (values - base))
        lines.append(
            f"| {row.variant.group} | {row.variant.name} | {values.mean():.3f} | {difference} | "
            f"{100.0 * row.late_share:.1f} % |"
        )
    return "\n".join(lines)


def _interval(differences: NDArray[np.float64]) -> str:
    """A mean and its 95 % interval by resampling scenarios."""
    rng = np.random.default_rng(0)
    picks = rng.integers(len(differences), size=(_RESAMPLES, len(differences)))
    low, high = np.percentile(differences[picks].mean(axis=1), (2.5, 97.5)).tolist()
    return f"{differences.mean():+.1f} ({low:+.1f} to {high:+.1f})"
