from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan

LINE = TeamOrienteering(
    travel=[[abs(i - j) for j in range(5)] for i in range(5)],
    service=[0, 1, 1, 1, 0],
    profit=[0, 2, 3, 5, 0],
    budgets=[10, 10],
)


def test_objective_durations_and_idle_nodes() -> None:
    plan = Plan.of([[1, 3], []])
    assert plan.objective(LINE) == 7
    assert plan.durations(LINE) == (6.0, 4.0)
    assert plan.visited == {1, 3}
    assert plan.idle(LINE) == (2,)


def test_a_node_visited_twice_counts_once() -> None:
    assert Plan.of([[1], [1]]).objective(LINE) == 2


def test_the_empty_plan_sends_every_auv_straight_home() -> None:
    plan = Plan.empty(2)
    assert plan.routes == ((), ())
    assert plan.objective(LINE) == 0
    assert plan.durations(LINE) == (4.0, 4.0)
