"""The integer programme alone: what goes in comes out, and what is cut off stays out."""

from __future__ import annotations

import numpy as np
import pytest

from fiveroute.limits import Limits
from fiveroute.models.flow_program import FlowProgram, Routes, arcs_of
from fiveroute.models.highs import Outcome
from fiveroute.models.network import Network
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan


def whole(problem: TeamOrienteering) -> FlowProgram:
    """The model with every arc that a route can use."""
    network = Network.of(problem)
    arcs = network.usable(np.arange(network.n + 1))
    needed = np.zeros(network.size, dtype=np.bool_)
    return FlowProgram(
        network, arcs, needed, Limits().start(), on_bound=lambda _: None, on_routes=lambda _: None
    )


def line(budgets: list[float]) -> TeamOrienteering:
    """Start, three nodes and destination in a row, 1 s apart, with data 1, 2 and 4."""
    x = np.arange(5.0)
    return TeamOrienteering(abs(x[:, None] - x), np.zeros(5), [0, 1, 2, 4, 0], budgets)


def test_the_optimum_and_its_routes() -> None:
    program = whole(line([4.0]))
    assert program.solve(gap=0.0) is Outcome.OPTIMAL
    assert program.bound == pytest.approx(7.0, abs=1e-5)
    assert program.routes() == Routes([(0, (1, 2, 3))], [])


def test_a_route_belongs_to_the_class_whose_budget_it_needs() -> None:
    """Node 2 takes 4 s to serve, which only the second AUV has."""
    x = np.arange(3.0)
    problem = TeamOrienteering(abs(x[:, None] - x), [0, 4, 0], [0, 1, 0], [2.0, 6.0, 2.0])
    program = whole(problem)
    assert program.solve(gap=0.0) is Outcome.OPTIMAL
    found = program.routes()
    assert found is not None
    assert sorted(found.routes) == [(0, ()), (0, ()), (1, (1,))]


def test_a_forbidden_route_gives_way() -> None:
    program = whole(line([4.0]))
    program.forbid(0, (1, 2, 3))
    assert program.solve(gap=0.0) is Outcome.OPTIMAL
    assert program.routes() == Routes([(0, (2, 3))], [])


def test_cycles_that_take_no_time_are_seen_and_forbidden() -> None:
    """Nodes 1 and 2 share one place 3 s away, node 3 lies 3 s away in the other direction.

    One route of 7 s reaches either; the clock alone lets the pair go round and round besides.
    """
    y = np.array([0.0, 3.0, 3.0, -3.0, 0.0])
    problem = TeamOrienteering(abs(y[:, None] - y), np.zeros(5), [0, 1, 1, 1, 0], [7.0])
    program = whole(problem)
    assert program.solve(gap=0.0) is Outcome.OPTIMAL
    found = program.routes()
    assert found is not None
    assert found.routes == [(0, (3,))]
    assert [set(cycle) for cycle in found.cycles] == [{1, 2}]
    program.forbid_cycle(found.cycles[0])
    assert program.solve(gap=0.0) is Outcome.OPTIMAL
    found = program.routes()
    assert found is not None
    assert [set(route) for _, route in found.routes] == [{1, 2}]
    assert found.cycles == []


def test_needed_nodes_are_visited() -> None:
    """Alone node 3 would be worth more."""
    problem = TeamOrienteering(np.ones((5, 5)), np.zeros(5), [0, 1, 2, 4, 0], [2.0])
    network = Network.of(problem)
    program = FlowProgram(
        network,
        network.usable(np.arange(4)),
        np.arange(network.size) == 1,
        Limits().start(),
        on_bound=lambda _: None,
        on_routes=lambda _: None,
    )
    assert program.solve(gap=0.0) is Outcome.OPTIMAL
    assert program.routes() == Routes([(0, (1,))], [])


def test_a_plan_that_is_handed_over_is_kept() -> None:
    """With any gap allowed, the solver ends with what it began with or better."""
    program = whole(line([4.0, 9.0]))
    program.start_from(Plan.of([[3], [1, 2]]))
    program.solve(gap=1e9)
    routes = program.routes()
    assert routes is not None
    assert {node for _, route in routes.routes for node in route} == {1, 2, 3}


def test_arcs_of_a_plan() -> None:
    problem = line([4.0, 9.0])
    used = arcs_of(Network.of(problem), Plan.of([[2], []]))
    assert np.argwhere(used).tolist() == [[0, 2], [0, 5], [2, 4]]
