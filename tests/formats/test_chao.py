from dataclasses import replace

import pytest

from fiveroute.errors import InputError
from fiveroute.formats import chao
from fiveroute.instance import Fleet, Instance, Node, Point

# Start, two nodes and destination; two vehicles.
TEXT = "n 4\nm 2\ntmax 7.5\n0.0\t0.0\t0\n1.5\t2.0\t10\n3.0\t4.0\t20\n5.0\t0.0\t0\n"
INSTANCE = Instance(
    name="p1",
    nodes=(Node("2", 1.5, 2.0, 10.0), Node("3", 3.0, 4.0, 20.0)),
    start=Point(0.0, 0.0),
    destination=Point(5.0, 0.0),
    fleet=Fleet(2, 1.0, 7.5),
)


@pytest.mark.parametrize(
    "text",
    [
        TEXT,
        TEXT.replace("\t", " ").replace("\n", "\r\n"),
        TEXT.replace("\t", ";").replace(" ", ";"),
        TEXT.replace("\t", " ; ").replace("\n", ";\n\n"),
        TEXT.removesuffix("\n"),
        "tmax 7.5\nm 2\n" + TEXT.replace("tmax 7.5\n", "").replace("m 2\n", ""),
    ],
)
def test_every_spelling_reads_the_same(text: str) -> None:
    assert chao.read(text, "p1") == INSTANCE


def test_times_are_euclidean_distances() -> None:
    assert chao.read(TEXT, "p1").travel[0].tolist() == [0.0, 2.5, 5.0, 5.0]


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ("n 4", "n 5", r"n: 5: must be the number of points, 4"),
        ("n 4", "n four", r"line 1, n: 'four': must be a whole number, at least 2"),
        ("n 4", "n 1", r"line 1, n: '1': must be a whole number, at least 2"),
        ("n 4", "n 4\nn 4", r"line 2, n: stands twice in the header"),
        ("n 4\n", "", r"n: is missing; begin the file with n, m and tmax"),
        ("n 4", "n 4 4", r"line 1: 'n 4 4': must be n and one number"),
        ("n 4", "n", r"line 1: 'n': must be n and one number"),
        ("m 2", "m 0", r"line 2, m: '0': must be a whole number, at least 1"),
        ("m 2", "m 99999999", r"m: 99999999: must be at most"),
        ("tmax", "tmx", r"line 3: 'tmx': is no key of the header; did you mean 'tmax'"),
        ("7.5", "0", r"line 3, tmax: 0.0: must be greater than 0"),
        ("7.5", "inf", r"line 3, tmax: 'inf': must be a finite number"),
        ("1.5", "nan", r"line 5, x: 'nan': must be a finite number"),
        ("2.0", "1e999", r"line 5, y: '1e999': must be a finite number"),
        ("10\n", "-10\n", r"line 5, score: -10.0: must not be negative"),
        ("\t10\n", "\n", r"line 5: '1.5 2.0': must be x, y and score"),
        ("\t20\n", "\t20\t1\n", r"line 6: '3.0 4.0 20 1': must be x, y and score"),
        ("5.0\t0.0\t0\n", "", r"n: 4: must be the number of points, 3.*copy the file again"),
        ("5.0\t0.0\t0\n", "5.0\t0.", r"line 7: '5.0 0.': must be x, y and score"),
        ("5.0\t0.0\t0\n", "5.0\t0.0\t7\n", r"last point: \(5.0, 0.0, 7.0\): .*must have score 0"),
        ("0.0\t0.0\t0\n", "0.0\t0.0\t3\n", r"first point: .*must have score 0"),
        ("1.5\t", "m 3\n1.5\t", r"line 5: 'm 3': must be x, y and score"),
    ],
)
def test_faults_are_named(old: str, new: str, sentence: str) -> None:
    assert old in TEXT
    with pytest.raises(InputError, match=f"^{sentence}"):
        chao.read(TEXT.replace(old, new, 1), "p1")


def test_orienteering_files_of_the_other_layout_are_not_misread() -> None:
    """They begin with tmax and P, and have the destination in their second line."""
    with pytest.raises(InputError, match="line 1: 'tmax 5 1'"):
        chao.read("tmax 5 1\n0 0 0\n9 9 0\n1 1 10\n", "set_66")


def test_written_file_reads_the_same() -> None:
    assert chao.write(INSTANCE).startswith("n 4\nm 2\ntmax 7.5\n0\t0\t0\n1.5\t2\t10\n")
    assert chao.read(chao.write(INSTANCE), "p1") == INSTANCE


def test_no_nodes_are_legal() -> None:
    empty = replace(INSTANCE, nodes=())
    assert chao.read(chao.write(empty), "p1") == empty


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        (replace(INSTANCE, metric="EUC_2D"), "Euclidean distances only"),
        (
            replace(INSTANCE, metric="explicit", travel_times=((0.0, 1.0, 2.0, 3.0),) * 4),
            "Euclidean distances only",
        ),
        (replace(INSTANCE, fleet=Fleet(None, 1.0, 7.5)), "need a number of vehicles"),
        (replace(INSTANCE, fleet=Fleet(2, 1.0, (7.5, 8.5))), "need one endurance"),
        (replace(INSTANCE, fleet=Fleet(2, 1.0, None)), "need one endurance"),
        (replace(INSTANCE, fleet=Fleet(2, 2.0, 7.5)), "no speed other than 1"),
    ],
)
def test_what_the_format_cannot_hold_is_refused(changed: Instance, words: str) -> None:
    with pytest.raises(InputError, match=words):
        chao.write(changed)
