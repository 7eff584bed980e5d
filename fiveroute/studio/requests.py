"""What the page may ask for: a table of addresses, each with the JSON it takes and answers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from typing import Annotated, Any, TypeVar

import pydantic_core
from pydantic import ConfigDict, Field, NonNegativeFloat, TypeAdapter, ValidationError
from pydantic.dataclasses import dataclass as validated

from fiveroute.errors import InputError
from fiveroute.formats.json_document import translated
from fiveroute.studio.edits import Edit
from fiveroute.studio.planning import Wish
from fiveroute.studio.session import Session
from fiveroute.vehicle_files import Choices
from fiveroute.vehicle_files.from_plan import TOLERANCE

__all__ = ["READS", "WRITES", "answer"]

T = TypeVar("T")

_STRICT = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False)

_REMEDIES = {
    "pass --depth D in metres": "enter a depth in metres",
    "pass a smaller --depth": "enter a smaller depth",
    "pass --origin LON,LAT": "enter the origin's longitude, latitude",
    "pass --auv K": "enter one AUV",
    "pass a larger --tolerance": "enter a larger tolerance",
}

_Name = Annotated[str, Field(min_length=1, max_length=200)]


@validated(frozen=True, slots=True, config=_STRICT)
class _Nothing:
    pass


@validated(frozen=True, slots=True, config=_STRICT)
class _Change:
    revision: int
    edit: Edit


@validated(frozen=True, slots=True, config=_STRICT)
class _Saving:
    instance: _Name | None = None
    plan: _Name | None = None
    overwrite: bool = False


@validated(frozen=True, slots=True, config=_STRICT)
class _Export:
    format: str
    name: _Name
    depth: NonNegativeFloat | None = None
    origin: tuple[float, float] | None = None
    auv: Annotated[int, Field(ge=1)] | None = None
    vehicles: tuple[str, ...] = ()
    departure: datetime | None = None
    tolerance: NonNegativeFloat = TOLERANCE
    overwrite: bool = False

    @property
    def choices(self) -> Choices:
        """The same for the writers."""
        return Choices(
            depth=self.depth,
            origin=self.origin,
            auv=self.auv,
            names=self.vehicles,
            departure=self.departure,
            tolerance=self.tolerance,
        )


@dataclass(frozen=True, slots=True)
class Request:
    """A request with a body.

    Parameters
    ----------
    body
        Dataclass that the body must fit.
    do
        ``do(session, body)`` gives the answer.
    """

    body: type
    do: Callable[[Session, Any], dict[str, Any]]


def _edit(session: Session, change: _Change) -> dict[str, Any]:
    session.edit(change.revision, change.edit)
    return session.told()


def _undo(session: Session, _: _Nothing) -> dict[str, Any]:
    session.step(-1)
    return session.told()


def _redo(session: Session, _: _Nothing) -> dict[str, Any]:
    session.step(1)
    return session.told()


def _plan(session: Session, wish: Wish) -> dict[str, Any]:
    session.plan(wish)
    return session.progress()


def _stop(session: Session, _: _Nothing) -> dict[str, Any]:
    session.stop()
    return session.progress()


def _save(session: Session, saving: _Saving) -> dict[str, Any]:
    names = session.save(saving.instance, saving.plan, saving.overwrite)
    return {"names": names, "saved": session.is_saved}


def _export(session: Session, export: _Export) -> dict[str, Any]:
    try:
        return session.export(export.format, export.name, export.choices, export.overwrite)
    except InputError as error:
        raise _of_the_form(error) from None


def _of_the_form(error: InputError) -> InputError:
    """The same error with the remedies of the page's form for those of the command line."""
    rule = error.rule
    for option, field in _REMEDIES.items():
        rule = rule.replace(option, field)
    where = None if error.field is None else error.field.removeprefix("--")
    return InputError(rule, value=error.value, field=where, file=error.file, line=error.line)


READS: dict[str, Callable[[Session], dict[str, Any]]] = {
    "/api/state": Session.told,
    "/api/progress": Session.progress,
}
"""What is asked for without a body."""

WRITES = {
    "/api/edit": Request(_Change, _edit),
    "/api/undo": Request(_Nothing, _undo),
    "/api/redo": Request(_Nothing, _redo),
    "/api/plan": Request(Wish, _plan),
    "/api/stop": Request(_Nothing, _stop),
    "/api/save": Request(_Saving, _save),
    "/api/export": Request(_Export, _export),
}
"""What is asked for with one."""


def answer(session: Session, address: str, body: bytes) -> dict[str, Any]:
    """Do what a request with a body asks for.

    Raises
    ------
    InputError
        If the body is no JSON, breaks a rule, or asks for what cannot be done.
    """
    request = WRITES[address]
    return request.do(session, _read(body, request.body))


def _read(body: bytes, model: type[T]) -> T:
    try:
        document = pydantic_core.from_json(body)
    except ValueError as error:
        raise InputError(f"the request is no JSON ({error})") from None
    try:
        return TypeAdapter(model).validate_json(body)
    except ValidationError as error:
        raise translated(error, document, model) from None
