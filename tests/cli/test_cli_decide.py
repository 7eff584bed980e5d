"""``fiveroute decide``: tables, pictures, and lists of numbers."""

import os
import signal
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest


def test_fleet_sizes(call: Any, tiny: Path, tmp_path: Path) -> None:
    table, picture = tmp_path / "sizes.csv", tmp_path / "sizes.png"
    how = ("--sizes", "1,2", "--output", table, "--picture", picture)
    answer = call("decide", "fleet-size", tiny, *how, "--json")
    assert answer.code == 0
    assert [row["fleet_size"] for row in answer.doc["rows"]] == [1.0, 2.0]
    assert table.read_text().startswith("fleet_size,status,objective")
    assert picture.read_bytes().startswith(b"\x89PNG")
    again = call("decide", "fleet-size", tiny, *how)
    assert again.code == 2
    assert "--force" in again.err


def test_the_table_for_people_points_something_out(call: Any, tiny: Path) -> None:
    answer = call("decide", "speed", tiny, "--speeds", "0.8:1.2:0.2", "--straight-lines")
    assert answer.code == 0
    assert "collects most" in answer.out


def test_values_without_time_are_told(call: Any, tiny: Path) -> None:
    answer = call("decide", "fleet-size", tiny, "--sizes", "1:3:1", "--time-limit", "1e-9")
    assert answer.code == 0
    assert answer.err == (
        "fiveroute: there was no time for AUVs 2, 3; give more with --time-limit\n"
    )


def test_steps_leave_no_crumbs(call: Any, tiny: Path) -> None:
    how = ("--speeds", "0.8:1.2:0.2", "--straight-lines", "--bound", "none", "--json")
    rows = call("decide", "speed", tiny, *how).doc["rows"]
    assert [row["speed"] for row in rows] == [0.8, 1.0, 1.2]


@pytest.mark.parametrize(
    "wrong", ["", "x", "3:1:1", "1:2:0", "1:2", "1:100000:1e-3", "nan", "1,inf"]
)
def test_lists_that_are_none(call: Any, tiny: Path, wrong: str) -> None:
    answer = call("decide", "fleet-size", tiny, "--sizes", wrong)
    assert answer.code == 2
    assert "list of numbers" in answer.err


def test_sizes_are_whole(call: Any, tiny: Path) -> None:
    answer = call("decide", "fleet-size", tiny, "--sizes", "1,2.5")
    assert answer.code == 2
    assert "whole" in answer.err


def test_departures_need_a_forecast(call: Any, tiny: Path) -> None:
    answer = call("decide", "departure", tiny)
    assert answer.code == 2
    assert "ocean.currents.file" in answer.err


@pytest.mark.parametrize("name", ["sizes.jpg", "sizes", "sizes.csv"])
def test_pictures_of_other_kinds_are_refused_before_the_work(
    call: Any, tiny: Path, tmp_path: Path, name: str
) -> None:
    answer = call("decide", "fleet-size", tiny, "--picture", tmp_path / name)
    assert answer.code == 2
    assert ".png, .svg, .pdf" in answer.err


def test_two_outputs_need_two_files(call: Any, tiny: Path, tmp_path: Path) -> None:
    same = tmp_path / "sizes.csv"
    answer = call("decide", "fleet-size", tiny, "--output", same, "--picture", same)
    assert answer.code == 2
    assert "two outputs" in answer.err


@pytest.mark.parametrize("option", ["--draw", "--displacement", "--strength"])
def test_members_are_drawn_or_read(call: Any, tiny: Path, tmp_path: Path, option: str) -> None:
    member = tmp_path / "member.nc"
    member.touch()
    answer = call("decide", "ensemble", tiny, member, option, 2)
    assert answer.code == 2
    assert answer.err.count("\n") == 1
    assert f"{option} is for members drawn" in answer.err


def test_ctrl_c_ends_an_ensemble_before_its_first_row(
    call: Any, edited: Callable[..., Path]
) -> None:
    vortex = {"x": 20.0, "y": 300.0, "circulation": 9.0, "radius": 50.0}
    mission = edited(ocean={"currents": {"vortices": [vortex]}})
    threading.Timer(3.0, os.kill, (os.getpid(), signal.SIGINT)).start()
    answer = call("decide", "ensemble", mission, "--draw", 5000)
    assert answer.code == 130
    assert answer.err.endswith("fiveroute: interrupted\n")
    assert answer.out == ""
