import numpy as np
import pytest

from fiveroute.errors import InputError
from fiveroute.formats.keyword_file import KeywordFile, parse

KEYS = ("NAME", "DIMENSION", "COMMENT")
SECTIONS = ("NODE_COORD_SECTION", "EDGE_WEIGHT_SECTION")

# Three nodes in any order, and numbers over several lines.
TEXT = """NAME : three: nodes
COMMENT: of one test
COMMENT : and more
DIMENSION:3

NODE_COORD_SECTION :
 2   1.5e1  -2
 1 0 0
3 7 8
EDGE_WEIGHT_SECTION
1 2
3
EOF
whatever follows
"""


def parsed(text: str = TEXT) -> KeywordFile:
    return parse(text, KEYS, SECTIONS)


@pytest.mark.parametrize(
    "text",
    [TEXT, TEXT.replace("EOF\nwhatever follows\n", ""), TEXT.replace("\n", "\r\n")],
)
def test_every_spelling_reads_the_same(text: str) -> None:
    file = parsed(text)
    assert file.name("default") == "three: nodes"
    assert file.dimension == 3
    expected = [[0.0, 0.0], [15.0, -2.0], [7.0, 8.0]]
    np.testing.assert_array_equal(file.table("NODE_COORD_SECTION", ("x", "y")), expected)
    assert file.weights("EDGE_WEIGHT_SECTION").tolist() == [1.0, 2.0, 3.0]


def test_sections_end_where_a_key_follows() -> None:
    file = parsed("NODE_COORD_SECTION\n1 0 0\nDIMENSION : 1\n")
    assert file.table("NODE_COORD_SECTION", ("x", "y")).shape == (1, 2)


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ("NAME :", "NMAE :", r"line 1: 'NMAE': is unknown; did you mean 'NAME'"),
        ("NAME :", "NAME", r"line 1: 'NAME three': is unknown; known are COMMENT, DIMENSION"),
        ("NAME : three: nodes", "NAME three", r"line 1: 'NAME three': must be 'KEY : value'"),
        ("EDGE_WEIGHT_SECTION", "EDGE_SECTION", r"line 10: 'EDGE_SECTION': is unknown"),
        ("EDGE_WEIGHT_SECTION", "NODE_COORD_SECTION", r"line 10: 'NODE_COORD_SECTION': stands tw"),
        ("\n\nNODE", "\nDIMENSION : 3\nNODE", r"line 5: 'DIMENSION': stands twice"),
        ("NODE_COORD_SECTION :", "", r"line 7: '2   1.5e1  -2': must be 'KEY : value'"),
    ],
)
def test_faults_of_the_grammar_are_named(old: str, new: str, sentence: str) -> None:
    assert old in TEXT
    with pytest.raises(InputError, match=f"^{sentence}"):
        parsed(TEXT.replace(old, new, 1))


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ("DIMENSION:3\n", "", r"DIMENSION: is missing; add a line 'DIMENSION : value'"),
        ("DIMENSION:3", "DIMENSION: x", r"line 4, DIMENSION: 'x': must be a whole number"),
        ("DIMENSION:3", "DIMENSION: 0", r"line 4, DIMENSION: '0': must be .*at least 1"),
        ("3 7 8\n", "", r"lines of NODE_COORD_SECTION: 2: must be as many as DIMENSION, 3"),
        ("3 7 8", "2 7 8", r"line 9, NODE_COORD_SECTION: '2 7 8': .*every i from 1 to 3 once"),
        ("3 7 8", "4 7 8", r"line 9, NODE_COORD_SECTION: '4 7 8': .*every i from 1 to 3 once"),
        ("3 7 8", "3 7", r"line 9, NODE_COORD_SECTION: '3 7': must be i x y"),
        ("3 7 8", "3 7 8 9", r"line 9, NODE_COORD_SECTION: '3 7 8 9': must be i x y"),
        ("3 7 8", "3 7 inf", r"line 9, y: 'inf': must be a finite number"),
        ("3 7 8", "x 7 8", r"line 9, NODE_COORD_SECTION: 'x': must be a whole number"),
    ],
)
def test_faults_of_a_table_are_named(old: str, new: str, sentence: str) -> None:
    assert old in TEXT
    with pytest.raises(InputError, match=f"^{sentence}"):
        parsed(TEXT.replace(old, new, 1)).table("NODE_COORD_SECTION", ("x", "y"))


@pytest.mark.parametrize(
    ("numbers", "sentence"),
    [
        ("1 -2", r"line 11, EDGE_WEIGHT_SECTION: -2.0: must not be negative"),
        ("1 nan", r"line 11, EDGE_WEIGHT_SECTION: 'nan': must be a finite number"),
        ("1 1_0", r"line 11, EDGE_WEIGHT_SECTION: '1_0': must be a finite number"),
        ("1 x", r"line 11, EDGE_WEIGHT_SECTION: 'x': must be a finite number"),
    ],
)
def test_faults_of_weights_are_named(numbers: str, sentence: str) -> None:
    with pytest.raises(InputError, match=f"^{sentence}"):
        parsed(TEXT.replace("\n1 2\n", f"\n{numbers}\n")).weights("EDGE_WEIGHT_SECTION")


def test_missing_and_empty_sections() -> None:
    with pytest.raises(InputError, match="EDGE_WEIGHT_SECTION: is missing"):
        parsed("DIMENSION : 1").weights("EDGE_WEIGHT_SECTION")
    assert parsed("EDGE_WEIGHT_SECTION").weights("EDGE_WEIGHT_SECTION").size == 0
