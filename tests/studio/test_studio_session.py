"""Editing, planning, undoing, saving, through the server."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from fiveroute.errors import InputError
from fiveroute.formats import read_instance, read_plan
from fiveroute.studio.edits import AddNode
from fiveroute.studio.requests import answer
from fiveroute.studio.session import Session
from fiveroute.verdict import judge

Until = Callable[[Callable[[], bool]], None]


def gap(state: dict[str, Any]) -> float:
    return float(state["view"]["scenes"][0]["gap"])


def test_edit_plan_edit_undo(caller: Any) -> None:
    assert caller.read()["planned"] is False
    first = caller.planned(bound="exact")
    assert first["planned"]
    (scene,) = first["view"]["scenes"]
    assert (scene["routes"], scene["objective"], scene["gap"]) == ([[1, 2]], 5.0, 0.0)

    near = caller.edit(do="move", vertex=3, x=1400.0, y=200.0)
    assert (near["planned"], near["undo"]) == (False, True)
    (draft,) = near["view"]["scenes"]
    assert (draft["bound"], draft["routes"]) == (None, [[1, 2]])
    assert draft["points"][6:8] == [1400.0, 200.0]
    second = caller.planned(bound="exact")
    assert second["view"]["scenes"][0]["objective"] == 9.0

    back = caller.write("/api/undo")
    assert (back["planned"], back["redo"]) == (True, True)
    assert back["view"]["scenes"][0]["objective"] == 5.0
    again = caller.write("/api/redo")
    assert again["view"]["scenes"][0]["objective"] == 9.0


def test_the_fleet_and_the_nodes_change(caller: Any) -> None:
    caller.planned()
    fleet = caller.read()["mission"]["fleet"]
    two = caller.edit(do="mission", name="two", fleet={**fleet, "size": 2, "endurance": 7000})
    assert two["view"]["scenes"][0]["routes"] == [[1, 2], []]
    assert caller.planned()["view"]["scenes"][0]["objective"] == 9.0

    added = caller.edit(do="add", x=100.0, y=100.0)
    assert added["mission"]["nodes"][-1] == {"id": "n4", "x": 100.0, "y": 100.0, "data": 3.0}
    node = {"id": "a2", "x": 400.0, "y": 300.0, "data": 7.5, "depth": 20.0}
    changed = caller.edit(do="node", vertex=1, node=node)
    assert changed["mission"]["nodes"][0] == node
    removed = caller.edit(do="remove", vertex=2)
    assert [node["id"] for node in removed["mission"]["nodes"]] == ["a2", "far", "n4"]
    routes = {node for route in removed["view"]["scenes"][0]["routes"] for node in route}
    assert routes == {1, 2}


def test_a_new_name_leaves_the_plan_alone(caller: Any) -> None:
    caller.planned()
    fleet = caller.read()["mission"]["fleet"]
    assert caller.edit(do="mission", name="harbour", fleet=fleet)["planned"]


@pytest.mark.parametrize(
    ("edit", "sentence"),
    [
        ({"do": "move", "vertex": 9, "x": 0.0, "y": 0.0}, "vertex: 9: is no node"),
        ({"do": "move", "vertex": 1, "x": "0", "y": 0.0}, "edit.x: '0': must be a number"),
        ({"do": "remove", "vertex": 0}, "vertex: 0: is no node"),
        ({"do": "add", "x": 0.0, "y": 0.0, "data": -1.0}, "edit.data: -1.0"),
        (
            {"do": "node", "vertex": 1, "node": {"id": "b", "x": 0.0, "y": 0.0, "data": 1.0}},
            "nodes[1].id: 'b': is the id of nodes[0] too",
        ),
        (
            {
                "do": "mission",
                "name": "x",
                "fleet": {"size": 2, "speed": 1.0, "endurance": [10.0, 10.0, 10.0]},
            },
            "fleet.size: 2: endurance has 3 entries",
        ),
    ],
)
def test_wrong_edits_are_one_line(caller: Any, edit: dict[str, Any], sentence: str) -> None:
    before = caller.read()["mission"]
    reply = caller("POST", "/api/edit", {"revision": 0, "edit": edit})
    assert reply.status == 400
    assert sentence in reply.doc["error"]
    assert "\n" not in reply.doc["error"]
    assert caller.read()["mission"] == before


def test_an_edit_of_what_has_changed_meanwhile_is_refused(caller: Any) -> None:
    caller.edit(do="remove", vertex=1)
    reply = caller("POST", "/api/edit", {"revision": 0, "edit": {"do": "remove", "vertex": 1}})
    assert reply.status == 400
    assert "in another window" in reply.doc["error"]


def test_planning_can_be_stopped(caller: Any, until: Until) -> None:
    """A mission that takes long to prove; what is found so far is kept."""
    for k in range(40):
        caller.studio.session.edit(
            k, AddNode("add", 37.0 * (k * 7 % 50), 31.0 * (k * 11 % 40) - 600.0, 1.0 + k % 7)
        )
    caller.write("/api/plan", {"seconds": 600, "bound": "exact"})
    until(lambda: caller.read("/api/progress")["job"]["objective"] is not None)
    running = caller.read("/api/progress")["job"]
    assert running["state"] == "running"
    assert running["bound"] >= running["objective"]
    caller.write("/api/stop")
    until(lambda: caller.read("/api/progress")["job"]["state"] != "running")
    state = caller.read()
    assert state["job"]["state"] == "stopped"
    assert state["planned"]
    assert gap(state) > 0.0


def test_an_edit_ends_the_work_on_what_it_changes(caller: Any) -> None:
    caller.write("/api/plan", {"seconds": 600})
    state = caller.edit(do="move", vertex=1, x=410.0, y=300.0)
    assert (state["job"], state["planned"]) == (None, False)
    assert caller.planned()["planned"]


def test_a_plan_that_cannot_be_is_told(caller: Any) -> None:
    fleet = caller.read()["mission"]["fleet"]
    caller.edit(do="mission", name="short", fleet={**fleet, "endurance": 5.0})
    state = caller.planned()
    assert state["job"]["state"] == "failed"
    assert state["job"]["error"]
    assert state["planned"] is False


def test_saving_asks_before_it_overwrites(caller: Any, mission_path: Path) -> None:
    text = mission_path.read_text(encoding="utf-8")
    state = caller.edit(do="move", vertex=0, x=-100.0, y=0.0)
    assert state["saved"] is False
    reply = caller("POST", "/api/save", {"instance": "bay"})
    assert (reply.status, reply.doc["exists"]) == (409, ["bay.json"])
    assert mission_path.read_text(encoding="utf-8") == text
    early = caller("POST", "/api/save", {"instance": "new", "plan": "plan"})
    assert (early.status, "plan it anew first" in early.doc["error"]) == (400, True)

    caller.planned()
    caller.write("/api/save", {"instance": "bay", "plan": "plan", "overwrite": True})
    assert caller.read()["saved"]
    assert read_instance(mission_path).start.x == -100.0
    plan = read_plan(mission_path.with_name("plan.json"), read_instance(mission_path))
    assert judge(plan.instance, plan, mission_path.parent).feasible
    assert sorted(path.name for path in mission_path.parent.iterdir()) == ["bay.json", "plan.json"]


@pytest.mark.parametrize(
    "name", ["../out", "a/b", "/tmp/out", "..", ".hidden", "a\\b", "a\0b", "x" * 160, " ", "con:"]
)
def test_names_do_not_lead_out_of_the_folder(caller: Any, tmp_path: Path, name: str) -> None:
    before = sorted(tmp_path.iterdir())
    reply = caller("POST", "/api/save", {"instance": name, "overwrite": True})
    assert reply.status == 400
    assert sorted(tmp_path.iterdir()) == before


def test_links_do_not_lead_out_of_the_folder(
    caller: Any, tmp_path: Path, tmp_path_factory: pytest.TempPathFactory
) -> None:
    outside = tmp_path_factory.mktemp("outside") / "file.json"
    outside.write_text("mine", encoding="utf-8")
    (tmp_path / "link.json").symlink_to(outside)
    reply = caller("POST", "/api/save", {"instance": "link.json", "overwrite": True})
    assert (reply.status, "leads out" in reply.doc["error"]) == (400, True)
    assert outside.read_text(encoding="utf-8") == "mine"


def test_export_goes_into_the_folder(caller: Any, tmp_path: Path) -> None:
    early = caller("POST", "/api/export", {"format": "gpx", "name": "out"})
    assert early.status == 400
    caller.planned()
    wish = {"format": "gpx", "name": "out", "depth": 10.0}
    answer = caller.write("/api/export", wish)
    assert answer == {"name": "out.gpx", "vehicles": ["auv-1"]}
    assert "<gpx" in (tmp_path / "out.gpx").read_text(encoding="utf-8")
    assert caller("POST", "/api/export", wish).status == 409
    unknown = caller("POST", "/api/export", {"format": "qcg", "name": "out"})
    assert "did you mean 'qgc'" in unknown.doc["error"]
    out = caller("POST", "/api/export", {"format": "moos", "name": "../out"})
    assert "is no plain file name" in out.doc["error"]


def test_export_takes_what_the_command_takes(caller: Any, tmp_path: Path) -> None:
    caller.edit(do="mission", name="bay", fleet={"size": 2, "speed": 1.0, "endurance": 3200.0})
    caller.planned()
    wish = {
        "format": "csv",
        "name": "out",
        "depth": 10.0,
        "auv": 2,
        "vehicles": ["ann", "bea"],
        "departure": "2016-01-31T13:00:00+01:00",
        "tolerance": 0.0,
    }
    assert caller.write("/api/export", wish)["vehicles"] == ["bea"]
    there = (tmp_path / "out.csv").read_text(encoding="utf-8")
    assert "2016-01-31T12:00:00Z" in there
    wish |= {"departure": "2016-01-31T12:00", "overwrite": True}
    caller.write("/api/export", wish)
    assert (tmp_path / "out.csv").read_text(encoding="utf-8") == there
    for wrong, told in (
        ({"vehicles": ["ann"]}, "vehicle: 1: must be given 2 times"),
        ({"auv": 3}, "auv: 3: is no AUV of the plan; there are 2"),
        ({"departure": "noon"}, "departure: 'noon'"),
        ({"tolerance": -1.0}, "tolerance: -1.0"),
    ):
        reply = caller("POST", "/api/export", wish | wrong)
        assert (reply.status, told in reply.doc["error"]) == (400, True), reply.doc
        assert "\n" not in reply.doc["error"]


def test_unsafe_exports_are_refused(mission_path: Path, until: Until) -> None:
    """Straight lines through an obstacle."""
    document = json.loads(mission_path.read_text(encoding="utf-8"))
    document["ocean"] = {"obstacles": [{"x": 1500.0, "y": -100.0, "radius": 120.0}]}
    mission_path.write_text(json.dumps(document), encoding="utf-8")
    session = Session.opened(mission_path)
    answer(session, "/api/plan", b'{"straight_lines": true}')
    until(lambda: session.progress()["job"]["state"] != "running")
    with pytest.raises(InputError, match="obstacle"):
        answer(session, "/api/export", b'{"format": "gpx", "name": "out", "depth": 10.0}')
    assert [path.name for path in mission_path.parent.iterdir()] == ["bay.json"]


def test_a_saved_plan_opens_as_it_was(caller: Any, tmp_path: Path) -> None:
    caller.planned()
    caller.write("/api/save", {"plan": "plan"})
    told = json.loads(json.dumps(Session.opened(tmp_path / "plan.json").told()))
    assert told["planned"]
    assert told["view"]["scenes"] == caller.read()["view"]["scenes"]


def test_without_a_file_the_sea_is_empty(tmp_path: Path) -> None:
    session = Session.opened(None, tmp_path)
    told = session.told()
    assert (told["mission"]["nodes"], told["planned"]) == ((), False)
    with pytest.raises(InputError, match="is no folder"):
        Session.opened(None, tmp_path / "missing")
