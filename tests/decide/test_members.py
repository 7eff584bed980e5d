"""Members of an ensemble: files at the mission's place and time, and what legs take in them."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fiveroute.decide.members import drawn_members, filed_members, lost_share, member_times
from fiveroute.errors import InputError
from fiveroute.generate import generate
from fiveroute.instance import Currents, Fleet, Instance, Node, Ocean, Point, Vortex
from fiveroute.ocean.local_plane import LocalPlane
from fiveroute.ocean.stated import stated_current
from fiveroute.ocean.uncertain_ocean import VortexUncertainty
from fiveroute.paths.voyage import Voyage

Write = Callable[..., Path]


@pytest.fixture
def mission(write: Write) -> Instance:
    """One node to the east of the start, in water that moves to the east at 0.2 m/s."""
    write("sea.nc")
    return Instance(
        "bay",
        (Node("a", 2000.0, 0.0, 1.0),),
        Point(0.0, 0.0),
        Point(0.0, 2000.0),
        Fleet(1, 1.0, 9000.0),
        ocean=Ocean(Currents(file="sea.nc")),
    )


def times(mission: Instance, member: Path) -> tuple[float, float]:
    """There and back between start and node, in a member."""
    (ocean,) = filed_members(mission, [member], member.parent)
    table = member_times(Voyage.straight(mission), ocean)
    return float(table[0, 1]), float(table[1, 2])


def test_a_leg_takes_its_time_in_the_member(mission: Instance, write: Write) -> None:
    there, back = times(mission, write("member.nc", 0.5))
    assert there == pytest.approx(2000.0 / 1.5, rel=1e-3)
    across, along = 0.5 * np.sqrt(0.5), -0.5 * np.sqrt(0.5)
    made_good = along + np.sqrt(1.0 - across**2)
    assert back == pytest.approx(2000.0 * np.sqrt(2.0) / made_good, rel=1e-3)


def test_grids_and_names_may_be_others(mission: Instance, write: Write) -> None:
    """The middle of the member's own data lies to the east, and the sea stays where it is."""
    land = slice(16, 18)  # 4.88 to 4.89 degrees, beyond the node
    plain = times(mission, write("plain.nc", 0.5))
    assert times(mission, write("fine.nc", 0.5, cells=41)) == pytest.approx(plain, rel=1e-3)
    assert times(mission, write("uv.nc", 0.5, names=("u", "v"))) == pytest.approx(plain, rel=1e-3)
    assert times(mission, write("far.nc", 0.5, land=land)) == pytest.approx(plain, rel=1e-3)
    assert times(mission, write("narrow.nc", 0.5, west=-0.02)) == pytest.approx(plain, rel=1e-3)


def test_a_member_is_met_when_the_mission_begins(mission: Instance, write: Write) -> None:
    plain = times(mission, write("plain.nc", 0.4))
    earlier = write("earlier.nc", 0.2, begin="2020-02-29T23:00")  # 0.4 m/s an hour later
    assert times(mission, earlier) == pytest.approx(plain, rel=1e-3)
    with pytest.raises(InputError, match=r"later\.nc, begin: .*2020-03-01T00:00:00.* within"):
        times(mission, write("later.nc", begin="2020-03-01T01:00"))


def test_without_a_file_of_its_own_the_first_member_states_place_and_time(
    mission: Instance, write: Write, tmp_path: Path
) -> None:
    bare = replace(mission, ocean=Ocean())
    files = [write("one.nc", 0.4), write("two.nc", 0.2, begin="2020-02-29T23:00", west=-0.06)]
    one, two = filed_members(bare, files, tmp_path)
    assert np.array(one(0.0, 0.0)) == pytest.approx(np.array(two(0.0, 0.0)), abs=1e-6)
    assert times(bare, files[0])[0] == pytest.approx(2000.0 / 1.4, rel=1e-3)


def test_a_stop_beyond_the_data_or_on_land_names_the_member(
    mission: Instance, write: Write
) -> None:
    with pytest.raises(InputError, match=r"small\.nc, uo, vo: .*data cover"):
        times(mission, write("small.nc", west=0.01))
    with pytest.raises(InputError, match=r"land\.nc, nodes\[0\]: .*the land of the mask"):
        times(mission, write("land.nc", land=slice(13, 15)))


def test_a_leg_over_land_cannot_be_sailed(mission: Instance, write: Write) -> None:
    member = write("island.nc", land=slice(12, 13))
    assert times(mission, member) == (np.inf, np.inf)
    (ocean,) = filed_members(mission, [member], member.parent)
    voyage = Voyage.straight(mission)
    assert lost_share(voyage, member_times(voyage, ocean)) == pytest.approx(2.0 / 3.0)
    assert lost_share(voyage, mission.travel) == 0


def test_a_leg_against_too_strong_a_current_cannot_be_sailed(
    mission: Instance, write: Write
) -> None:
    there, back = times(mission, write("strong.nc", 1.2))
    assert there == pytest.approx(2000.0 / 2.2, rel=1e-3)
    assert back == np.inf


def test_the_forecast_as_a_member_takes_the_planned_times() -> None:
    still = replace(generate("uniform", nodes=8, seed=5), ocean=Ocean())
    times = member_times(Voyage.straight(still), stated_current(still))
    assert times[:-1, 1:] == pytest.approx(still.travel[:-1, 1:], rel=1e-9)


def test_drawn_members_have_their_vortices_moved() -> None:
    vortex = Vortex(x=5000.0, y=5000.0, circulation=3000.0, radius=1500.0)
    mission = replace(generate("uniform", nodes=3, seed=5), ocean=Ocean(Currents((vortex,))))
    moved = VortexUncertainty(displacement=100.0)
    members = drawn_members(mission, 5, moved, np.random.default_rng(0))
    velocities = {tuple(map(float, member(5500.0, 5000.0))) for member in members}
    assert len(velocities) == 5
    (still,) = drawn_members(mission, 1, VortexUncertainty(), np.random.default_rng(0))
    assert still(5500.0, 5000.0) == stated_current(mission)(5500.0, 5000.0)


def test_without_vortices_there_is_nothing_to_draw_from() -> None:
    still = replace(generate("uniform", nodes=3, seed=5), ocean=Ocean())
    with pytest.raises(InputError, match="vortices"):
        drawn_members(still, 3, VortexUncertainty(), np.random.default_rng(0))


def test_the_plane_of_a_file_is_read_back(mission: Instance) -> None:
    placed = replace(mission, crs=LocalPlane(4.8, 60.6).proj)
    assert placed.origin == (4.8, 60.6)
