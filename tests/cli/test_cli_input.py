"""Whatever is wrong: one line on standard error, exit code 2, nothing on standard output."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest


def assert_refused(answer: Any, *words: str) -> None:
    assert answer.code == 2
    assert answer.out == ""
    assert answer.err.count("\n") == 1
    for word in words:
        assert word in answer.err


@pytest.mark.parametrize("command", ["plan", "solve", "giant-route", "gap"])
@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"fleet__speed": 0}, ("fleet.speed", "0", "greater than 0")),
        ({"nodes__0__data": -1}, ("nodes[0].data", "-1")),
        ({"nodes__1__id": "a"}, ("nodes[1].id", "'a'", "of its own")),
        ({"nodes__0__x": float("nan")}, ("nodes[0].x", "finite")),
        ({"fleet__sped": 1.0}, ("sped", "speed")),
    ],
)
def test_wrong_values_are_named(
    call: Any,
    edited: Callable[..., Path],
    command: str,
    changes: dict[str, object],
    words: tuple[str, ...],
) -> None:
    assert_refused(call(command, edited(**changes)), "edited.json", *words)


@pytest.mark.parametrize("command", ["plan", "solve", "giant-route", "gap"])
def test_missing_files_and_folders_are_named(call: Any, tmp_path: Path, command: str) -> None:
    assert_refused(call(command, tmp_path / "nowhere.json"), "nowhere.json", "does not exist")
    assert_refused(call(command, tmp_path), "is a folder")


@pytest.mark.parametrize(
    "arguments",
    [
        ("sail",),
        ("solve",),
        ("solve", "--method", "magic", "x.json"),
        ("solve", "x.json", "--time-limit", "0"),
        ("solve", "x.json", "--time-limit", "nan"),
        ("solve", "x.json", "--fleet-size", "0"),
        ("plan", "x.json", "--seed", "-1"),
        ("generate", "paper"),
        ("generate", "paper", "--nodes", "-1", "--output", "x.json"),
        ("convert", "x.json", "--to", "poetry", "--output", "y"),
    ],
)
def test_wrong_calls_are_one_line(call: Any, arguments: tuple[str, ...]) -> None:
    assert_refused(call(*arguments), "fiveroute: ")


@pytest.mark.parametrize(
    "arguments",
    [
        ("solve", "x.json", "--gap"),
        ("plan", "x.json", "--samples", "3", "--quantile"),
        ("path", "x.json", "a", "b", "--depart"),
        ("simulate", "x.json", "--loss"),
        ("simulate", "x.json", "--reserve"),
        ("decide", "speed", "x.json", "--battery"),
        ("decide", "reserve", "x.json", "--accepted-late"),
        ("decide", "ensemble", "x.json", "--alpha"),
        ("convert", "x.json", "--to", "native", "--output", "y", "--speed"),
        ("export", "x.json", "--to", "csv", "--output", "y", "--depth"),
    ],
)
@pytest.mark.parametrize("wrong", ["nan", "inf", "-1", "much"])
def test_what_is_no_number_is_none_of_an_option(
    call: Any, arguments: tuple[str, ...], wrong: str
) -> None:
    assert_refused(call(*arguments, wrong), arguments[-1], wrong)


@pytest.mark.parametrize(
    ("wrong", "meant"), [("paln", "plan"), ("giant_route", "giant-route"), ("zzz", "known are")]
)
def test_a_mistyped_command_is_guessed(call: Any, wrong: str, meant: str) -> None:
    assert_refused(call(wrong), f"no such command {wrong!r}", meant)


@pytest.mark.parametrize(("wrong", "meant"), [("strat", "'start'"), ("fra", "'far'")])
def test_a_mistyped_stop_is_guessed(call: Any, tiny: Path, wrong: str, meant: str) -> None:
    assert_refused(call("path", tiny, wrong, "a"), "FROM", f"did you mean {meant}?")


@pytest.mark.parametrize("name", ["path.jpg", "path"])
def test_a_picture_of_another_kind_is_refused(call: Any, tiny: Path, name: str) -> None:
    answer = call("path", tiny, "a", "b", "--picture", tiny.with_name(name))
    assert_refused(answer, name, ".png, .svg, .pdf")


def test_an_unwritable_output_is_refused_before_the_work(call: Any, tiny: Path) -> None:
    assert_refused(call("solve", tiny, "--output", tiny.parent / "no" / "plan.json"), "no")


def test_an_unknown_fleet_is_asked_for(call: Any, edited: Callable[..., Path]) -> None:
    assert_refused(call("solve", edited(fleet__size=None)), "--fleet-size")


def test_reference_tables_are_checked(call: Any, tiny: Path) -> None:
    table = tiny.with_name("best.csv")
    table.write_text("instance,best\ntiny,1\n", encoding="utf-8")
    assert_refused(call("gap", tiny, "--reference", table), "best_known", "line 1")
    table.write_text("instance,best_known\ntiny,much\n", encoding="utf-8")
    assert_refused(call("gap", tiny, "--reference", table), "much", "line 2")


def test_a_plan_is_no_instance(call: Any, tiny: Path) -> None:
    path = tiny.with_name("plan.json")
    path.write_text(json.dumps({"format": "fiveroute-plan/1"}), encoding="utf-8")
    assert_refused(call("solve", path), "fiveroute-instance/1")
