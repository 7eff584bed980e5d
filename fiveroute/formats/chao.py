"""Text files of team orienteering instances, as Chao, Golden and Wasil published them.

::

    n 32            points, with start and destination
    m 2             vehicles
    tmax 42.5       time limit of each
    10.5 14.4 0     x, y and score: the start first, the destination last

Words are separated by blanks, tabs or semicolons. Distances are Euclidean and the speed is
1, so that distances are times. Nodes have no names: their ids are the numbers "2" to
"n - 1" of their lines among the points. There are no service times.

References
----------
I-M. Chao, B. L. Golden, E. A. Wasil, "The team orienteering problem", European Journal of
Operational Research 88 (1996), doi 10.1016/0377-2217(94)00289-4.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial

from fiveroute.errors import InputError, nearest
from fiveroute.formats.expressible import require_plain, single_endurance, spelled
from fiveroute.formats.files import integer, non_negative, number, numbered_lines, positive
from fiveroute.instance import MAX_FLEET, Fleet, Instance, Node, Point

__all__ = ["read", "write"]

_FORMAT = "Chao"
_HEADER: dict[str, Callable[[str, str, int], float]] = {
    "n": partial(integer, least=2),
    "m": integer,
    "tmax": positive,
}

Stop = tuple[float, float, float]


def read(text: str, name: str) -> Instance:
    """Read an instance.

    Parameters
    ----------
    text
        Content of the file.
    name
        Name of the instance, which the format does not hold.
    """
    header: dict[str, float] = {}
    stops: list[Stop] = []
    for line, content in numbered_lines(text):
        words = [word for word in re.split(r"[\s;]+", content) if word]
        if not words:
            continue
        if words[0][0].isalpha() and not stops:
            _read_header(header, words, line)
        else:
            stops.append(_read_stop(words, line))
    _check_header(header, len(stops))
    start, *nodes, destination = stops
    for field, stop in (("first point", start), ("last point", destination)):
        if stop[2] != 0.0:
            raise InputError(
                "is start or destination and must have score 0; put these two first and last",
                field=field,
                value=stop,
            )
    return Instance(
        name=name,
        nodes=tuple(Node(str(i), *stop) for i, stop in enumerate(nodes, start=2)),
        start=Point(*start[:2]),
        destination=Point(*destination[:2]),
        fleet=Fleet(int(header["m"]), 1.0, header["tmax"]),
    )


def _read_header(header: dict[str, float], words: list[str], line: int) -> None:
    key = words[0]
    if key not in _HEADER:
        raise InputError(f"is no key of the header; {nearest(key, _HEADER)}", value=key, line=line)
    if key in header:
        raise InputError("stands twice in the header; remove one", field=key, line=line)
    if len(words) != 2:
        raise InputError(
            f"must be {key} and one number; correct the line", value=" ".join(words), line=line
        )
    header[key] = _HEADER[key](words[1], key, line)


def _read_stop(words: list[str], line: int) -> Stop:
    if len(words) != 3:
        raise InputError(
            "must be x, y and score of a point; correct the line, or copy the file again",
            value=" ".join(words),
            line=line,
        )
    x, y, score = words
    return number(x, "x", line), number(y, "y", line), non_negative(score, "score", line)


def _check_header(header: dict[str, float], points: int) -> None:
    for key in _HEADER:
        if key not in header:
            raise InputError("is missing; begin the file with n, m and tmax", field=key)
    if header["n"] != points:
        raise InputError(
            f"must be the number of points, {points}; correct it, or copy the file again",
            field="n",
            value=header["n"],
        )
    if header["m"] > MAX_FLEET:
        raise InputError(f"must be at most {MAX_FLEET}", field="m", value=header["m"])


def write(instance: Instance) -> str:
    """Write an instance; its name, and its ids unless they are line numbers, are lost.

    Raises
    ------
    InputError
        If the instance has anything else that the format cannot hold.
    """
    require_plain(instance, _FORMAT)
    if instance.metric != "euclidean":
        raise InputError(
            f"{_FORMAT} files know Euclidean distances only; write the native format",
            field="metric",
            value=instance.metric,
        )
    if instance.fleet_size is None:
        raise InputError(f"{_FORMAT} files need a number of vehicles; set it", field="fleet.size")
    stops = [
        (instance.start.x, instance.start.y, 0.0),
        *((node.x, node.y, node.data) for node in instance.nodes),
        (instance.destination.x, instance.destination.y, 0.0),
    ]
    lines = [
        f"n {len(stops)}",
        f"m {instance.fleet_size}",
        f"tmax {spelled(single_endurance(instance, _FORMAT))}",
        *("\t".join(map(spelled, stop)) for stop in stops),
    ]
    return "\n".join(lines) + "\n"
