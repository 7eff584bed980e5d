from fiveroute.experiments.gap_table import GapRow, gap_table_csv, summarise


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
    assert summarise([row(heuristic=0.0, best_known=0.0, gap=0.0)]).mean_gap_to_best_known == 0.0


def test_csv_leaves_the_unknown_empty() -> None:
    header, line = gap_table_csv([row(bound=None, gap=None)]).splitlines()
    assert header.split(",")[:3] == ["instance", "nodes", "fleet_size"]
    assert line == "a,5,2,9.0,,10.0,,feasible,1.0"
