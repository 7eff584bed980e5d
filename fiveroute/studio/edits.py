"""What can be changed in a mission, as the page asks for it.

Stops are vertices, as everywhere: 0 is the start, n + 1 the destination.
"""

from __future__ import annotations

from dataclasses import replace
from statistics import median_low
from typing import Annotated, Literal

from pydantic import ConfigDict, Field, NonNegativeFloat
from pydantic.dataclasses import dataclass

from fiveroute.errors import InputError
from fiveroute.instance import Fleet, Instance, Node, Point

__all__ = [
    "AddNode",
    "Edit",
    "MoveStop",
    "RemoveNode",
    "SetMission",
    "SetNode",
    "edited",
    "kept_ids",
]

_STRICT = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False)


@dataclass(frozen=True, slots=True, config=_STRICT)
class MoveStop:
    """Move a stop; start and destination move together where they coincide.

    Parameters
    ----------
    vertex
        The stop.
    x, y
        New position in metres.
    alone
        Whether to part start and destination.
    """

    do: Literal["move"]
    vertex: int
    x: float
    y: float
    alone: bool = False


@dataclass(frozen=True, slots=True, config=_STRICT)
class AddNode:
    """Add a node at a position in metres; without data it holds what a middling node does."""

    do: Literal["add"]
    x: float
    y: float
    data: NonNegativeFloat | None = None


@dataclass(frozen=True, slots=True, config=_STRICT)
class RemoveNode:
    """Remove the node of a vertex."""

    do: Literal["remove"]
    vertex: int


@dataclass(frozen=True, slots=True, config=_STRICT)
class SetNode:
    """Put another node in the place of a vertex's."""

    do: Literal["node"]
    vertex: int
    node: Node


@dataclass(frozen=True, slots=True, config=_STRICT)
class SetMission:
    """Another name and another fleet."""

    do: Literal["mission"]
    name: Annotated[str, Field(min_length=1)]
    fleet: Fleet


Edit = Annotated[MoveStop | AddNode | RemoveNode | SetNode | SetMission, Field(discriminator="do")]


def edited(instance: Instance, edit: Edit) -> Instance:
    """The mission after an edit.

    Parameters
    ----------
    instance
        The mission.
    edit
        The edit.

    Raises
    ------
    InputError
        If it names no stop, or the mission would break a rule.
    """
    match edit:
        case SetMission():
            return replace(instance, name=edit.name, fleet=edit.fleet)
        case MoveStop():
            _require_positions(instance)
            return _moved(instance, edit)
        case AddNode():
            _require_positions(instance)
            return replace(instance, nodes=(*instance.nodes, _new_node(instance, edit)))
        case RemoveNode():
            return _without(instance, _place_of(instance, edit.vertex))
        case SetNode():
            return _exchanged(instance, edit)


def kept_ids(instance: Instance, edit: Edit) -> dict[str, str]:
    """What the nodes that an edit leaves are called after it, by their ids before it."""
    ids = {node.id: node.id for node in instance.nodes}
    if isinstance(edit, RemoveNode):
        del ids[instance.nodes[_place_of(instance, edit.vertex)].id]
    elif isinstance(edit, SetNode):
        ids[instance.nodes[_place_of(instance, edit.vertex)].id] = edit.node.id
    return ids


def _place_of(instance: Instance, vertex: int) -> int:
    if not 1 <= vertex <= len(instance.nodes):
        raise InputError("is no node of the mission; choose one", field="vertex", value=vertex)
    return vertex - 1


def _require_positions(instance: Instance) -> None:
    if instance.travel_times is not None:
        raise InputError(
            "states the time of every leg, so that positions mean nothing; use a mission whose "
            "legs follow from positions",
            field="travel_times",
        )


def _moved(instance: Instance, edit: MoveStop) -> Instance:
    last = len(instance.nodes) + 1
    if edit.vertex not in (0, last):
        place = _place_of(instance, edit.vertex)
        return _with_node(instance, place, replace(instance.nodes[place], x=edit.x, y=edit.y))
    point = Point(edit.x, edit.y)
    if instance.start == instance.destination and not edit.alone:
        return replace(instance, start=point, destination=point)
    if edit.vertex == 0:
        return replace(instance, start=point)
    return replace(instance, destination=point)


def _exchanged(instance: Instance, edit: SetNode) -> Instance:
    place = _place_of(instance, edit.vertex)
    before = instance.nodes[place]
    if (before.x, before.y) != (edit.node.x, edit.node.y):
        _require_positions(instance)
    return _with_node(instance, place, edit.node)


def _with_node(instance: Instance, place: int, node: Node) -> Instance:
    nodes = instance.nodes
    return replace(instance, nodes=(*nodes[:place], node, *nodes[place + 1 :]))


def _new_node(instance: Instance, edit: AddNode) -> Node:
    taken = {node.id for node in instance.nodes}
    number = len(taken) + 1
    while f"n{number}" in taken:
        number += 1
    data = edit.data
    if data is None:
        data = median_low([node.data for node in instance.nodes] or [1.0])
    return Node(f"n{number}", edit.x, edit.y, data)


def _without(instance: Instance, place: int) -> Instance:
    nodes = instance.nodes[:place] + instance.nodes[place + 1 :]
    times = instance.travel_times
    if times is not None:
        rows = times[: place + 1] + times[place + 2 :]
        times = tuple(row[: place + 1] + row[place + 2 :] for row in rows)
    return replace(instance, nodes=nodes, travel_times=times)
