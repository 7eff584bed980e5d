"""A gap table for people."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from fiveroute.cli.answers import gap_text
from fiveroute.cli.notes import tell
from fiveroute.experiments.gap_row import GapRow
from fiveroute.experiments.gap_table import GapSummary
from fiveroute.result import Status

__all__ = ["print_gaps"]


def print_gaps(rows: Sequence[GapRow], summary: GapSummary) -> None:
    """Print a row an instance, a row a solver, and what was proved."""
    if rows:
        columns = [column for column in _columns(rows) if any(column[1](row) for row in rows)]
        cells = [[text(row) or "-" for _, text in columns] for row in rows]
        _print_table([name for name, _ in columns], cells)
    if len(summary.solvers) > 1:
        tell("")
        _print_solvers(summary)
    tell(_in_words(summary))


def _in_words(summary: GapSummary) -> str:
    parts = [f"{summary.instances} instances"]
    if summary.mean_gap is not None:
        parts.append(f"{summary.proved} proved optimal")
    parts.append(f"{summary.reached} at the best known value")
    gaps = ("mean", summary.mean_gap), ("median", summary.median_gap), ("worst", summary.worst_gap)
    texts = [f"{name} {gap_text(gap)}" for name, gap in gaps if gap is not None]
    return ", ".join(parts) + (f"; gap {', '.join(texts)}" if texts else "")


Column = tuple[str, Callable[[GapRow], str]]


def _columns(rows: Sequence[GapRow]) -> list[Column]:
    """Names of columns, and what they say of a row; nothing where it is not known."""
    peers = dict.fromkeys(name for row in rows for name in row.peers)
    return [
        ("instance", lambda row: row.instance),
        ("nodes", lambda row: str(row.nodes)),
        ("AUVs", lambda row: str(row.fleet_size)),
        ("plan", lambda row: _number(row.heuristic)),
        ("exact", lambda row: _number(row.exact)),
        ("bound", lambda row: _number(row.bound)),
        ("best known", lambda row: _number(row.best_known)),
        ("gap", _gap),
        ("time", lambda row: f"{row.seconds:.1f} s"),
        ("exact time", lambda row: _seconds(row.exact_seconds)),
        *((name, _peer(name)) for name in peers),
    ]


def _gap(row: GapRow) -> str:
    if row.gap is None:
        return ""
    return gap_text(0.0 if row.status == Status.OPTIMAL else row.gap)


def _peer(name: str) -> Callable[[GapRow], str]:
    def text(row: GapRow) -> str:
        answer = row.peers.get(name)
        if answer is None:
            return ""
        return answer.status if answer.objective is None else _number(answer.objective)

    return text


def _print_solvers(summary: GapSummary) -> None:
    cells = [
        (
            name,
            f"{solver.answered}",
            f"{solver.rejected}",
            f"{solver.reached}",
            *(
                f"{100 * share:.2f} %"
                for share in (
                    solver.mean_shortfall,
                    solver.median_shortfall,
                    solver.worst_shortfall,
                )
            ),
            _seconds(solver.seconds),
        )
        for name, solver in summary.solvers.items()
    ]
    header = ("below the best known", "plans", "rejected", "level", "mean", "median", "worst")
    _print_table((*header, "time"), cells)


def _print_table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Print a line a row, however many columns there are; names flush left, figures right."""
    widths = [max(map(len, column)) for column in zip(header, *rows, strict=True)]
    for row in (header, *rows):
        first, *figures = (
            cell.rjust(width) if place else cell.ljust(width)
            for place, (cell, width) in enumerate(zip(row, widths, strict=True))
        )
        tell("  ".join([first, *figures]))


def _number(value: float | None) -> str:
    return "" if value is None else f"{value:.6g}"


def _seconds(seconds: float | None) -> str:
    return "" if seconds is None else f"{seconds:.1f} s"
