from dataclasses import replace

import pytest

from fiveroute.errors import InputError
from fiveroute.formats import oplib
from fiveroute.instance import Fleet, Instance, Node, Point

# A depot and two nodes on a 3-4-5 triangle; there and back to one of them fits the limit.
TEXT = """NAME : triangle
TYPE : OP
DIMENSION : 3
COST_LIMIT : 8
TSP_SOLUTION : 12
EDGE_WEIGHT_TYPE : EUC_2D
NODE_COORD_SECTION
1 0 0
2 3 0
3 0 4
NODE_SCORE_SECTION
1 0
2 10
3 20
DEPOT_SECTION
1
-1
EOF
"""


def test_file_becomes_a_closed_tour_of_one_auv() -> None:
    assert oplib.read(TEXT, "file") == Instance(
        name="triangle",
        nodes=(Node("2", 3.0, 0.0, 10.0), Node("3", 0.0, 4.0, 20.0)),
        start=Point(0.0, 0.0),
        destination=Point(0.0, 0.0),
        fleet=Fleet(1, 1.0, 8.0),
        metric="EUC_2D",
    )


@pytest.mark.parametrize("metric", ["EUC_2D", "GEO", "ATT"])
def test_score_of_the_depot_is_collected_by_every_tour(metric: str) -> None:
    instance = oplib.read(TEXT.replace("1 0\n2 10", "1 74\n2 10").replace("EUC_2D", metric), "")
    assert instance.nodes[0] == Node("1", 0.0, 0.0, 74.0)
    problem = instance.problem()
    assert problem.total_profit == 104.0
    assert problem.duration([1]) == 0.0
    assert problem.duration([1, 3]) == problem.duration([3, 1]) == problem.duration([3])


def test_score_of_the_depot_with_explicit_distances() -> None:
    text = (
        TEXT.replace("1 0\n2 10", "1 74\n2 10")
        .replace("EUC_2D", "EXPLICIT")
        .replace(
            "NODE_COORD_SECTION\n1 0 0\n2 3 0\n3 0 4\n",
            "EDGE_WEIGHT_FORMAT : UPPER_ROW\nEDGE_WEIGHT_SECTION\n3 4 5\n",
        )
    )
    problem = oplib.read(text, "file").problem()
    assert problem.duration([1, 2, 3]) == problem.duration([2, 3]) == 12.0


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ("COST_LIMIT : 8\n", "", "COST_LIMIT: is missing"),
        ("COST_LIMIT : 8", "COST_LIMIT : 0", "line 4, COST_LIMIT: 0.0: must be greater than 0"),
        ("COST_LIMIT : 8", "COST_LIMIT : x", "line 4, COST_LIMIT: 'x': must be a finite number"),
        ("TYPE : OP", "TYPE : TSP", "line 2, TYPE: 'TSP': is not supported; known are OP"),
        ("3 20", "3 -20", "score of node 3: -20.0: must not be negative"),
        ("3 20\n", "", "lines of NODE_SCORE_SECTION: 2: must be as many as DIMENSION, 3"),
        ("3 20\nDEPOT_SECTION\n1\n-1\nEOF\n", "3 20\n", "DEPOT_SECTION: is missing; the file may"),
        ("\n1\n-1", "\n2\n-1", r"DEPOT_SECTION: \['2', '-1'\]: must be node 1 alone"),
        ("\n1\n-1", "\n1\n3\n-1", r"DEPOT_SECTION: \['1', '3', '-1'\]: must be node 1 alone"),
    ],
)
def test_faults_are_named(old: str, new: str, sentence: str) -> None:
    assert old in TEXT
    with pytest.raises(InputError, match=f"^{sentence}"):
        oplib.read(TEXT.replace(old, new, 1), "file")


def test_written_file_reads_the_same() -> None:
    instance = oplib.read(TEXT, "file")
    assert oplib.read(oplib.write(instance), "file") == instance


def test_what_the_format_cannot_hold_is_refused() -> None:
    instance = oplib.read(TEXT, "file")
    with pytest.raises(InputError, match="need one endurance"):
        oplib.write(replace(instance, fleet=Fleet(1, 1.0, None)))
    with pytest.raises(InputError, match="one vehicle only"):
        oplib.write(replace(instance, fleet=Fleet(2, 1.0, 8.0)))
