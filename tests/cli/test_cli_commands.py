"""The remaining commands: help, giant-route, generate, convert, gap and plan."""

import json
import re
from collections.abc import Callable, Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

from fiveroute.cli import COMMANDS

SQUARE = """NAME : square
TYPE : TSP
DIMENSION : 4
EDGE_WEIGHT_TYPE : EUC_2D
NODE_COORD_SECTION
1 0 0
2 10 10
3 10 0
4 0 10
EOF
"""


def test_help_and_version(call: Any) -> None:
    answer = call("--help")
    assert answer.code == 0
    assert "giant-route" in answer.out
    assert call("--version").out.startswith("fiveroute, version")


def every_command() -> Iterator[tuple[str, ...]]:
    """Commands, and those below them, as they are called."""
    for name in COMMANDS:
        command = import_module(f"fiveroute.cli.{name.replace('-', '_')}").command
        yield from ((name, below) for below in getattr(command, "commands", {}))
        yield (name,)


@pytest.mark.parametrize("command", list(every_command()), ids=" ".join)
def test_every_command_has_help_in_one_language(call: Any, command: tuple[str, ...]) -> None:
    answer = call(*command, "--help")
    assert answer.code == 0
    assert f"Usage: fiveroute {' '.join(command)}" in answer.out
    for word in ("INTEGER", "FLOAT", "RANGE", "PATH", "NUMBER", "TEXT"):
        assert not re.search(rf"^  --\S+ .*\b{word}\b", answer.out, re.MULTILINE), word


@pytest.mark.parametrize("exact", [[], ["--exact"]])
def test_giant_route_of_a_tour_begins_with_the_start(
    call: Any, tmp_path: Path, exact: list[str]
) -> None:
    path = tmp_path / "square.tsp"
    path.write_text(SQUARE, encoding="utf-8")
    answer = call("giant-route", path, "--json", *exact)
    assert answer.code == 0
    assert answer.doc["duration"] == 40
    assert answer.doc["order"][0] == "1"
    assert sorted(answer.doc["order"]) == ["1", "2", "3", "4"]
    assert answer.doc["bound"] <= 40


def test_giant_route_between_two_ends_lists_the_nodes(call: Any, tiny: Path) -> None:
    answer = call("giant-route", tiny, "--exact", "--json")
    assert answer.doc["order"] in (["a", "b", "far"], ["a", "far", "b"])
    assert answer.doc["status"] == "optimal"


def test_currents_are_for_the_layout_of_the_paper(call: Any, tmp_path: Path) -> None:
    answer = call("generate", "ring", "--currents", "printed", "--output", tmp_path / "ring.json")
    assert answer.code == 2
    assert "--currents" in answer.err
    assert not (tmp_path / "ring.json").exists()


def test_generate_is_repeatable(call: Any, tmp_path: Path) -> None:
    for name in ("one.json", "two.json"):
        assert call("generate", "paper", "--seed", 5, "--output", tmp_path / name).code == 0
    one, two = (json.loads((tmp_path / f"{n}.json").read_text()) for n in ("one", "two"))
    assert one == two
    assert len(one["nodes"]) == 60
    assert (one["start"], one["destination"]) == (
        {"x": 3000.0, "y": 5000.0},
        {"x": 7000.0, "y": 5000.0},
    )


@pytest.mark.parametrize("layout", ["uniform", "clustered", "ring"])
def test_other_layouts(call: Any, tmp_path: Path, layout: str) -> None:
    path = tmp_path / "other.json"
    answer = call("generate", layout, "--nodes", 7, "--fleet-size", 2, "--output", path)
    assert answer.code == 0
    document = json.loads(path.read_text())
    assert (len(document["nodes"]), document["fleet"]["size"]) == (7, 2)


def test_convert_there_and_back(call: Any, tmp_path: Path) -> None:
    chao = tmp_path / "p.txt"
    chao.write_text("n 4\nm 2\ntmax 10.5\n0 0 0\n1 0 5\n0 2 7\n3 3 0\n", encoding="utf-8")
    native, again = tmp_path / "p.json", tmp_path / "again.txt"
    assert call("convert", chao, "--to", "native", "--output", native).code == 0
    assert call("convert", native, "--to", "chao", "--output", again).code == 0
    first, second = (call("solve", path, "--json").doc for path in (chao, again))
    assert first["objective"] == second["objective"] == 12
    assert first["routes"] == second["routes"]


def test_convert_refuses_what_the_format_cannot_hold(call: Any, tiny: Path) -> None:
    answer = call("convert", tiny, "--to", "chao", "--output", tiny.with_name("x.txt"))
    assert answer.code == 2
    assert not tiny.with_name("x.txt").exists()


def test_gap_sets_plan_against_bound(call: Any, tiny: Path) -> None:
    table = tiny.with_name("best.csv")
    table.write_text("instance,best_known\ntiny,0.75\n", encoding="utf-8")
    output = tiny.with_name("gaps.csv")
    answer = call("gap", tiny, tiny, "--reference", table, "--output", output, "--json")
    assert answer.code == 0
    assert len(answer.doc["rows"]) == 2
    row = answer.doc["rows"][0]
    assert (row["instance"], row["nodes"], row["fleet_size"]) == ("tiny", 3, 1)
    assert row["heuristic"] == row["best_known"] == pytest.approx(0.75)
    assert (row["gap"], row["status"]) == (0.0, "optimal")
    assert answer.doc["summary"]["proved"] == 2
    assert output.read_text().startswith("instance,nodes,fleet_size,heuristic,bound,best_known")


@pytest.mark.parametrize("search", ["paper", "fleet"])
@pytest.mark.parametrize("allocation", ["giant-route", "voronoi", "k-means", "ahc"])
def test_plan_answers_with_its_gap(call: Any, tiny: Path, search: str, allocation: str) -> None:
    answer = call("plan", tiny, "--search", search, "--allocation", allocation, "--json")
    assert answer.code == 0
    assert answer.doc["objective"] == pytest.approx(0.75)
    assert answer.doc["bound"] >= 0.75
    assert answer.doc["gap"] is not None
    assert set(answer.doc["giant_route"]) == {"order", "duration"}
    assert {"fleet_estimate", "segments", "allocation"} <= set(answer.doc)


@pytest.mark.parametrize("bound", ["none", "quick", "exact"])
def test_plan_takes_its_bound_where_it_is_told(call: Any, tiny: Path, bound: str) -> None:
    document = call("plan", tiny, "--bound", bound, "--json").doc
    assert (document["bound"] is None) == (bound == "none")
    if bound == "exact":
        assert document["status"] == "optimal"


def test_plan_of_no_nodes_is_an_empty_plan(call: Any, edited: Callable[..., Path]) -> None:
    answer = call("plan", edited(nodes=[]), "--json")
    assert (answer.code, answer.doc["routes"]) == (0, [[]])


def test_plan_of_an_impossible_mission_exits_with_1(call: Any, edited: Callable[..., Path]) -> None:
    answer = call("plan", edited(fleet__endurance=29.0), "--json")
    assert answer.code == 1
    assert (answer.doc["status"], answer.doc["objective"]) == ("infeasible", 0.0)


def test_plan_is_the_same_for_the_same_seed(call: Any, tiny: Path) -> None:
    first, second = (call("plan", tiny, "--seed", 3, "--json").doc for _ in range(2))
    assert first["routes"] == second["routes"]
    assert first["giant_route"] == second["giant_route"]


def test_plan_on_samples_keeps_a_margin(call: Any, edited: Callable[..., Path]) -> None:
    path = edited(uncertainty={"drift": 0.2}, fleet__endurance=34.0)
    sure = call("plan", path, "--search", "paper", "--json").doc
    careful = call(
        "plan", path, "--search", "paper", "--samples", 64, "--quantile", 0.95, "--json"
    ).doc
    assert sure["objective"] == pytest.approx(0.75)
    assert careful["objective"] < sure["objective"]
