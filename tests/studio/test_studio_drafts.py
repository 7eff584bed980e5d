import math
from dataclasses import replace

import pytest

from fiveroute.formats.plan_file import PlanFile
from fiveroute.instance import Fleet, Instance, Node, Point
from fiveroute.result import Result
from fiveroute.routes import Plan
from fiveroute.studio.drafts import blank, drafted
from fiveroute.studio.edits import Edit, MoveStop, RemoveNode, SetMission, SetNode, edited, kept_ids
from fiveroute.view.scene import scene_of

SEA = Instance(
    "sea",
    (Node("a", 30.0, 0.0, 2.0), Node("b", 30.0, 40.0, 3.0), Node("c", 0.0, 40.0, 4.0, 7.0)),
    Point(0.0, 0.0),
    Point(0.0, 90.0),
    Fleet(2, 2.0, 100.0),
)


def filed() -> PlanFile:
    problem = SEA.problem()
    plan = Plan.of([[1, 2], [3]])
    return PlanFile.of(SEA, problem, Result.judged(problem, plan, method="by-hand", seconds=0.1))


BENT = (
    (
        ((0.0, 0.0), (15.0, -5.0), (30.0, 0.0)),
        ((30.0, 0.0), (35.0, 20.0), (30.0, 40.0)),
        ((30.0, 40.0), (0.0, 90.0)),
    ),
    (((0.0, 0.0), (0.0, 40.0)), ((0.0, 40.0), (0.0, 90.0))),
)


def after(edit: Edit, plan: PlanFile) -> PlanFile:
    return drafted(plan, edited(plan.instance, edit), kept_ids(plan.instance, edit))


def test_still_water_times_are_those_of_straight_legs() -> None:
    draft = after(MoveStop("move", 1, 0.0, 0.0), filed())
    assert draft.routes == (("a", "b"), ("c",))
    assert draft.durations == pytest.approx(
        ((0.0 + 50.0 + math.hypot(30.0, 50.0)) / 2.0, 90.0 / 2.0 + 7.0)
    )
    assert (draft.objective, draft.bound, draft.method) == (9.0, None, "draft")


def test_paths_stay_where_their_ends_do() -> None:
    plan = replace(filed(), paths=BENT)
    moved = after(MoveStop("move", 2, 40.0, 40.0), plan)
    assert moved.paths == (
        (BENT[0][0], ((30.0, 0.0), (40.0, 40.0)), ((40.0, 40.0), (0.0, 90.0))),
        BENT[1],
    )
    renamed = after(SetNode("node", 2, replace(SEA.nodes[1], id="buoy")), plan)
    assert (renamed.routes[0], renamed.paths) == (("a", "buoy"), BENT)
    gone = after(RemoveNode("remove", 1), plan)
    assert gone.routes == (("b",), ("c",))
    assert gone.paths is not None
    assert gone.paths[0] == (((0.0, 0.0), (30.0, 40.0)), BENT[0][2])
    bent = 2.0 * math.hypot(15.0, 5.0) + 2.0 * math.hypot(5.0, 20.0) + math.hypot(30.0, 50.0)
    slower = after(SetMission("mission", "sea", replace(SEA.fleet, speed=1.0)), plan)
    assert slower.durations[0] == pytest.approx(bent)


@pytest.mark.parametrize(
    ("size", "routes"),
    [
        (1, (("a", "b"),)),
        (3, (("a", "b"), ("c",), ())),
        (None, (("a", "b"), ("c",))),
    ],
)
def test_the_fleet_grows_and_shrinks(size: int | None, routes: tuple[tuple[str, ...], ...]) -> None:
    for plan in (filed(), replace(filed(), paths=BENT)):
        draft = after(SetMission("mission", "sea", replace(SEA.fleet, size=size)), plan)
        assert draft.routes == routes
        assert len(scene_of(draft).legs) == len(routes)


def test_without_routes_nothing_is_drafted() -> None:
    draft = after(RemoveNode("remove", 1), blank(SEA))
    assert (draft.routes, draft.objective) == ((), 0.0)
    assert scene_of(draft).duration == 0.0
