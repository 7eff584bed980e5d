"""The native instance file: JSON, ``"format": "fiveroute-instance/1"``.

It holds everything an `Instance` knows, one node a line, and loses no bit of a number.
Some keys are left out where they say nothing out of the ordinary: ``metric`` (how coordinates
become distances), ``travel_times``, the ``depth`` of a node, the fleet's ``turning_radius``,
``depth`` and ``depth_rating``, the ocean's ``margin``, and the ``depth`` and ``begin`` of its
currents.
"""

from __future__ import annotations

import hashlib
import json
import os
from dataclasses import asdict, fields, replace
from pathlib import Path, PurePath
from typing import Any, Literal

from pydantic import ConfigDict
from pydantic.dataclasses import dataclass

from fiveroute.errors import InputError
from fiveroute.formats.json_document import layout, read_document
from fiveroute.instance import TURNING_RADIUS, Instance

__all__ = [
    "TAG",
    "InstanceDocument",
    "currents_file",
    "instance_document",
    "instance_hash",
    "read",
    "relocated",
    "require_name",
    "write",
]

TAG = "fiveroute-instance/1"


@dataclass(
    frozen=True,
    slots=True,
    kw_only=True,
    config=ConfigDict(extra="forbid", strict=True, allow_inf_nan=False),
)
class InstanceDocument(Instance):
    """An instance with its format tag, as it stands in a file."""

    format: Literal["fiveroute-instance/1"]

    @property
    def instance(self) -> Instance:
        """The instance without the tag."""
        return Instance(**{field.name: getattr(self, field.name) for field in fields(Instance)})


def read(text: str, name: str) -> Instance:
    """Read an instance; it states its own name, so that of the file is not used."""
    return read_document(text, InstanceDocument, TAG).instance


def write(instance: Instance) -> str:
    """Write an instance."""
    return layout(instance_document(instance)) + "\n"


def instance_document(instance: Instance) -> dict[str, Any]:
    """The document as plain dictionaries and lists, keys in their order in the file."""
    document = {"format": TAG, **asdict(instance)}
    for node in document["nodes"]:
        _drop_unstated(node, "service_time", "depth")
    _drop_unstated(document["fleet"], "depth", "depth_rating")
    if instance.metric == "euclidean":
        del document["metric"]
    if instance.travel_times is None:
        del document["travel_times"]
    if instance.fleet.turning_radius == TURNING_RADIUS:
        del document["fleet"]["turning_radius"]
    if instance.ocean.margin == 0.0:
        del document["ocean"]["margin"]
    for key in ("depth", "begin"):
        if not document["ocean"]["currents"][key]:
            del document["ocean"]["currents"][key]
    return document


def _drop_unstated(part: dict[str, Any], *keys: str) -> None:
    for key in keys:
        if part[key] is None:
            del part[key]


def instance_hash(instance: Instance) -> str:
    """SHA-256 of the document, in hexadecimal.

    Neither the layout of the file counts nor the instance's name nor the folder of a file
    of currents: an instance keeps its hash when it is moved, renamed or converted.
    """
    document = instance_document(replace(instance, name=""))
    currents = document["ocean"]["currents"]
    if currents["file"] is not None:
        currents["file"] = PurePath(currents["file"]).name
    text = json.dumps(document, sort_keys=True, separators=(",", ":"), allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()


def currents_file(instance: Instance, path: Path) -> Path | None:
    """The file of currents that an instance names.

    Parameters
    ----------
    instance
        The instance.
    path
        File that the instance comes from; names in it are relative to its folder.
    """
    name = instance.ocean.currents.file
    return None if name is None else path.parent / name


def require_name(name: str) -> None:
    """Refuse the name of a file of currents that no text file can hold."""
    if any("\ud800" <= sign <= "\udfff" for sign in name):
        raise InputError(
            "is no UTF-8 text, so that no instance can name it; rename file or folder", value=name
        )


def relocated(instance: Instance, source: Path, target: Path) -> Instance:
    """The instance of file `source`, to be written to file `target`.

    A relative name of a file of currents is changed so that it means the same file.
    """
    file = currents_file(instance, source)
    if file is None or Path(str(instance.ocean.currents.file)).is_absolute():
        return instance
    name = PurePath(os.path.relpath(file, target.parent)).as_posix()
    require_name(name)
    currents = replace(instance.ocean.currents, file=name)
    return replace(instance, ocean=replace(instance.ocean, currents=currents))
