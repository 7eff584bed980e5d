"""OPLib files of the orienteering problem: TSPLIB with scores and a limit on the length.

``COST_LIMIT`` is the endurance of the one AUV, ``NODE_SCORE_SECTION`` holds the data. The
tour is closed at node 1, the only depot; the other nodes keep their numbers as ids. In
many files the depot has a score as well, and published values contain it: it becomes a
sensor node "1" in the depot's place, which every tour collects without any detour.

References
----------
G. Kobeaga, M. Merino, J. A. Lozano, "An efficient evolutionary algorithm for the
orienteering problem", Computers & Operations Research 90 (2018), doi
10.1016/j.cor.2017.09.003.
"""

from __future__ import annotations

from fiveroute.errors import InputError
from fiveroute.formats.expressible import (
    require_closed,
    require_plain,
    single_endurance,
    spelled,
)
from fiveroute.formats.files import positive
from fiveroute.formats.keyword_file import KeywordFile, parse
from fiveroute.formats.tsplib import KEYS, SECTIONS, network, network_lines
from fiveroute.instance import Instance

__all__ = ["read", "write"]

_FORMAT = "OPLib"
_KEYS = (*KEYS, "COST_LIMIT", "TSP_SOLUTION")
_SECTIONS = (*SECTIONS, "NODE_SCORE_SECTION", "DEPOT_SECTION")


def read(text: str, name: str) -> Instance:
    """Read an instance.

    Parameters
    ----------
    text
        Content of the file.
    name
        Name of the instance if the file states none.
    """
    file = parse(text, _KEYS, _SECTIONS)
    file.choice("TYPE", ("OP",), default="OP")
    limit = file.entry("COST_LIMIT")
    endurance = positive(limit.value, "COST_LIMIT", limit.line)
    nodes = network(file)
    scores = file.table("NODE_SCORE_SECTION", ("score",))[:, 0]
    if (scores < 0.0).any():
        worst = int(scores.argmin())
        raise InputError(
            "must not be negative; correct the score",
            field=f"score of node {worst + 1}",
            value=float(scores[worst]),
        )
    _require_depot(file)
    return nodes.instance(file.name(name), scores, endurance)


def _require_depot(file: KeywordFile) -> None:
    words = [word for entry in file.section("DEPOT_SECTION") for word in entry.value.split()]
    if [word for word in words if word != "-1"] != ["1"]:
        raise InputError(
            "must be node 1 alone; renumber the nodes", field="DEPOT_SECTION", value=words
        )


def write(instance: Instance) -> str:
    """Write an instance; its ids, unless they are line numbers, are lost.

    The depot gets score 0; a sensor node in its place remains a node.

    Raises
    ------
    InputError
        If the instance has anything else that the format cannot hold.
    """
    require_plain(instance, _FORMAT)
    require_closed(instance, _FORMAT)
    limit = spelled(single_endurance(instance, _FORMAT))
    scores = [0.0, *(node.data for node in instance.nodes)]
    lines = [
        *network_lines(instance, "OP", f"COST_LIMIT : {limit}"),
        "NODE_SCORE_SECTION",
        *(f"{i} {spelled(score)}" for i, score in enumerate(scores, start=1)),
        "DEPOT_SECTION",
        "1",
        "-1",
        "EOF",
        "",
    ]
    return "\n".join(lines)
