"""JSON documents with a format tag, validated against a dataclass.

Every fault comes out as one `InputError`: the first thing that is wrong, where it stands,
and how many more there are.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from typing import Any, TypeVar, get_args, get_type_hints

import pydantic_core
from pydantic import TypeAdapter, ValidationError
from pydantic_core import ErrorDetails

from fiveroute.errors import InputError, nearest

__all__ = ["layout", "parsed", "read_document", "translated"]

T = TypeVar("T")
Location = list[str | int]

_UNKNOWN_KEY = "unexpected_keyword_argument"


def read_document(text: str, model: type[T], tag: str) -> T:
    """Read a document.

    Parameters
    ----------
    text
        JSON text.
    model
        Pydantic dataclass that it must fit.
    tag
        What its key ``format`` must say.

    Raises
    ------
    InputError
        If the text is no JSON, has another tag, or breaks a rule of the model.
    """
    document = parsed(text)
    _require_tag(document, tag)
    try:
        return TypeAdapter(model).validate_json(text)
    except ValidationError as error:
        raise translated(error, document, model) from None


def parsed(text: str) -> Any:
    """What a JSON text holds: objects as dictionaries, of equal keys the last one.

    Raises
    ------
    InputError
        If the text is no JSON, is nested more than 200 deep, or holds half a character.
    """
    try:
        return pydantic_core.from_json(text)
    except ValueError as error:
        raise _syntax_error(str(error)) from None


def layout(value: Any, indent: str = "") -> str:
    """JSON text for people: a container of plain values takes one line.

    Numbers are written as short as they can be without losing a bit.
    """
    parts = value.values() if isinstance(value, Mapping) else value
    if not isinstance(value, (Mapping, list, tuple)) or not any(map(_holds_something, parts)):
        return json.dumps(value, ensure_ascii=False, allow_nan=False)
    inner = indent + "  "
    if isinstance(value, Mapping):
        opening, closing = "{}"
        lines = [
            f"{json.dumps(key, ensure_ascii=False)}: {layout(part, inner)}"
            for key, part in value.items()
        ]
    else:
        opening, closing = "[]"
        lines = [layout(part, inner) for part in value]
    return f"{opening}\n{inner}" + f",\n{inner}".join(lines) + f"\n{indent}{closing}"


def _holds_something(value: Any) -> bool:
    return isinstance(value, (Mapping, list, tuple)) and len(value) > 0


def _syntax_error(message: str) -> InputError:
    found = re.fullmatch(r"(.*) at line (\d+) column (\d+)", message, re.DOTALL)
    reason, line, column = found.groups() if found else (message, None, None)
    if reason.startswith("EOF"):
        rule = "the JSON text ends too early; the file is cut off, copy it again"
    elif reason.startswith("recursion"):
        rule = "the JSON text is nested too deeply; use the keys of the format only"
    else:
        where = f" (column {column})" if column else ""
        rule = f"is no JSON: {reason}{where}; correct the line"
    return InputError(rule, line=int(line) if line else None)


def _require_tag(document: object, tag: str) -> None:
    if not isinstance(document, dict):
        raise InputError(f'must be a JSON object with "format": "{tag}"')
    if "format" not in document:
        raise InputError(f'is missing; add "format": "{tag}"', field="format")
    if document["format"] != tag:
        kind = tag.partition("/")[0].removeprefix("fiveroute-")
        raise InputError(
            f'is not the format of this file; a fiveroute {kind} says "format": "{tag}"',
            field="format",
            value=document["format"],
        )


def translated(error: ValidationError, document: object, model: type) -> InputError:
    """The first fault that pydantic found, in one sentence of ours.

    A key that nobody knows comes first: it is often the reason why another one is missing.

    Parameters
    ----------
    error
        What pydantic says.
    document
        The parsed document, which tells real keys from pydantic's own marks.
    model
        Dataclass that the document should fit, for the names of its keys.
    """
    faults = sorted(error.errors(), key=lambda fault: fault["type"] != _UNKNOWN_KEY)
    location = _location(faults[0], document)
    missing = faults[0]["type"] == "missing"
    rule = _rule(faults[0], location, model)
    if len(faults) > 1:
        rule += f" (faults after this one: {len(faults) - 1})"
    return InputError(
        rule, field=_written(location) or None, value=None if missing else faults[0]["input"]
    )


def _location(fault: ErrorDetails, document: object) -> Location:
    """Where in the document a fault is, without the union members in pydantic's path."""
    path: Location = []
    here: Any = document
    last = fault["loc"][-1:]
    for part in fault["loc"]:
        is_key = isinstance(here, dict) and part in here
        if is_key or (isinstance(here, list) and isinstance(part, int) and part < len(here)):
            here = here[part]
        elif not (fault["type"] == "missing" and (part,) == last):
            continue
        path.append(part)
    return path


def _written(location: Location) -> str:
    text = ""
    for part in location:
        if isinstance(part, int):
            text += f"[{part}]"
        elif part.isidentifier():
            text += f".{part}"
        else:
            text += f"[{part[:40]!r}]"
    return text.removeprefix(".")


def _rule(fault: ErrorDetails, location: Location, model: type) -> str:
    kind = fault["type"]
    if kind == _UNKNOWN_KEY:
        return f"is no key of this format; {nearest(str(location[-1]), _keys(model, location))}"
    if kind == "missing":
        return "is missing; add this key"
    if kind == "string_type":
        return "must be text; write it in quotes"
    if kind in ("float_type", "int_type") and isinstance(fault["input"], str):
        return "must be a number; write it without quotes"
    if kind == "too_short":
        return f"must have at least {fault['ctx']['min_length']} entries; add some"
    return f"{fault['msg'].replace('Input should be', 'must be')}; correct the value"


def _keys(model: type, location: Location) -> list[str]:
    """Keys that are valid beside the last one of a location."""
    models = [model]
    for part in location[:-1]:
        if isinstance(part, str):
            models = [
                found
                for one in models
                for found in _dataclasses(get_type_hints(one, include_extras=True).get(part))
            ]
    return sorted({field.name for one in models for field in fields(one)})


def _dataclasses(annotation: Any) -> Iterator[type]:
    """All dataclasses that an annotation mentions."""
    if isinstance(annotation, type) and is_dataclass(annotation):
        yield annotation
    for part in get_args(annotation):
        yield from _dataclasses(part)
