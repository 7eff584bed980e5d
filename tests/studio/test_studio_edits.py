from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.errors import InputError
from fiveroute.instance import Fleet, Instance, Node, Point
from fiveroute.studio.drafts import blank
from fiveroute.studio.edits import (
    AddNode,
    Edit,
    MoveStop,
    RemoveNode,
    SetMission,
    SetNode,
    edited,
    kept_ids,
)
from fiveroute.studio.project import Project
from fiveroute.studio.session import Session, Version

MISSION = Instance(
    "ring",
    (Node("a", 0.0, 1.0, 1.0), Node("b", 1.0, 0.0, 5.0), Node("n3", 0.0, -1.0, 9.0)),
    Point(0.0, 0.0),
    Point(0.0, 0.0),
    Fleet(2, 1.0, 100.0),
)

TABLE = replace(
    MISSION,
    metric="explicit",
    travel_times=tuple(tuple(float(10 * i + j) for j in range(5)) for i in range(5)),
)


def test_start_and_destination_move_together_where_they_coincide() -> None:
    both = edited(MISSION, MoveStop("move", 4, 3.0, 4.0))
    assert both.start == both.destination == Point(3.0, 4.0)
    parted = edited(MISSION, MoveStop("move", 4, 3.0, 4.0, alone=True))
    assert (parted.start, parted.destination) == (Point(0.0, 0.0), Point(3.0, 4.0))
    assert edited(parted, MoveStop("move", 0, 1.0, 1.0)).destination == Point(3.0, 4.0)


def test_a_new_node_has_a_free_name_and_middling_data() -> None:
    more = edited(edited(MISSION, AddNode("add", 7.0, 8.0)), RemoveNode("remove", 1))
    assert [node.id for node in more.nodes] == ["b", "n3", "n4"]
    assert more.nodes[-1] == Node("n4", 7.0, 8.0, 5.0)
    again = edited(more, AddNode("add", 0.0, 0.0, 2.5))
    assert (again.nodes[-1].id, again.nodes[-1].data) == ("n5", 2.5)
    assert edited(replace(MISSION, nodes=()), AddNode("add", 0.0, 0.0)).nodes[0].data == 1.0


def test_ids_are_followed() -> None:
    renamed = SetNode("node", 2, replace(MISSION.nodes[1], id="buoy"))
    assert edited(MISSION, renamed).nodes[1].id == "buoy"
    assert kept_ids(MISSION, renamed) == {"a": "a", "b": "buoy", "n3": "n3"}
    assert kept_ids(MISSION, RemoveNode("remove", 3)) == {"a": "a", "b": "b"}


def test_a_table_of_leg_times_loses_the_node_and_keeps_its_places() -> None:
    rest = edited(TABLE, RemoveNode("remove", 2))
    kept = (0, 1, 3, 4)
    assert rest.travel_times == tuple(tuple(float(10 * i + j) for j in kept) for i in kept)
    assert edited(TABLE, SetNode("node", 1, replace(TABLE.nodes[0], data=3.0))).nodes[0].data == 3.0
    for edit in (
        MoveStop("move", 1, 0.0, 0.0),
        AddNode("add", 0.0, 0.0),
        SetNode("node", 1, replace(TABLE.nodes[0], x=5.0)),
    ):
        with pytest.raises(InputError, match="travel_times: states the time of every leg"):
            edited(TABLE, edit)


numbers = st.floats(-1e4, 1e4)
edits = st.one_of(
    st.builds(MoveStop, st.just("move"), st.integers(-1, 6), numbers, numbers, st.booleans()),
    st.builds(AddNode, st.just("add"), numbers, numbers),
    st.builds(RemoveNode, st.just("remove"), st.integers(0, 5)),
    st.builds(
        SetMission,
        st.just("mission"),
        st.sampled_from(["ring", "other"]),
        st.builds(Fleet, st.integers(1, 4), st.floats(0.5, 2.0), st.none() | st.floats(1.0, 1e4)),
    ),
)


@given(wanted=st.lists(edits, max_size=12))
@settings(deadline=None, max_examples=40)
def test_undo_goes_back_and_redo_forth(wanted: list[Edit]) -> None:
    session = Session(Version(blank(MISSION), False), Path("ring.json"), Project(Path()))
    seen = [MISSION]
    for edit in wanted:
        try:
            session.edit(session.progress()["revision"], edit)
        except InputError:
            continue
        if session.version.instance != seen[-1]:
            seen.append(session.version.instance)
    for mission in reversed(seen[:-1]):
        session.step(-1)
        assert session.version.instance == mission
    session.step(-1)
    assert session.version.instance == MISSION
    for mission in seen[1:]:
        session.step(1)
        assert session.version.instance == mission
