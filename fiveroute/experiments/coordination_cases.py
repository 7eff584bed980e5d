"""The paper's Figs. 5 and 9 to 11: what coordination does in single missions.

A case is one scenario that one fleet sails many times with and without tier 5, by the same plan
and with the same luck. The run that is shown is the one whose gain is nearest to the mean, so that
it is typical and not the best; all gains are told beside it.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fiveroute.generate import paper_scenario
from fiveroute.instance import Instance
from fiveroute.routes import Plan, Route
from fiveroute.sea.agents.auction import assign_by_auction
from fiveroute.sea.courses.course import Course
from fiveroute.sea.courses.discarding import discard
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.sea.courses.picking import offers
from fiveroute.sea.departure import departure_plan
from fiveroute.sea.planners.to_the_letter import ToTheLetter
from fiveroute.sea.run import Run
from fiveroute.sea.run_result import RunResult
from fiveroute.sea.simulation import simulate_fleet
from fiveroute.sea.world import World

__all__ = ["CASES", "Case", "Round", "Sailed", "busiest_auction", "sail_case"]

CASES = ((3, 3), (5, 4))
"""Scenario and number of AUVs of the cases shown: one with idle nodes, one with almost none."""


@dataclass(frozen=True, slots=True)
class Sailed:
    """What became of a plan in one run.

    Parameters
    ----------
    completion
        Completion rate.
    routes
        Nodes that every AUV collected, in their order.
    lost
        Nodes of the plan that nobody collected.
    gained
        Nodes collected by an AUV that did not have them in the plan.
    """

    completion: float
    routes: tuple[Route, ...]
    lost: frozenset[int]
    gained: frozenset[int]

    @classmethod
    def of(cls, run: RunResult, plan: Plan) -> Sailed:
        """What a run with a log did."""
        routes = tuple(
            tuple(e.node for e in run.events if e.auv == auv and e.kind == "collect" and e.node)
            for auv in range(len(plan.routes))
        )
        visited = Plan(routes).visited
        gained = {
            node
            for route, planned in zip(routes, plan.routes, strict=True)
            for node in route
            if node not in planned
        }
        return cls(run.completion, routes, plan.visited - visited, frozenset(gained))


@dataclass(frozen=True, slots=True, eq=False)
class Case:
    """One plan, carried out with and without coordination.

    Parameters
    ----------
    scenario
        Number of the paper scenario.
    instance, world, plan
        The mission, and the routes with which the fleet sets out.
    alone, together
        All runs without and with tier 5.
    """

    scenario: int
    instance: Instance
    world: World
    plan: Plan
    alone: tuple[RunResult, ...]
    together: tuple[RunResult, ...]

    @property
    def planned(self) -> float:
        """Completion rate of the plan."""
        return self.world.completion(self.plan.objective(self.world.problem))

    @property
    def gains(self) -> NDArray[np.float64]:
        """What coordination adds to the completion rate of every run, shape (runs,)."""
        return np.array(
            [b.completion - a.completion for a, b in zip(self.alone, self.together, strict=True)]
        )

    @property
    def typical(self) -> int:
        """The run whose gain is nearest to the mean."""
        return int(np.abs(self.gains - self.gains.mean()).argmin())


def sail_case(scenario: int, fleet_size: int, runs: int, seed: int = 0) -> Case:
    """Sail a scenario with and without coordination."""
    instance = paper_scenario(scenario)
    world = World.of(instance, fleet_size)
    plan = departure_plan(world, seed=seed)
    alone, together = (
        simulate_fleet(world, plan, planner=planner, runs=runs, seed=seed * 1000 + scenario).runs
        for planner in ("no-coordination", "five-tier")
    )
    return Case(scenario, instance, world, plan, alone, together)


@dataclass(frozen=True, slots=True, eq=False)
class Round:
    """One round of an auction.

    Parameters
    ----------
    auvs
        The bidders.
    nodes
        The nodes on offer.
    psi
        What they are worth, (27), in data per second, shape (auvs, nodes).
    won
        Column of the node that each bidder won; -1 for none.
    """

    auvs: tuple[int, ...]
    nodes: tuple[int, ...]
    psi: NDArray[np.float64]
    won: tuple[int, ...]


def busiest_auction(world: World, plan: Plan, runs: int, seed: int = 0) -> tuple[Round, ...]:
    """The rounds of the auction with most rivalry, of all that a fleet holds in some runs.

    The fleet follows the fifth tier as the paper prints it (`to-the-letter`), for which all idle
    nodes are auctioned at every event. Nothing is returned if nobody ever bids.
    """
    best: tuple[Round, ...] = ()
    view = world.outlook(reserve=0.0)
    for number in range(runs):
        never = (float("inf"),) * world.problem.fleet_size
        run = Run(world.problem, world.luck(seed, number), never)
        crew = _Listener(run, view, plan)
        run.sail(crew)
        best = max([best, *crew.auctions], key=_rivalry)
    return best


class _Listener(ToTheLetter):
    """Steers, and takes every auction down."""

    def __init__(self, run: Run, view: Outlook, plan: Plan) -> None:
        super().__init__(run, view, plan)
        self.auctions: list[tuple[Round, ...]] = []

    def steer(self, auv: int, t: float) -> int:
        """The next vertex of an AUV."""
        here, dropped = discard(self.view, self.at_node(auv, t))
        active = self.active
        courses = [here if m == auv else self.course(m, t) for m in active]
        self.auctions.append(_rounds(self.view, active, courses, self.idle.union(dropped)))
        return super().steer(auv, t)


def _rounds(
    view: Outlook, auvs: Sequence[int], courses: Sequence[Course], idle: Collection[int]
) -> tuple[Round, ...]:
    """The rounds of an auction, as `fiveroute.tiers.coordination.assign_idle_nodes` holds it."""
    fleet, left, rounds = list(courses), np.array(sorted(idle), dtype=np.int64), []
    while len(left):
        bids = [offers(view, course, left) for course in fleet]
        psi = np.array([values for values, _ in bids])
        won = assign_by_auction(psi)
        if won.max(initial=-1) < 0:
            break
        rounds.append(Round(tuple(auvs), tuple(left.tolist()), psi, tuple(won.tolist())))
        for m, j in enumerate(won.tolist()):
            if j >= 0:
                fleet[m] = fleet[m].with_node(int(left[j]), int(bids[m][1][j]))
        left = np.delete(left, won[won >= 0])
    return tuple(rounds)


def _rivalry(rounds: Sequence[Round]) -> tuple[int, int]:
    """Nodes that several AUVs want, and nodes that change hands."""
    wanted = int(((rounds[0].psi > 0.0).sum(axis=0) > 1).sum()) if rounds else 0
    return wanted, sum(j >= 0 for r in rounds for j in r.won)
