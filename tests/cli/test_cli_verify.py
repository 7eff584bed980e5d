import json
import os
import signal
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from fiveroute.formats import PlanFile, write_instance, write_plan
from fiveroute.generate import generate
from fiveroute.paths.evolved_path import evolve_path
from fiveroute.result import Result
from fiveroute.routes import Plan
from fiveroute.tiers import pathing


@pytest.fixture
def plan(call: Any, tiny: Path) -> Path:
    path = tiny.with_name("plan.json")
    assert call("solve", tiny, "--output", path).code == 0
    return path


def tampered(plan: Path, **changes: object) -> Path:
    document = json.loads(plan.read_text(encoding="utf-8")) | changes
    path = plan.with_name("tampered.json")
    path.write_text(json.dumps(document), encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("changes", "kind"),
    [
        ({"routes": [["a", "b", "far"]]}, "over_budget"),
        ({"routes": [["a", "a"]]}, "visited_twice"),
        ({"routes": [["a", "stranger"]]}, "unknown_node"),
        ({"routes": [["a"], ["b"]], "durations": [30.0, 30.0]}, "fleet_size"),
        ({"objective": 0.8}, "objective"),
        ({"durations": [31.0]}, "duration"),
    ],
)
def test_every_violation_is_named(
    call: Any, tiny: Path, plan: Path, changes: dict[str, object], kind: str
) -> None:
    answer = call("verify", tiny, tampered(plan, **changes), "--json")
    assert answer.code == 1
    assert answer.doc["feasible"] is False
    assert answer.doc["violations"][0]["kind"] == kind


def test_a_stranger_goes_by_its_id(call: Any, tiny: Path, plan: Path) -> None:
    answer = call("verify", tiny, tampered(plan, routes=[["stranger"]]), "--json")
    assert answer.doc["violations"][0]["node"] == "stranger"


def test_people_read_the_verdict(call: Any, tiny: Path, plan: Path) -> None:
    answer = call("verify", tiny, tampered(plan, routes=[["a", "b", "far"]]))
    assert answer.code == 1
    assert "NOT feasible" in answer.out
    assert "over budget, AUV 1" in answer.out


def test_a_plan_for_another_instance_is_refused(
    call: Any, plan: Path, edited: Callable[..., Path]
) -> None:
    answer = call("verify", edited(fleet__endurance=61.0), plan)
    assert answer.code == 2
    assert "instance" in answer.err


@pytest.mark.parametrize(
    ("options", "word"),
    [
        (("--time-limit", 3), "--time-limit"),
        (("--certificate", "x.json"), "either"),
    ],
)
def test_options_that_do_nothing_are_refused(
    call: Any, tiny: Path, plan: Path, options: tuple[object, ...], word: str
) -> None:
    answer = call("verify", tiny, plan, *options)
    assert answer.code == 2
    assert word in answer.err


def test_a_certificate_says_itself_what_it_is_of(call: Any, tiny: Path) -> None:
    answer = call("verify", tiny, "--certificate", "x.json", "--straight-lines")
    assert answer.code == 2
    assert "--straight-lines is for PLAN" in answer.err


@pytest.fixture
def interruptible() -> Iterator[None]:
    """A process that hears Ctrl-C, even if it was started in the background."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("interruptible")
def test_ctrl_c_while_the_paths_are_planned_is_no_verdict(
    call: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A plan without paths takes the fastest ones; before they are known nothing can be said."""
    sea = generate("paper", nodes=20, seed=1, fleet_size=1)
    sea = replace(sea, fleet=replace(sea.fleet, endurance=1e7))
    straight = sea.problem(1)
    result = Result.judged(straight, Plan.of([range(1, 21)]), method="by-hand", seconds=0.0)
    write_instance(sea, tmp_path / "sea.json")
    write_plan(PlanFile.of(sea, straight, result), tmp_path / "plan.json")
    signals: list[int] = []

    def interrupting(*given: Any, **more: Any) -> Any:
        if not signals:
            signals.append(signal.SIGINT)
            os.kill(os.getpid(), signal.SIGINT)
        return evolve_path(*given, **more)

    monkeypatch.setattr(pathing, "evolve_path", interrupting)
    answer = call("verify", tmp_path / "sea.json", tmp_path / "plan.json")
    assert signals
    assert answer.code == 130
    assert answer.err.split("\n")[-2:] == ["fiveroute: interrupted", ""]
    assert answer.out == ""
