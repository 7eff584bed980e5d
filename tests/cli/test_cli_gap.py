"""``fiveroute gap``: folders, peers, tables and pictures."""

import shutil
from pathlib import Path
from typing import Any

import pytest

from fiveroute.cli.answers import gap_text
from fiveroute.cli.gap import PEERS
from fiveroute.cli.gap_answer import print_gaps
from fiveroute.experiments.gap_table import summarise
from fiveroute.peers import PEERS as KNOWN


def test_the_peers_are_those_there_are() -> None:
    assert sorted(KNOWN) == list(PEERS)


def test_a_folder_with_a_peer_a_picture_and_a_table(call: Any, tiny: Path, tmp_path: Path) -> None:
    folder = tmp_path / "all"
    folder.mkdir()
    shutil.copy(tiny, folder)
    (folder / "README.md").write_text("tiny")
    answer = call(
        *("gap", folder, "--time-limit", 0.5, "--peer", "ortools", "--peer", "ortools", "--json"),
        *("--picture", tmp_path / "gap.svg", "--output", tmp_path / "gap.md"),
    )
    assert answer.code == 0
    assert "README.md: left out" in answer.err
    row = answer.doc["rows"][0]
    assert row["peers"]["ortools"]["objective"] == pytest.approx(0.75)
    assert row["exact"] == pytest.approx(0.75)
    assert set(answer.doc["summary"]["solvers"]) == {"heuristic", "exact", "ortools"}
    assert answer.doc["summary"]["solved"] == 1
    assert (tmp_path / "gap.svg").read_text().lstrip().startswith("<?xml")
    assert (tmp_path / "gap.md").read_text().count("\n") == 3


def test_a_table_for_people(call: Any, tiny: Path) -> None:
    answer = call("gap", tiny, "--only", "exact", "--method", "circuit")
    lines = answer.out.splitlines()
    assert lines[0].split()[:4] == ["instance", "nodes", "AUVs", "exact"]
    assert lines[1].split()[:5] == ["tiny", "3", "1", "0.75", "0.75"]
    assert lines[-1].startswith("1 instances, 1 proved optimal, 1 at the best known value")


def test_a_run_without_bounds_or_rows_says_so(
    call: Any, tiny: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    answer = call("gap", tiny, "--only", "heuristic")
    assert answer.out.splitlines()[-1] == "1 instances, 1 at the best known value"
    print_gaps([], summarise([]))
    assert capsys.readouterr().out == "0 instances, 0 at the best known value\n"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--peer", "ortools"), "a peer needs a time limit"),
        (("--peer", "lkh"), "'lkh' is not one of"),
        (("--picture", "gap.bmp"), "a picture ends in .png, .svg, .pdf"),
        (("--output", "gap.xlsx"), "a table ends in"),
        (("--scheduler", "tcp://127.0.0.1:1"), "no Dask scheduler answers"),
    ],
)
def test_what_cannot_be_is_refused(
    call: Any,
    tiny: Path,
    arguments: tuple[str, ...],
    message: str,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tiny.parent)
    monkeypatch.setattr("fiveroute.sharing._PATIENCE", 0.5)
    answer = call("gap", tiny, *arguments)
    assert (answer.code, answer.out) == (2, "")
    assert message in answer.err


def test_a_reference_above_the_bound_is_told(call: Any, tiny: Path) -> None:
    table = tiny.with_name("best.csv")
    table.write_text("instance,best_known\ntiny,1.75\n", encoding="utf-8")
    answer = call("gap", tiny, "--reference", table, "--json")
    assert answer.doc["summary"]["contradictions"] == ["tiny"]
    assert "above the proven bound" in answer.err


def test_the_slow_method_measures_what_it_takes(call: Any, tiny: Path) -> None:
    answer = call("gap", tiny, "--only", "exact", "--method", "brute-force", "--json")
    assert answer.doc["rows"][0]["exact_method"] == "brute-force"


def test_an_instance_that_a_method_does_not_take_is_named(call: Any, tmp_path: Path) -> None:
    large = tmp_path / "large.json"
    assert call("generate", "ring", "--nodes", 10, "--output", large).code == 0
    answer = call("gap", large, "--fleet-size", 1, "--only", "exact", "--method", "brute-force")
    assert answer.code == 2
    assert "large.json, nodes: 10" in answer.err


def test_gaps_are_read_by_people() -> None:
    texts = [gap_text(gap) for gap in (None, 0.0, 0.125, 6.5e12)]
    assert texts == ["unknown", "0 (optimal)", "12.50 %", "endless (nothing collected)"]
