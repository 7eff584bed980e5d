"""How far from optimal, over many instances: the summary of a gap table, and the table itself.

Solvers are compared by their shortfall, (best known - value) / best known. Who has no answer, or
one that the judge rejects, has collected nothing: a shortfall of 1, unless there is nothing to
collect.
"""

from __future__ import annotations

import csv
import io
import statistics
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from fiveroute.errors import InputError
from fiveroute.experiments.gap_row import GapRow
from fiveroute.formats.files import number, read_text
from fiveroute.result import Status

__all__ = [
    "GapSummary",
    "SolverSummary",
    "flat_rows",
    "proof_times",
    "read_reference",
    "shortfalls",
    "summarise",
]


@dataclass(frozen=True, slots=True)
class SolverSummary:
    """One solver over all instances; shortfalls are fractions.

    Parameters
    ----------
    answered
        Instances with a plan that the judge accepts.
    rejected
        Instances with a plan that he does not.
    reached
        Instances where the best known value is reached.
    mean_shortfall, median_shortfall, worst_shortfall
        Over all instances.
    seconds
        Wall-clock time in all.
    """

    answered: int
    rejected: int
    reached: int
    mean_shortfall: float
    median_shortfall: float
    worst_shortfall: float
    seconds: float


@dataclass(frozen=True, slots=True)
class GapSummary:
    """All instances together; shares and gaps are fractions, None without any figure.

    Parameters
    ----------
    instances
        Their number.
    proved
        Plans that are proved optimal.
    solved
        Instances that the exact method has solved, by whatever plan.
    reached
        Plans as good as the best known value.
    mean_gap, median_gap, worst_gap
        (bound - value) / value.
    mean_gap_to_best_known
        Mean shortfall of the plans.
    seconds
        Wall-clock time of the planner, in all.
    contradictions
        Instances where a value, most likely a published one, is above the proven bound.
    solvers
        Everybody who ran, by name.
    """

    instances: int
    proved: int
    solved: int
    reached: int
    mean_gap: float | None
    median_gap: float | None
    worst_gap: float | None
    mean_gap_to_best_known: float | None
    seconds: float
    contradictions: tuple[str, ...] = ()
    solvers: Mapping[str, SolverSummary] = field(default_factory=dict)


def summarise(rows: Sequence[GapRow]) -> GapSummary:
    """Summary of a table."""
    gaps = [row.gap for row in rows if row.gap is not None]
    short = shortfalls(rows)
    solvers = {name: _solver(name, rows, missed) for name, missed in short.items()}
    ours = next(iter(solvers.values()), None)
    return GapSummary(
        instances=len(rows),
        proved=sum(row.status == Status.OPTIMAL for row in rows),
        solved=sum(row.is_solved for row in rows),
        reached=0 if ours is None else ours.reached,
        mean_gap=statistics.fmean(gaps) if gaps else None,
        median_gap=statistics.median(gaps) if gaps else None,
        worst_gap=max(gaps, default=None),
        mean_gap_to_best_known=None if ours is None else ours.mean_shortfall,
        seconds=sum(row.seconds for row in rows),
        contradictions=tuple(row.instance for row in rows if row.contradicts),
        solvers=solvers,
    )


def shortfalls(rows: Sequence[GapRow]) -> dict[str, list[float]]:
    """Everybody's shortfall on every instance of which a value is known, ours first."""
    compared = [row for row in rows if row.best_known is not None]
    names = dict.fromkeys(name for row in compared for name in row.values)
    ran = {
        "heuristic": any(row.heuristic is not None for row in rows),
        "exact": any(row.exact_seconds is not None for row in rows),
    }
    return {
        name: [_shortfall(row.values.get(name), row.best_known) for row in compared]
        for name in names
        if ran.get(name, True)
    }


def _shortfall(value: float | None, best: float | None) -> float:
    if best == 0.0:
        return 0.0
    return 1.0 if value is None or best is None else max(best - value, 0.0) / best


def _solver(name: str, rows: Sequence[GapRow], missed: Sequence[float]) -> SolverSummary:
    answers = [row.peers[name] for row in rows if name in row.peers]
    seconds = {
        "heuristic": sum(row.seconds for row in rows),
        "exact": sum(row.exact_seconds or 0.0 for row in rows),
    }
    return SolverSummary(
        answered=sum(row.values.get(name) is not None for row in rows),
        rejected=sum(answer.status == "rejected" for answer in answers),
        reached=sum(share <= 1e-9 for share in missed),
        mean_shortfall=statistics.fmean(missed),
        median_shortfall=statistics.median(missed),
        worst_shortfall=max(missed),
        seconds=seconds.get(name, sum(answer.seconds for answer in answers)),
    )


def proof_times(rows: Sequence[GapRow]) -> list[float | None]:
    """Seconds after which the exact method had solved every instance; None where it had not."""
    return [row.exact_seconds if row.is_solved else None for row in rows]


def flat_rows(rows: Sequence[GapRow]) -> list[dict[str, Any]]:
    """The table with a column a figure: those of a peer begin with its name."""
    names = dict.fromkeys(name for row in rows for name in row.peers)
    flat = []
    for row in rows:
        line = row.as_document()
        answers = line.pop("peers")
        for name in names:
            answer = answers.get(name, {})
            line[name] = answer.get("objective")
            line |= {f"{name}_{key}": answer.get(key) for key in ("status", "seconds")}
        flat.append(line)
    return flat


def read_reference(path: Path) -> dict[str, float]:
    """Best-known values from a CSV file with the columns ``instance`` and ``best_known``.

    Raises
    ------
    InputError
        If the file cannot be read, a column is missing, or a value is not a number.
    """
    reader = csv.DictReader(io.StringIO(read_text(path), newline=""))
    values = {}
    try:
        if not {"instance", "best_known"} <= set(reader.fieldnames or ()):
            raise InputError(
                "needs the columns instance and best_known; name them in the first line", line=1
            )
        for row in reader:
            known = row["best_known"] or ""
            values[row["instance"]] = number(known, "best_known", reader.line_num)
    except csv.Error as error:
        told = f"is no table: {error}; correct the line"
        raise InputError(told, file=path, line=reader.line_num) from None
    except InputError as error:
        raise error.at(path) from None
    return values
