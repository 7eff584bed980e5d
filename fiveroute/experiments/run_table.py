"""Tables of simulated runs, and logs of what happened in them."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path
from typing import Any

from fiveroute.errors import InputError
from fiveroute.formats.files import write_text_atomically, written_whole
from fiveroute.instance import Instance
from fiveroute.sea.simulation import SimulationResult

__all__ = ["event_lines", "require_table", "write_table"]


def event_lines(instance: Instance, result: SimulationResult) -> str:
    """A JSON document a line for every event: run, t in seconds, auv from 0, kind, node."""
    lines = []
    for run in result.runs:
        for event in run.events:
            line: dict[str, Any] = {
                "run": run.run,
                "t": float(event.t),
                "auv": int(event.auv),
                "kind": event.kind,
            }
            if event.node is not None:
                line["node"] = instance.nodes[event.node - 1].id
            lines.append(json.dumps(line, allow_nan=False) + "\n")
    return "".join(lines)


def require_table(path: Path) -> None:
    """Refuse a table that could not be written, before any time is spent."""
    if path.suffix not in (".parquet", ".csv"):
        raise InputError("a table ends in .parquet or .csv", field="output", value=str(path))
    if path.suffix == ".parquet":
        try:
            import pyarrow.parquet  # noqa: F401
        except ImportError:
            raise InputError(
                "needs Arrow; install fiveroute[parquet], or write a .csv file",
                field="output",
                value=str(path),
            ) from None


def write_table(result: SimulationResult, path: Path, force: bool = False) -> None:
    """Write a row a run, whole or not at all: planner, run, completion, what became of the AUVs."""
    rows = [
        {
            "planner": result.planner,
            "run": run.run,
            "completion": run.completion,
            "clairvoyant": run.clairvoyant,
            "late_returns": run.late_returns,
            "double_visits": run.double_visits,
            "false_takeovers": run.false_takeovers,
            "sent": run.sent,
            "delivered": run.delivered,
        }
        for run in result.runs
    ]
    if path.suffix == ".csv":
        text = io.StringIO()
        writer = csv.DictWriter(text, rows[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
        write_text_atomically(path, text.getvalue(), force)
        return
    import pyarrow
    import pyarrow.parquet

    try:
        with written_whole(path) as draft:
            pyarrow.parquet.write_table(pyarrow.Table.from_pylist(rows), draft)
    except OSError as error:
        raise InputError(f"cannot be written ({error.strerror})", file=path) from None
