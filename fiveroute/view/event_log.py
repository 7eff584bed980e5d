"""Logs of simulated runs, as ``fiveroute simulate --events`` writes them: a JSON object a line."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import ConfigDict, Field, NonNegativeFloat, TypeAdapter, ValidationError
from pydantic.dataclasses import dataclass as validated
from pydantic_core import from_json

from fiveroute.errors import InputError
from fiveroute.formats.files import numbered_lines, read_text
from fiveroute.formats.json_document import translated
from fiveroute.formats.plan_file import PlanFile
from fiveroute.instance import Many
from fiveroute.sea.events import Event, Frame, Kind

__all__ = ["RunLog", "read_events", "run_logs"]


@dataclass(frozen=True, slots=True)
class RunLog:
    """What happened in one run.

    Parameters
    ----------
    run
        Number of the run.
    events
        Its events, in the order of time; nodes are vertices of the plan's instance.
    tracks
        Metres and seconds x, y, t of every AUV, each of shape (any, 3); None where they are not
        known.
    """

    run: int
    events: tuple[Event, ...]
    tracks: tuple[NDArray[np.float64], ...] | None = field(default=None, compare=False)


_Whole = Annotated[int, Field(ge=0, lt=2**53)]


@validated(frozen=True, slots=True, config=ConfigDict(extra="forbid", strict=True))
class _Heard:
    auv: _Whole
    t: Annotated[NonNegativeFloat, Field(allow_inf_nan=False)]


@validated(frozen=True, slots=True, config=ConfigDict(extra="forbid", strict=True))
class _Message:
    number: _Whole
    kind: Annotated[str, Field(max_length=40)]
    sender: _Whole
    receiver: _Whole | None
    bits: _Whole
    heard: Many[_Heard] = ()


@validated(frozen=True, slots=True, config=ConfigDict(extra="forbid", strict=True))
class _Line:
    run: Annotated[int, Field(ge=0)]
    t: Annotated[NonNegativeFloat, Field(allow_inf_nan=False)]
    auv: Annotated[int, Field(ge=0)]
    kind: Kind
    node: str | None = None
    message: _Message | None = None


_LINE = TypeAdapter(_Line)
_AT_NODES = ("collect", "discard", "pick_up")


class _Names(NamedTuple):
    vertices: Mapping[str, int]
    fleet_size: int

    def require_auv(self, name: str, auv: int) -> None:
        """Refuse an AUV that the plan does not have."""
        if auv >= self.fleet_size:
            raise InputError(
                f"the plan has {self.fleet_size} AUVs, counted from 0; use the plan that was "
                f"sailed",
                field=name,
                value=auv,
            )


def read_events(path: Path, plan: PlanFile) -> tuple[RunLog, ...]:
    """Read a log of runs of a plan.

    Parameters
    ----------
    path
        The file.
    plan
        The plan that was carried out.

    Raises
    ------
    InputError
        If a line is no event, or names an AUV or a node that the plan does not have.
    """
    return run_logs(read_text(path), plan, path)


def run_logs(text: str, plan: PlanFile, path: Path | None = None) -> tuple[RunLog, ...]:
    """The runs of a log in the order of their numbers.

    Parameters
    ----------
    text
        A JSON object a line.
    plan
        The plan that was carried out.
    path
        File that errors name.
    """
    names = _Names(
        {node.id: vertex for vertex, node in enumerate(plan.instance.nodes, start=1)},
        len(plan.routes),
    )
    runs: dict[int, list[Event]] = {}
    for line, content in numbered_lines(text):
        try:
            run, event = _event(content, names)
        except InputError as error:
            raise InputError(
                error.rule, value=error.value, field=error.field, file=path, line=line
            ) from None
        runs.setdefault(run, []).append(event)
    return tuple(
        RunLog(run, tuple(sorted(events, key=lambda event: event.t)))
        for run, events in sorted(runs.items())
    )


def _event(content: str, names: _Names) -> tuple[int, Event]:
    try:
        line = _LINE.validate_json(content)
    except ValidationError as error:
        raise _fault(error, content) from None
    names.require_auv("auv", line.auv)
    frame = None if line.message is None else _frame(line.message, names)
    if line.node is None:
        if line.kind in _AT_NODES:
            raise InputError("is missing; add the node concerned", field="node")
        return line.run, Event(line.t, line.auv, line.kind, frame=frame)
    if line.node not in names.vertices:
        raise InputError(
            "is no node of the plan's instance; use the plan that was sailed",
            field="node",
            value=line.node,
        )
    return line.run, Event(line.t, line.auv, line.kind, names.vertices[line.node], frame)


def _frame(message: _Message, names: _Names) -> Frame:
    """The message without those who heard it: events of their own tell that."""
    names.require_auv("message.sender", message.sender)
    if message.receiver is not None:
        names.require_auv("message.receiver", message.receiver)
    return Frame(message.number, message.sender, message.receiver, message.kind, message.bits)


def _fault(error: ValidationError, content: str) -> InputError:
    try:
        document = from_json(content)
    except ValueError:
        return InputError("is no JSON; a log has an object a line", value=content)
    if not isinstance(document, dict):
        return InputError("is no event; a log has an object a line", value=content)
    return translated(error, document, _Line)
