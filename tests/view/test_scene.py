from dataclasses import replace
from pathlib import Path

import pytest

from fiveroute.errors import InputError
from fiveroute.formats.plan_file import PlanFile
from fiveroute.instance import Currents, Instance, Ocean, Point
from fiveroute.view.event_log import read_events
from fiveroute.view.scene import scene_of


def in_ocean(plan: PlanFile, ocean: Ocean) -> PlanFile:
    return replace(plan, instance=replace(plan.instance, ocean=ocean))


def test_scene_is_the_plan_laid_out(plan: PlanFile, log_path: Path) -> None:
    scene = scene_of(plan, runs=read_events(log_path, plan))
    assert scene.title == plan.instance.name
    assert isinstance(scene.instance, Instance)
    assert scene.chart is not None
    assert scene.duration == 9300.0
    assert len(scene.notes) == 1
    assert "drawn straight" in scene.notes[0]


def test_missing_file_of_currents_is_told(plan: PlanFile, tmp_path: Path) -> None:
    lost = in_ocean(plan, Ocean(currents=Currents(file="lost.nc")))
    scene = scene_of(lost, tmp_path)
    assert scene.chart is None
    assert "The current is not drawn" in scene.notes[0]
    assert "lost.nc" in scene.notes[0]


def test_other_file_of_currents_is_told(plan: PlanFile, tmp_path: Path) -> None:
    (tmp_path / "sea.nc").write_bytes(b"another sea")
    other = replace(in_ocean(plan, Ocean(currents=Currents(file="sea.nc"))), currents_hash="0" * 64)
    assert "another ocean" in scene_of(other, tmp_path).notes[0]


def test_still_water_has_no_chart(plan: PlanFile) -> None:
    scene = scene_of(in_ocean(plan, Ocean()))
    assert scene.chart is None
    assert scene.notes == ()


def test_plan_that_ignores_its_current_says_so(plan: PlanFile) -> None:
    assert "ignores the current" in scene_of(replace(plan, paths=None)).notes[0]


def test_unknown_node_is_refused(plan: PlanFile) -> None:
    with pytest.raises(InputError, match="'nobody': is no node"):
        scene_of(replace(plan, routes=(("a", "nobody"), ())))


def test_what_is_too_far_away_is_refused(plan: PlanFile) -> None:
    far = replace(plan.instance, ocean=Ocean(), start=Point(1e300, 0.0))
    with pytest.raises(InputError, match=r"1e\+300: coordinates .* cannot be drawn"):
        scene_of(replace(plan, instance=far, paths=None))
