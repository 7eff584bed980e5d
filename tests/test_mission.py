"""The whole mission: every option, every way it can end."""

import threading
import time
from dataclasses import replace

import numpy as np
import pytest

from fiveroute.check import check
from fiveroute.errors import InputError
from fiveroute.generate import paper_scenario, scenario
from fiveroute.instance import Fleet, Instance, Point
from fiveroute.limits import Limits, Progress
from fiveroute.mission import MissionPlan, Search, plan_mission
from fiveroute.models import brute_force
from fiveroute.result import Status
from fiveroute.tiers.preplanning import Allocation


def collected(planned: MissionPlan) -> float:
    """The data of a plan, after the judge has seen it."""
    result = planned.result
    assert result.plan is not None
    assert check(planned.problem, result.plan) == []
    assert result.objective == result.plan.objective(planned.problem)
    return result.objective


@pytest.mark.parametrize(
    ("search", "allocation"),
    [
        ("paper", "giant-route"),
        ("paper", "voronoi"),
        ("paper", "k-means"),
        ("paper", "ahc"),
        ("fleet", "giant-route"),
        ("fleet", "ahc"),
    ],
)
def test_every_search_and_every_allocation(search: Search, allocation: Allocation) -> None:
    instance = scenario("uniform", 20, 1, 3)
    planned = plan_mission(instance, allocation=allocation, search=search, seed=3)
    assert 0.5 * planned.problem.total_profit < collected(planned)
    assert (planned.allocation, planned.search) == (allocation, search)
    assert planned.result.method == search
    assert planned.result.seed == 3
    assert planned.result.bound is None
    assert sorted(planned.giant_route) == list(range(1, 21))
    assert planned.giant_route_duration == planned.problem.duration(planned.giant_route)
    assert len(planned.segments) == 3
    assert planned.routing is not None


def test_the_papers_pipeline_on_a_scenario_of_the_paper() -> None:
    planned = plan_mission(paper_scenario(1), search="paper")
    assert planned.problem.fleet_size in (3, 4)
    assert planned.fleet_estimate is not None
    assert abs(planned.fleet_estimate - planned.problem.fleet_size) <= 0.5
    assert collected(planned) > 0.85 * planned.problem.total_profit
    literal = plan_mission(paper_scenario(1), search="paper", literal=True)
    assert collected(literal) < collected(planned)


def test_the_fleet_search_starts_from_the_paper_and_is_no_worse() -> None:
    instance = scenario("clustered", 30, 2, 3)
    paper = plan_mission(instance, search="paper")
    assert collected(plan_mission(instance)) >= collected(paper)


@pytest.mark.parametrize("seed", range(3))
def test_an_exact_bound_closes_small_missions(seed: int) -> None:
    instance = scenario("clustered", 7, seed, 2)
    planned = plan_mission(instance, bound="exact")
    truth = brute_force.solve(planned.problem)
    assert planned.result.status is Status.OPTIMAL
    assert planned.result.gap == 0.0
    assert truth.objective is not None
    assert collected(planned) == pytest.approx(truth.objective)


def test_a_quick_bound_bounds() -> None:
    planned = plan_mission(scenario("uniform", 15, 2, 2), bound="quick")
    assert planned.result.bound is not None
    assert collected(planned) <= planned.result.bound <= planned.problem.total_profit


def test_a_quick_bound_is_the_same_every_time_and_proves_small_missions() -> None:
    small = [plan_mission(scenario("uniform", 15, 2, 2), bound="quick") for _ in range(2)]
    assert small[0].result.status is Status.OPTIMAL
    large = [plan_mission(scenario("uniform", 40, 3, 3), bound="quick").result for _ in range(2)]
    assert large[0].bound == large[1].bound
    assert large[0].plan == large[1].plan


def test_a_quick_bound_leaves_the_plan_of_algorithm_1_alone() -> None:
    instance = scenario("clustered", 15, 4, 3)
    alone = plan_mission(instance, search="paper").result
    bounded = plan_mission(instance, search="paper", bound="quick").result
    assert bounded.plan == alone.plan
    assert bounded.bound is not None
    assert bounded.objective is not None
    assert bounded.objective == alone.objective
    assert bounded.objective <= bounded.bound


def test_a_stated_fleet_size_counts() -> None:
    instance = scenario("uniform", 12, 3, 2)
    one, four = (plan_mission(instance, fleet_size=size) for size in (1, 4))
    assert (one.problem.fleet_size, four.problem.fleet_size) == (1, 4)
    assert collected(one) < collected(four)


def test_different_endurances() -> None:
    instance = scenario("uniform", 20, 4, 3)
    assert isinstance(instance.fleet.endurance, float)
    endurances = tuple(share * instance.fleet.endurance for share in (0.6, 1.4, 1.0))
    mixed = replace(instance, fleet=Fleet(None, 1.0, endurances))
    assert collected(plan_mission(mixed)) > 0.0


def test_unlimited_endurance_collects_everything_with_one_auv() -> None:
    instance = replace(scenario("ring", 15, 5), fleet=Fleet(None, 1.0, None))
    planned = plan_mission(instance)
    assert planned.problem.fleet_size == 1
    assert collected(planned) == planned.problem.total_profit


def test_a_mission_without_nodes_has_an_empty_plan() -> None:
    empty = replace(scenario("uniform", 5, 6, 2), nodes=())
    planned = plan_mission(empty, bound="quick")
    assert planned.result.status is Status.OPTIMAL
    assert planned.result.plan is not None
    assert planned.result.plan.routes == ((), ())


def test_a_fleet_that_cannot_reach_the_destination_is_infeasible() -> None:
    far = replace(
        scenario("uniform", 5, 7, 2), destination=Point(90e3, 0.0), fleet=Fleet(None, 1.0, 9e3)
    )
    planned = plan_mission(far, bound="quick")
    assert planned.result.status is Status.INFEASIBLE
    assert planned.result.plan is None
    assert planned.routing is None
    assert planned.segments == ()


def detour(auvs: int) -> Instance:
    """The direct leg takes 9 s, the way over either of two nodes 2 s; there is time for 5."""
    times = tuple(tuple(9.0 if (i, j) == (0, 3) else 1.0 for j in range(4)) for i in range(4))
    instance = scenario("uniform", 2, 8, auvs)
    return replace(
        instance,
        nodes=tuple(replace(node, service_time=0.0) for node in instance.nodes),
        metric="explicit",
        travel_times=times,
        fleet=Fleet(auvs, 1.0, 5.0),
    )


def test_a_detour_over_a_node_may_be_the_only_way() -> None:
    planned = plan_mission(detour(2))
    assert collected(planned) == planned.problem.total_profit
    assert all(len(route) == 1 for route in planned.result.plan.routes)  # type: ignore[union-attr]


def test_where_no_plan_is_found_and_none_ruled_out_it_says_so() -> None:
    """Three AUVs cannot share two nodes, but no single AUV's shortest way proves that."""
    assert plan_mission(detour(3)).result.status is Status.NO_SOLUTION


def test_sampled_planning_is_more_careful() -> None:
    instance = scenario("uniform", 25, 3, 2)
    planned = plan_mission(instance, search="paper")
    mean = plan_mission(instance, search="paper", samples=20)
    careful = plan_mission(instance, search="paper", samples=20, quantile=0.9)
    assert collected(planned) > collected(mean) > collected(careful)


@pytest.mark.parametrize(
    ("options", "field"),
    [
        ({"samples": 10}, "search"),
        ({"search": "paper", "quantile": 0.9}, "quantile"),
        ({"search": "paper", "samples": 10, "quantile": 0.2}, "quantile"),
        ({"search": "paper", "samples": 10**9}, "samples"),
        ({"fleet_size": 0}, "fleet.size"),
        ({"fleet_size": 2.5}, "fleet.size: 2.5"),
        ({"search": "papre"}, "search: 'papre': take one of fleet, paper"),
        ({"allocation": "ring"}, "allocation: 'ring': take one of giant-route"),
        ({"bound": "best"}, "bound: 'best': take one of none, quick, exact"),
        ({"workers": 0}, "workers: 0: must be a whole number from 1 on"),
        ({"seed": -1}, "seed: -1"),
    ],
)
def test_options_that_make_no_sense_are_refused(options: dict[str, object], field: str) -> None:
    with pytest.raises(InputError, match=field):
        plan_mission(paper_scenario(1), **options)  # type: ignore[arg-type]


@pytest.mark.parametrize("search", ["paper", "fleet"])
def test_the_seed_decides(search: Search) -> None:
    instance = scenario("uniform", 25, 9, 2)
    one, two = (plan_mission(instance, search=search, seed=7) for _ in range(2))
    assert one.result.plan == two.result.plan
    assert one.giant_route == two.giant_route


def test_an_interrupted_run_has_a_plan() -> None:
    interrupt = threading.Event()
    interrupt.set()
    planned = plan_mission(paper_scenario(4), limits=Limits(interrupt=interrupt), bound="quick")
    assert collected(planned) > 0.0


@pytest.mark.parametrize("search", ["paper", "fleet"])
def test_a_time_limit_is_kept(search: Search) -> None:
    """Far from the limit, and by processor time, so that a busy machine does not matter."""
    plan_mission(scenario("uniform", 10, 1, 2), search=search, bound="quick")  # compiles
    begin = time.process_time()
    planned = plan_mission(
        scenario("uniform", 100, 10, 3), search=search, bound="quick", limits=Limits(time=0.5)
    )
    assert time.process_time() - begin < 5.0
    assert collected(planned) > 0.0


def test_progress_is_told_step_by_step_on_one_clock() -> None:
    told: list[Progress] = []
    plan_mission(scenario("uniform", 8, 11, 2), bound="quick", progress=told.append)
    steps = [p.message for p in told if p.message in ("giant route", "routes", "bound")]
    assert steps == ["giant route", "routes", "bound"]
    assert np.all(np.diff([p.seconds for p in told]) >= 0.0)


def test_the_instance_is_left_alone() -> None:
    instance = scenario("uniform", 12, 12, 2)
    before = repr(instance)
    plan_mission(instance)
    assert repr(instance) == before
