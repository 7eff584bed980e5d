"""How far is the planner from optimal? A row an instance, and a summary.

Every row sets the planner's plan against the best proven bound that could be had in the
time given: the quick bound, and that of an exact method started from the plan.
"""

from __future__ import annotations

import csv
import io
import math
import statistics
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, fields
from pathlib import Path

from fiveroute.errors import InputError
from fiveroute.limits import Limits, ProgressCallback
from fiveroute.mission import MissionPlan, plan_mission
from fiveroute.paths.voyage import Voyage
from fiveroute.result import Result, Status, is_closed, optimality_gap

__all__ = ["GapRow", "GapSummary", "gap_row", "gap_table_csv", "read_reference", "summarise"]


@dataclass(frozen=True, slots=True)
class GapRow:
    """One instance.

    Parameters
    ----------
    instance
        Its name.
    nodes, fleet_size
        Number of sensor nodes and of AUVs.
    heuristic
        Data that the planner's plan collects; None without a plan.
    bound
        Least proven upper bound; None where none was computed.
    best_known
        Best value known: of the planner, the exact method or the reference table.
    gap
        (bound - heuristic) / heuristic; None without both.
    status
        How well the plan is known: ``optimal`` where the bound proves it.
    seconds
        Wall-clock time of the planner alone.
    """

    instance: str
    nodes: int
    fleet_size: int
    heuristic: float | None
    bound: float | None
    best_known: float | None
    gap: float | None
    status: str
    seconds: float


@dataclass(frozen=True, slots=True)
class GapSummary:
    """All instances together; shares and gaps are fractions, None without any figure.

    `proved` counts plans proved optimal, `reached` those as good as the best known value,
    `gap_to_best_known` is (best_known - heuristic) / best_known.
    """

    instances: int
    proved: int
    reached: int
    mean_gap: float | None
    median_gap: float | None
    worst_gap: float | None
    mean_gap_to_best_known: float | None
    seconds: float


def gap_row(
    voyage: Voyage,
    *,
    plan_limits: Limits,
    exact_limits: Limits,
    seed: int = 0,
    reference: Mapping[str, float] | None = None,
    progress: ProgressCallback | None = None,
) -> GapRow:
    """Plan one instance, bound it, and compare.

    Parameters
    ----------
    voyage
        The instance, and its leg times.
    plan_limits, exact_limits
        Limits of the planner, and of quick bound and exact method together.
    seed
        Seed of the planner.
    reference
        Best-known values by instance name.
    progress
        Called as the run goes on.
    """
    instance = voyage.instance
    planned = plan_mission(
        instance,
        travel=voyage.travel,
        bound="none",
        limits=plan_limits,
        seed=seed,
        progress=progress,
    )
    exact = _bounded(planned, exact_limits, progress)
    value, bound = planned.result.objective, exact.bound
    known = [v for v in (value, exact.objective, (reference or {}).get(instance.name)) if v]
    return GapRow(
        instance=instance.name,
        nodes=planned.problem.n,
        fleet_size=planned.problem.fleet_size,
        heuristic=value,
        bound=bound,
        best_known=max(known, default=value),
        gap=optimality_gap(value, bound),
        status=_status(planned.result, bound),
        seconds=planned.result.seconds,
    )


def _bounded(planned: MissionPlan, limits: Limits, progress: ProgressCallback | None) -> Result:
    """The best bound to be had: quick first, exact in the time that is left."""
    from fiveroute.models import solve
    from fiveroute.models.bounds import quick_bound

    clock = limits.start()
    problem, plan = planned.problem, planned.result.plan
    quick = quick_bound(problem, limits)
    result = Result.judged(
        problem, plan, method=quick.method, seconds=clock.seconds, bound=quick.value
    )
    if result.status is Status.OPTIMAL or clock.expired:
        return result
    exact = solve(problem, "auto", clock.rest(), warm_start=plan, progress=progress)
    best = exact.plan if (exact.objective or -1.0) > (result.objective or -1.0) else plan
    bound = min(quick.value, math.inf if exact.bound is None else exact.bound)
    return Result.judged(problem, best, method=exact.method, seconds=clock.seconds, bound=bound)


def _status(planned: Result, bound: float | None) -> str:
    if planned.objective is not None and bound is not None and is_closed(planned.objective, bound):
        return Status.OPTIMAL.value
    return planned.status.value


def summarise(rows: Sequence[GapRow]) -> GapSummary:
    """Summary of a table."""
    gaps = [row.gap for row in rows if row.gap is not None]
    short = [
        max(row.best_known - row.heuristic, 0.0) / row.best_known if row.best_known else 0.0
        for row in rows
        if row.best_known is not None and row.heuristic is not None
    ]
    return GapSummary(
        instances=len(rows),
        proved=sum(row.status == Status.OPTIMAL.value for row in rows),
        reached=sum(s <= 1e-9 for s in short),
        mean_gap=statistics.fmean(gaps) if gaps else None,
        median_gap=statistics.median(gaps) if gaps else None,
        worst_gap=max(gaps, default=None),
        mean_gap_to_best_known=statistics.fmean(short) if short else None,
        seconds=sum(row.seconds for row in rows),
    )


def gap_table_csv(rows: Sequence[GapRow]) -> str:
    """The table as CSV text, a header line first; what is unknown stays empty."""
    text = io.StringIO()
    writer = csv.DictWriter(text, [field.name for field in fields(GapRow)], lineterminator="\n")
    writer.writeheader()
    writer.writerows(asdict(row) for row in rows)
    return text.getvalue()


def read_reference(path: Path) -> dict[str, float]:
    """Best-known values from a CSV file with the columns ``instance`` and ``best_known``.

    Raises
    ------
    InputError
        If the file cannot be read, a column is missing, or a value is not a number.
    """
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"cannot be read ({error}); check the path", file=path) from None
    reader = csv.DictReader(lines)
    if not {"instance", "best_known"} <= set(reader.fieldnames or ()):
        raise InputError(
            "needs the columns instance and best_known", value=reader.fieldnames, file=path, line=1
        )
    values = {}
    for row in reader:
        try:
            values[row["instance"]] = float(row["best_known"])
        except (TypeError, ValueError):
            raise InputError(
                "must be a number",
                field="best_known",
                value=row["best_known"],
                file=path,
                line=reader.line_num,
            ) from None
    return values
