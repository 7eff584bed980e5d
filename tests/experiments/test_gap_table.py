"""Summaries of gap tables, and the tables as they are written."""

from pathlib import Path

import pytest

from fiveroute.errors import InputError
from fiveroute.experiments.gap_row import GapRow
from fiveroute.experiments.gap_table import (
    flat_rows,
    proof_times,
    read_reference,
    shortfalls,
    summarise,
)
from fiveroute.formats.tables import write_rows
from fiveroute.peers import PeerAnswer


def row(**changes: object) -> GapRow:
    parts = {
        "instance": "a",
        "nodes": 5,
        "fleet_size": 2,
        "heuristic": 9.0,
        "bound": 10.0,
        "best_known": 10.0,
        "gap": 1 / 9,
        "status": "feasible",
        "seconds": 1.0,
    }
    return GapRow(**(parts | changes))  # type: ignore[arg-type]


def test_summary_counts_what_is_proved_and_reached() -> None:
    proved = row(heuristic=10.0, gap=0.0, status="optimal")
    summary = summarise([row(), proved])
    assert (summary.instances, summary.proved, summary.reached) == (2, 1, 1)
    assert summary.mean_gap == (1 / 9) / 2
    assert summary.worst_gap == 1 / 9
    assert summary.mean_gap_to_best_known == 0.05
    assert summary.seconds == 2.0


def test_summary_of_rows_without_bounds_has_no_gap() -> None:
    summary = summarise([row(bound=None, gap=None)])
    assert (summary.mean_gap, summary.median_gap, summary.worst_gap) == (None, None, None)


def test_nothing_to_collect_is_no_shortfall() -> None:
    nothing = {"vroom": PeerAnswer(None, "no_solution", 2.0)}
    rows = [row(heuristic=0.0, best_known=0.0, gap=0.0, peers=nothing)]
    assert summarise(rows).mean_gap_to_best_known == 0.0
    assert shortfalls(rows)["vroom"] == [0.0]


def test_an_empty_table_has_an_empty_summary() -> None:
    summary = summarise([])
    assert (summary.instances, summary.mean_gap, summary.solvers) == (0, None, {})


def test_an_instance_is_solved_by_whatever_plan() -> None:
    late = row(exact=10.0, exact_status="optimal", exact_seconds=3.0)
    never = row(exact=9.0, exact_status="feasible", exact_seconds=5.0)
    summary = summarise([late, never])
    assert (summary.proved, summary.solved) == (0, 1)
    assert summary.solvers["exact"].seconds == 8.0
    assert proof_times([late, never]) == [3.0, None]


def test_a_rejected_answer_has_collected_nothing() -> None:
    rejected = {"vroom": PeerAnswer(None, "rejected", 2.0, 1)}
    good = {"vroom": PeerAnswer(10.0, "feasible", 1.0)}
    rows = [row(peers=rejected), row(peers=good)]
    assert shortfalls(rows) == {"heuristic": [0.1, 0.1], "vroom": [1.0, 0.0]}
    vroom = summarise(rows).solvers["vroom"]
    assert (vroom.answered, vroom.rejected, vroom.reached, vroom.seconds) == (1, 1, 1, 3.0)
    assert (vroom.mean_shortfall, vroom.worst_shortfall) == (0.5, 1.0)


def test_a_published_value_above_the_bound_is_a_contradiction() -> None:
    fine, wrong = row().beside(10.0), row(instance="b").beside(11.0)
    assert (fine.best_known, wrong.best_known) == (10.0, 11.0)
    assert summarise([fine, wrong]).contradictions == ("b",)


def test_a_better_peer_is_the_best_known() -> None:
    better = row(peers={"pyvrp": PeerAnswer(9.5, "feasible", 1.0)}).beside(None)
    assert better.best_known == 9.5


def test_rows_come_back_from_their_documents() -> None:
    answered = row(peers={"pyvrp": PeerAnswer(9.5, "feasible", 1.0)}, exact_status="feasible")
    assert GapRow.of_document(answered.as_document()) == answered


def test_a_column_a_figure(tmp_path: Path) -> None:
    answers = {"vroom": PeerAnswer(9.5, "feasible", 1.0)}
    rows = flat_rows([row(bound=None, gap=None, peers=answers), row()])
    assert [line["vroom"] for line in rows] == [9.5, None]
    write_rows(rows, tmp_path / "table.csv")
    header, first, second = (tmp_path / "table.csv").read_text().splitlines()
    assert header.startswith("instance,nodes,fleet_size,heuristic,bound,best_known,gap,status")
    assert header.endswith("vroom,vroom_status,vroom_seconds")
    assert first.startswith("a,5,2,9.0,,10.0,,feasible,1.0,")
    assert first.endswith(",9.5,feasible,1.0")
    assert second.endswith(",,,")
    write_rows(rows, tmp_path / "table.md")
    lines = (tmp_path / "table.md").read_text().splitlines()
    assert len(lines) == 4
    assert lines[0].startswith("| instance | nodes |")
    assert {line.count("|") for line in lines} == {len(rows[0]) + 1}


def test_a_reference_needs_its_columns_and_numbers(tmp_path: Path) -> None:
    file = tmp_path / "best.csv"
    file.write_text("instance,best_known\na,12\n")
    assert read_reference(file) == {"a": 12.0}
    file.write_text("instance,best_known\na,many\n")
    with pytest.raises(InputError, match=r"line 2, best_known: 'many': must be a finite number"):
        read_reference(file)
    file.write_text("name,value\na,12\n")
    with pytest.raises(InputError, match="needs the columns instance and best_known"):
        read_reference(file)
