"""What ``decide`` answers: a table of everything that was tried, and what it points out."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from fiveroute.cli.answers import print_table
from fiveroute.cli.notes import note, tell

if TYPE_CHECKING:
    from fiveroute.decide.sweep import Sweep

__all__ = ["note_left_out", "print_sweep", "sweep_answer"]


def sweep_answer(sweep: Sweep) -> dict[str, Any]:
    """The table as a document: a row a value, and the value that it points out."""
    return {
        "instance": sweep.instance,
        "quantity": sweep.quantity,
        "unit": sweep.unit,
        "rows": [dict(row) for row in sweep.rows],
        "marked": sweep.marked,
        "because": sweep.because,
        "left_out": list(sweep.left_out),
    }


def print_sweep(sweep: Sweep) -> None:
    """The table for people, and what it points out."""
    from fiveroute.decide.sweep import heading, seen_columns, shown

    columns = seen_columns(sweep)
    cells = [[shown(name, row[name]) for name in columns] for row in sweep.rows]
    print_table(sweep.instance, list(map(heading, columns)), cells, words=(0,))
    if sweep.marked is not None:
        unit = f" {sweep.unit}" if sweep.unit else ""
        marked = shown(sweep.quantity, sweep.marked)
        tell(f"{heading(sweep.quantity)} {marked}{unit}: {sweep.because}")
    elif sweep.because:
        tell(sweep.because)


def note_left_out(sweep: Sweep, *, interrupted: bool) -> None:
    """Say which values there was no time for."""
    from fiveroute.decide.sweep import heading

    if sweep.left_out:
        values = ", ".join(f"{value:g}" for value in sweep.left_out)
        told = f"{heading(sweep.quantity)} {values}"
        note(
            f"interrupted before the end of {told}"
            if interrupted
            else f"there was no time for {told}; give more with --time-limit"
        )
