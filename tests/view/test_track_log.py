"""Runs are played as they were sailed, where their tracks are known."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from fiveroute.errors import InputError
from fiveroute.formats.plan_file import PlanFile
from fiveroute.formats.track_file import trajectories, write_tracks
from fiveroute.view.event_log import RunLog, read_events
from fiveroute.view.looks import load_scenes, write_look
from fiveroute.view.scene import scene_of
from fiveroute.view.track_log import with_tracks

ROUND = np.array([[0.0, 0.0, 0.0], [500.0, 0.0, 9000.0], [1040.0, 1000.0, 0.0]])
FAILED = np.array([[0.0, 0.0, 0.0], [3500.0, 700.0, 900.0]])
NONE = np.zeros((0, 3))
RUNS = [(0, (NONE, NONE)), (1, (ROUND, FAILED)), (7, (ROUND, NONE))]


@pytest.fixture
def runs(plan: PlanFile, log_path: Path) -> tuple[RunLog, ...]:
    return read_events(log_path, plan)


@pytest.fixture
def track_path(plan: PlanFile, tmp_path: Path) -> Path:
    path = tmp_path / "tracks.nc"
    write_tracks(plan.instance, RUNS[1:], path)
    return path


def test_tracks_belong_to_their_runs(runs: tuple[RunLog, ...], track_path: Path) -> None:
    (second,) = with_tracks(runs[1:], track_path, 2)
    assert second.tracks is not None
    first, other = second.tracks
    assert first.tolist() == ROUND[:, [1, 2, 0]].tolist()
    assert other.tolist() == FAILED[:, [1, 2, 0]].tolist()
    assert second.events == runs[1].events
    with pytest.raises(InputError, match=r"tracks.nc, run: 0: has no track of this run"):
        with_tracks(runs, track_path, 2)


def test_the_map_holds_what_was_sailed(
    plan: PlanFile, runs: tuple[RunLog, ...], track_path: Path
) -> None:
    straight = scene_of(plan, runs=runs[1:])
    sailed = scene_of(plan, runs=with_tracks(runs[1:], track_path, 2))
    assert straight.region.north < 9000.0 < sailed.region.north
    assert any("drawn straight" in note for note in straight.notes)
    assert not any("drawn straight" in note for note in sailed.notes)


def test_pictures_follow_tracks(
    plan: PlanFile, runs: tuple[RunLog, ...], track_path: Path, tmp_path: Path
) -> None:
    from fiveroute.plots.mission import plot_mission

    scene = scene_of(plan, runs=with_tracks(runs[1:], track_path, 2))
    lines = plot_mission(scene, scene.runs[0], currents=False).get_lines()
    assert max(float(np.max(line.get_ydata())) for line in lines) == 9.0  # kilometres
    write_look([scene], tmp_path / "film.gif", run=1)


def spoilt(change: Callable[[Any], Any]) -> Callable[[Path, PlanFile], None]:
    def write(path: Path, plan: PlanFile) -> None:
        change(trajectories(plan.instance, RUNS[1:])).to_netcdf(path, engine="h5netcdf")

    return write


@pytest.mark.parametrize(
    ("write", "said"),
    [
        (spoilt(lambda data: data.drop_vars("x")), "x: is missing"),
        (spoilt(lambda data: data.assign(run=("trajectory", [0.5, 1, 1]))), "run: must be whole"),
        (spoilt(lambda data: data.assign(auv=("trajectory", [0, 2, 1]))), "auv: 2: the plan has 2"),
        (spoilt(lambda data: data.assign(row_size=("trajectory", [3, 9, 3]))), "row_size: must"),
        (spoilt(lambda data: data.assign(row_size=("trajectory", [-1, 3, 6]))), "row_size: must"),
        (spoilt(lambda data: data.assign_coords(y=data.x * np.nan)), "y: has missing values"),
        (spoilt(lambda data: data.assign_coords(time=-data.time)), "time: must not go back"),
        (lambda path, _: path.write_bytes(b"CDF\x01"), "cannot be read as netCDF"),
    ],
)
def test_wrong_files_are_named(
    plan: PlanFile,
    runs: tuple[RunLog, ...],
    tmp_path: Path,
    write: Callable[[Path, PlanFile], None],
    said: str,
) -> None:
    path = tmp_path / "wrong.nc"
    write(path, plan)
    with pytest.raises(InputError) as error:
        with_tracks(runs[1:], path, 2)
    assert str(error.value).startswith(f"{path}")
    assert said in str(error.value)


def test_tracks_need_a_log(plan_path: Path, track_path: Path) -> None:
    with pytest.raises(InputError, match="add it"):
        load_scenes([plan_path], tracks=[track_path])
