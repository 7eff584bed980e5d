from dataclasses import replace

import numpy as np
import pytest

from fiveroute.errors import InputError
from fiveroute.formats import tsplib
from fiveroute.instance import Fleet, Instance, Node, Point

# A depot and two nodes on a 3-4-5 triangle.
PLANE = """NAME : triangle
TYPE : TSP
DIMENSION : 3
EDGE_WEIGHT_TYPE : EUC_2D
NODE_COORD_SECTION
1 0 0
2 3 0
3 0 4
EOF
"""

# The same distances, whichever way they are spelled.
SPELLINGS = {
    "FULL_MATRIX": "0 3 4 3 0 5 4 5 0",
    "UPPER_ROW": "3 4 5",
    "LOWER_ROW": "3 4 5",
    "UPPER_DIAG_ROW": "0 3 4 0 5 0",
    "LOWER_DIAG_ROW": "0 3 0 4 5 0",
    "UPPER_COL": "3 4 5",
    "LOWER_COL": "3 4 5",
    "UPPER_DIAG_COL": "0 3 0 4 5 0",
    "LOWER_DIAG_COL": "0 3 4 0 5 0",
}


def explicit(form: str, numbers: str, kind: str = "TSP", more: str = "") -> str:
    return (
        f"NAME: triangle\nTYPE: {kind}\nDIMENSION: 3\nEDGE_WEIGHT_TYPE: EXPLICIT\n"
        f"EDGE_WEIGHT_FORMAT: {form}\nEDGE_WEIGHT_SECTION\n{numbers}\n{more}EOF\n"
    )


TRIANGLE = [[0, 3, 4, 0], [3, 0, 5, 3], [4, 5, 0, 4], [0, 3, 4, 0]]


def test_file_becomes_a_closed_tour_of_one_auv() -> None:
    instance = tsplib.read(PLANE, "file")
    assert instance == Instance(
        name="triangle",
        nodes=(Node("2", 3.0, 0.0, 1.0), Node("3", 0.0, 4.0, 1.0)),
        start=Point(0.0, 0.0),
        destination=Point(0.0, 0.0),
        fleet=Fleet(1, 1.0, None),
        metric="EUC_2D",
    )
    np.testing.assert_array_equal(instance.travel, TRIANGLE)
    assert instance.problem().fleet_size == 1


@pytest.mark.parametrize("form", SPELLINGS)
def test_matrix_formats(form: str) -> None:
    instance = tsplib.read(explicit(form, SPELLINGS[form]), "file")
    np.testing.assert_array_equal(instance.travel, TRIANGLE)


def test_numbers_may_break_lines_anywhere() -> None:
    broken = SPELLINGS["LOWER_DIAG_ROW"].replace(" ", "\n")
    assert tsplib.read(explicit("LOWER_DIAG_ROW", broken), "").travel.tolist() == TRIANGLE


def test_diagonal_does_not_count() -> None:
    instance = tsplib.read(explicit("FULL_MATRIX", "9999 3 4 3 9999 5 4 5 9999"), "file")
    np.testing.assert_array_equal(instance.travel, TRIANGLE)


def test_asymmetric_matrix() -> None:
    instance = tsplib.read(explicit("FULL_MATRIX", "0 1 2 3 0 4 5 6 0", kind="ATSP"), "file")
    expected = [[0, 1, 2, 0], [3, 0, 4, 3], [5, 6, 0, 5], [0, 1, 2, 0]]
    np.testing.assert_array_equal(instance.travel, expected)


def test_positions_come_from_the_display_section() -> None:
    shown = "DISPLAY_DATA_SECTION\n1 7 8\n2 1 1\n3 2 2\n"
    instance = tsplib.read(explicit("UPPER_ROW", "3 4 5", more=shown), "file")
    assert instance.start == Point(7.0, 8.0)
    assert tsplib.read(explicit("UPPER_ROW", "3 4 5"), "file").start == Point(0.0, 0.0)


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ("DIMENSION : 3\n", "", "DIMENSION: is missing"),
        ("EDGE_WEIGHT_TYPE : EUC_2D\n", "", "EDGE_WEIGHT_TYPE: is missing"),
        ("EUC_2D", "XRAY1", "line 4, EDGE_WEIGHT_TYPE: 'XRAY1': is not supported; known are EUC"),
        ("TSP\n", "CVRP\n", "line 2, TYPE: 'CVRP': is not supported; known are TSP, ATSP"),
        ("NODE_COORD_SECTION\n", "FIXED_EDGES_SECTION\n", "line 5: 'FIXED_EDGES_SECTION': is unkn"),
        ("3 0 4\nEOF\n", "3 0", "line 8, NODE_COORD_SECTION: '3 0': must be i x y"),
        ("3 0 4\nEOF\n", "", "lines of NODE_COORD_SECTION: 2: must be as many as DIMENSION, 3"),
        ("NODE_COORD", "NODE_COORD_TYPE : THREED_COORDS\nNODE_COORD", "line 5, NODE_COORD_TYPE"),
    ],
)
def test_faults_are_named(old: str, new: str, sentence: str) -> None:
    assert old in PLANE
    with pytest.raises(InputError, match=f"^{sentence}"):
        tsplib.read(PLANE.replace(old, new, 1), "file")


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (explicit("UPPER_ROW", "3 4"), "numbers in EDGE_WEIGHT_SECTION: 2: must be 3 for DIM"),
        (explicit("FULL_MATRIX", "0 1"), "numbers in EDGE_WEIGHT_SECTION: 2: must be 9 for DIM"),
        (explicit("FUNCTION", "0 1"), "line 5, EDGE_WEIGHT_FORMAT: 'FUNCTION': is not supported"),
        (
            explicit("FULL_MATRIX", "0 1 2 3 0 4 5 6 0"),
            "EDGE_WEIGHT_SECTION: the way from 1 to 2 takes 1, back 3; .*TYPE : ATSP",
        ),
        (
            explicit("UPPER_ROW", "3 4 5").replace("N: 3", "N: 1000000000"),
            "numbers in EDGE_WEIGHT_SECTION: 3: must be 499999999500000000",
        ),
    ],
)
def test_faults_of_a_matrix_are_named(text: str, sentence: str) -> None:
    with pytest.raises(InputError, match=f"^{sentence}"):
        tsplib.read(text, "file")


@pytest.mark.parametrize(
    "text",
    [
        PLANE,
        PLANE.replace("EUC_2D", "GEO"),
        PLANE.replace("3 0 4\n", "").replace("2 3 0\n", "").replace("N : 3", "N : 1"),
        explicit("UPPER_ROW", "3 4 5.25"),
        explicit("FULL_MATRIX", "0 1 2 3 0 4 5 6 0", kind="ATSP"),
        explicit("UPPER_ROW", "3 4 5", more="DISPLAY_DATA_SECTION\n1 7 8\n2 1 1\n3 2 2\n"),
    ],
)
def test_written_file_reads_the_same(text: str) -> None:
    instance = tsplib.read(text, "file")
    assert tsplib.read(tsplib.write(instance), "file") == instance


PLAIN = tsplib.read(PLANE, "file")


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        (replace(PLAIN, metric="euclidean"), "TSPLIB's distances are whole numbers"),
        (replace(PLAIN, fleet=Fleet(1, 1.0, 5.0)), "know no endurance"),
        (replace(PLAIN, fleet=Fleet(2, 1.0, None)), "one vehicle only"),
        (replace(PLAIN, destination=Point(1.0, 0.0)), "closed tours only"),
        (
            replace(PLAIN, nodes=(Node("2", 0.0, 0.0, 0.5),)),
            r"nodes\[0\].data: 0.5: .*know no data",
        ),
        (replace(PLAIN, name="two\nlines"), "name: .*must be one line"),
        (
            replace(PLAIN, metric="explicit", travel_times=((0.0, 1.0, 2.0, 3.0),) * 4),
            "of start and destination differ",
        ),
    ],
)
def test_what_the_format_cannot_hold_is_refused(changed: Instance, words: str) -> None:
    with pytest.raises(InputError, match=words):
        tsplib.write(changed)
