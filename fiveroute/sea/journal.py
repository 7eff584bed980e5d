"""A journal: the runs of a campaign, a line each, written as they are done.

Lines are only ever added. A process that is killed in the middle of one leaves half a line,
which is not read; all runs before it are kept. When the campaign is over its results go where they
belong, and the journal away.
"""

from __future__ import annotations

import json
import math
import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from fiveroute.errors import InputError
from fiveroute.sea.events import Event, Frame
from fiveroute.sea.run_result import RunResult

__all__ = ["Journal"]


@dataclass(frozen=True, slots=True)
class Journal:
    """The journal of one campaign.

    Parameters
    ----------
    path
        Its file.
    """

    path: Path

    def runs(self) -> list[RunResult]:
        """The runs that are kept whole, in their order, each once."""
        try:
            lines = self.path.read_text(encoding="utf-8", errors="replace").splitlines()
        except OSError:
            return []
        known = {run.run: run for run in map(_run, lines) if run is not None}
        return [known[number] for number in sorted(known)]

    def add(self, runs: Iterable[RunResult]) -> None:
        """Keep runs; they are on the disk when this returns."""
        lines = (json.dumps(_document(run), default=_plain) for run in runs)
        with self._named(), self.path.open("a", encoding="utf-8") as stream:
            stream.write("".join(f"\n{line}\n" for line in lines))  # after half a line as well
            stream.flush()
            os.fsync(stream.fileno())

    def remove(self) -> None:
        """Throw the journal away."""
        with self._named():
            self.path.unlink(missing_ok=True)

    @contextmanager
    def _named(self) -> Iterator[None]:
        """Say which file it is that the disk does not take."""
        try:
            yield
        except OSError as error:
            told = f"cannot be written ({error.strerror}); check the disk"
            raise InputError(told, file=self.path) from None


def _document(run: RunResult) -> dict[str, Any]:
    arrivals = [t if math.isfinite(t) else None for t in run.arrivals]
    return asdict(run) | {"arrivals": arrivals, "events": [list(event) for event in run.events]}


def _run(line: str) -> RunResult | None:
    """The run of a line; None for an empty line, half a line, or one that is no run."""
    try:
        rest = json.loads(line)
        return RunResult(
            arrivals=tuple(math.inf if t is None else float(t) for t in rest.pop("arrivals")),
            events=tuple(map(_event, rest.pop("events"))),
            legs=tuple(tuple(map(tuple, legs)) for legs in rest.pop("legs")),
            **rest,
        )
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
        return None


def _event(entry: list[Any]) -> Event:
    event = Event(*entry)
    return event if event.frame is None else event._replace(frame=Frame(*event.frame))


def _plain(number: Any) -> Any:
    """A number of numpy's as one of Python's."""
    return number.item()
