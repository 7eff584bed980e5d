"""One quantity varied, and what becomes of the plan: a row a value.

All questions give the same kind of answer, so that they share one table, one picture and one way to
be interrupted: what is done by then is the answer.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from html import escape

import numpy as np

from fiveroute.fleet_plan import FleetPlan
from fiveroute.limits import Clock, Limits, Progress, ProgressCallback
from fiveroute.problem import completion_rate
from fiveroute.words import ENDLESS, clock

__all__ = ["Row", "Sweep", "figures", "heading", "seen_columns", "shown", "vary"]

_ONLY_IN_FILES = {"routes", "bound", "objective", "held_out_p25", "held_out_p75"}
_ONLY_IF_ANY = {"unreachable"}
_DATES = {"departure"}
_TIMES = {"endurance", "mean_duration"}
_SHARES = {"completion_rate", "bound_rate", "gap", "late_share", "p5", "p95"}
_HEADINGS = {
    "fleet_size": "AUVs",
    "hours": "departure",
    "departure": "UTC",
    "unreachable": "out of reach",
    "training_cvar": "training CVaR",
    "held_out_cvar": "held out CVaR",
    "completion_rate": "collected",
    "bound_rate": "at most",
    "mean_duration": "mean time",
    "late_share": "late",
    "p5": "5 % below",
    "p95": "5 % above",
    "power": "watts",
}

Value = float | int | str | None
Row = Mapping[str, Value]


@dataclass(frozen=True, slots=True)
class Sweep:
    """What came of every value.

    Parameters
    ----------
    instance
        Name of the mission.
    quantity
        Column that was varied.
    unit
        Its unit; empty without one.
    rows
        A row a value, all with the same columns.
    marked
        The value to point out; None without one.
    because
        Why, in a few words.
    left_out
        Values that there was no time for.
    """

    instance: str
    quantity: str
    unit: str
    rows: tuple[Row, ...]
    marked: Value = None
    because: str = ""
    left_out: tuple[float, ...] = ()

    def marking(self, value: Value, because: str) -> Sweep:
        """The same with a value pointed out."""
        return replace(self, marked=value, because=because)

    def best(self, column: str, *, least: str = "") -> Row | None:
        """The row of the greatest figure in a column; None where all are missing.

        Of equals it is the one of the least figure in the column `least`, or else the first one.
        """

        def worth(row: Row) -> tuple[float, float]:
            cost = _number(row[least]) if least else None
            return _number(row[column]) or 0.0, -(cost or 0.0)

        return max((row for row in self.rows if row[column] is not None), key=worth, default=None)

    def _repr_html_(self) -> str:
        """The table, for notebooks; the value to point out is bold."""
        columns = seen_columns(self)
        head = "".join(f"<th>{escape(heading(name))}</th>" for name in columns)
        body = "".join(self._html_row(row, columns) for row in self.rows)
        title = f"<b>{escape(self.instance)}</b>" + escape(self.because and f": {self.because}")
        return f"<div>{title}<table><tr>{head}</tr>{body}</table></div>"

    def _html_row(self, row: Row, columns: Sequence[str]) -> str:
        tag = "th" if row[self.quantity] == self.marked else "td"
        cells = (escape(shown(name, row[name])) for name in columns)
        return f"<tr>{''.join(f'<{tag}>{cell}</{tag}>' for cell in cells)}</tr>"


def vary(
    instance: str,
    quantity: str,
    unit: str,
    values: Sequence[float],
    row: Callable[[float, Limits], Row],
    *,
    clock: Clock,
    progress: ProgressCallback | None = None,
) -> Sweep:
    """Work a row out for every value, in their order, each in its share of the time that is left.

    Parameters
    ----------
    instance, quantity, unit
        See `Sweep`.
    values
        The values.
    row
        The further columns of a value.
    clock
        When to stop; one row is worked out in any case. One that is interrupted is kept only
        where there is no other.
    progress
        Told what is at work.
    """
    rows: list[Row] = []
    for done, value in enumerate(values):
        if rows and clock.expired:
            break
        if progress is not None:
            message = f"{quantity.replace('_', ' ')} {value:g} ({done + 1} of {len(values)})"
            progress(Progress(clock.seconds, message=message))
        limits = clock.limits.within(clock.left / (len(values) - done))
        found = row(value, limits)
        if rows and clock.interrupted:  # cut short: to compare it would mislead
            break
        rows.append({quantity: value, **found})
    return Sweep(instance, quantity, unit, tuple(rows), left_out=tuple(values[len(rows) :]))


def figures(plan: FleetPlan) -> dict[str, Value]:
    """The columns of a plan that sweeps have in common."""
    total, bound = plan.instance.total_data, plan.bound
    return {
        "status": plan.status.value,
        "objective": plan.objective,
        "completion_rate": plan.completion_rate,
        "bound": bound,
        "bound_rate": None if bound is None else min(completion_rate(bound, total), 1.0),
        "gap": plan.gap,
        "nodes": sum(map(len, plan.routes)),
        "mean_duration": float(np.mean(plan.durations)) if plan.durations else None,
        "unreachable": len(plan.unreachable),
    }


def seen_columns(sweep: Sweep) -> list[str]:
    """The columns that people want to see."""
    return [
        name
        for name in (sweep.rows[0] if sweep.rows else ())
        if name not in _ONLY_IN_FILES
        and (name not in _ONLY_IF_ANY or any(row[name] for row in sweep.rows))
    ]


def heading(name: str) -> str:
    """What a column is called in a table for people."""
    return _HEADINGS.get(name, name.replace("_", " "))


def shown(name: str, value: Value) -> str:
    """A figure of a column as people read it: shares in per cent, times as h:mm:ss."""
    if value is None:
        return "-"
    if not isinstance(value, float):
        return str(value).replace("T", " ").removesuffix(":00") if name in _DATES else str(value)
    if name in _TIMES:
        return clock(value)
    if name in _SHARES or name.startswith(("training_", "held_out_")):
        return f"{100.0 * value:.1f} %" if value < ENDLESS else "endless"
    return f"{value:.4g}"


def _number(value: Value) -> float | None:
    return float(value) if isinstance(value, (int, float)) else None
