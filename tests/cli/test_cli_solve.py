from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from fiveroute.cli import solve
from fiveroute.models import METHODS

KEYS = {
    "instance",
    "method",
    "status",
    "objective",
    "bound",
    "gap",
    "completion_rate",
    "fleet_size",
    "routes",
    "durations",
    "seconds",
    "seed",
}


@pytest.mark.parametrize("method", ["auto", "brute-force", "circuit", "compact", "flow"])
def test_every_method_proves_the_tiny_one(call: Any, tiny: Path, method: str) -> None:
    answer = call("solve", tiny, "--method", method, "--json")
    assert answer.code == 0
    assert set(answer.doc) >= KEYS
    assert answer.doc["status"] == "optimal"
    assert answer.doc["routes"] == [["a", "b"]]
    assert answer.doc["objective"] == pytest.approx(0.75)
    assert answer.doc["durations"] == [pytest.approx(30 + 2 + 1.5)]
    assert answer.doc["gap"] == 0.0


def test_a_destination_out_of_reach_is_infeasible_and_exits_with_1(
    call: Any, edited: Callable[..., Path]
) -> None:
    answer = call("solve", edited(fleet__endurance=29.0), "--json")
    assert answer.code == 1
    assert answer.doc["status"] == "infeasible"
    assert answer.doc["routes"] == []
    assert answer.doc["objective"] == 0.0


def test_no_nodes_is_an_empty_plan(call: Any, edited: Callable[..., Path]) -> None:
    answer = call("solve", edited(nodes=[], fleet__size=2), "--json")
    assert answer.code == 0
    assert answer.doc["routes"] == [[], []]
    assert answer.doc["completion_rate"] == 1.0


def test_people_get_a_table(call: Any, tiny: Path) -> None:
    answer = call("solve", tiny)
    assert answer.code == 0
    assert "a b" in answer.out
    assert "0 (optimal)" in answer.out


def test_the_plan_file_passes_the_judge(call: Any, tiny: Path) -> None:
    plan = tiny.with_name("plan.json")
    assert call("solve", tiny, "--output", plan).code == 0
    verdict = call("verify", tiny, plan, "--json")
    assert verdict.code == 0
    assert verdict.doc["feasible"] is True


def test_an_existing_plan_is_not_overwritten_unasked(call: Any, tiny: Path) -> None:
    plan = tiny.with_name("plan.json")
    plan.write_text("precious", encoding="utf-8")
    refused = call("solve", tiny, "--output", plan)
    assert refused.code == 2
    assert "--force" in refused.err
    assert plan.read_text(encoding="utf-8") == "precious"
    assert call("solve", tiny, "--output", plan, "--force").code == 0


def test_plan_and_certificate_want_a_file_each(call: Any, tiny: Path, tmp_path: Path) -> None:
    both = tmp_path / "both.json"
    answer = call("solve", tiny, "--output", both, "--certificate", both)
    assert answer.code == 2
    assert "is named for two outputs" in answer.err
    assert not both.exists()


def test_fleet_size_overrides_the_file(call: Any, tiny: Path) -> None:
    assert len(call("solve", tiny, "--fleet-size", 3, "--json").doc["routes"]) == 3


def test_the_choices_are_the_methods() -> None:
    """The command line names them without importing the models."""
    assert set(solve.METHODS) == {"auto", *METHODS}
