"""The roads: which legs there are, and which nodes a valuable route may need."""

import numpy as np
from scipy.spatial.distance import cdist

from fiveroute.models.branch_price.roads import Roads
from fiveroute.models.network import Network
from fiveroute.problem import TIME_TOLERANCE, TeamOrienteering


def plane(seed: int, n: int = 8) -> TeamOrienteering:
    xy = np.random.default_rng(seed).uniform(0.0, 10.0, (n + 2, 2))
    service = np.pad(np.ones(n), 1)
    return TeamOrienteering(cdist(xy, xy), service, service, [25.0, 18.0, 25.0])


def test_durations_are_the_problem_s() -> None:
    problem = plane(1)
    roads = Roads.of(Network.of(problem))
    np.testing.assert_allclose(roads.duration((3, 1)), problem.duration((3, 1)))
    assert roads.routes.tolist() == [1.0, 2.0]
    assert roads.members == ((1,), (0, 2))
    assert [roads.class_of(t) for t in (18.0, 18.1, 25.0, 25.1)] == [0, 1, 1, 2]


def test_limits_forgive_no_less_than_the_judge() -> None:
    problem = plane(1)
    roads = Roads.of(Network.of(problem))
    assert (roads.limits >= np.unique(problem.allowed)).all()
    assert (roads.limits <= np.unique(problem.budgets) * (1.0 + 2.0 * TIME_TOLERANCE)).all()


def test_nothing_enters_the_start_or_leaves_the_destination() -> None:
    roads = Roads.of(Network.of(plane(2)))
    assert np.isinf(roads.leg[:, 0]).all()
    assert np.isinf(roads.leg[-1]).all()
    assert np.isinf(roads.leg.diagonal()).all()


def test_worthless_nodes_of_a_metric_are_passed_by() -> None:
    roads = Roads.of(Network.of(plane(3)))
    gain = np.array([0.0, 1.0, -1.0, 0.0, 2.0, -3.0, 1.0, 1.0, 0.0, 0.0])
    assert roads.worth_a_visit(gain).tolist() == [0, 1, 4, 6, 7, 9]


def test_a_worthless_shortcut_is_kept() -> None:
    problem = TeamOrienteering(
        [[0, 1, 10, 9], [9, 0, 1, 9], [9, 9, 0, 1], [9, 9, 9, 0]], [0] * 4, [0, 0, 1, 0], [9.0]
    )
    roads = Roads.of(Network.of(problem))
    assert roads.worth_a_visit(np.array([0.0, -1.0, 1.0, 0.0])).tolist() == [0, 1, 2, 3]


def test_a_worthless_node_is_kept_where_the_leg_past_it_is_closed() -> None:
    roads = Roads.of(Network.of(plane(3).with_budgets([60.0])))
    gain = np.array([0.0, 1.0, -1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.0])
    closed = np.zeros(roads.leg.shape, dtype=np.bool_)
    closed[1, 3] = True
    assert 2 not in roads.worth_a_visit(gain)
    assert 2 in roads.without(closed).worth_a_visit(gain)
