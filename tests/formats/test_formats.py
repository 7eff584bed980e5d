"""The doors: which format a file has, and what the reader says about the file."""

from pathlib import Path

import pytest

from fiveroute.errors import InputError
from fiveroute.formats import FORMATS, native, read_instance, write_instance
from fiveroute.instance import Fleet, Instance, Node, Point

# One node, five metres from the place where start and destination are.
PLANE = "EDGE_WEIGHT_TYPE : EUC_2D\nNODE_COORD_SECTION\n1 0 0\n2 3 4\n"
TEXTS = {
    "native": native.write(
        Instance("x", (Node("2", 3, 4, 1.0),), Point(0, 0), Point(0, 0), Fleet(1, 1.0, 9.0))
    ),
    "chao": "n 3\nm 1\ntmax 9\n0 0 0\n3 4 1\n0 0 0\n",
    "tsplib": f"TYPE : TSP\nDIMENSION : 2\n{PLANE}",
    "oplib": (
        f"DIMENSION : 2\nCOST_LIMIT : 9\n{PLANE}"
        "NODE_SCORE_SECTION\n1 0\n2 1\nDEPOT_SECTION\n1\n-1\n"
    ),
}


@pytest.mark.parametrize("suffix", ["", ".json", ".txt", ".tsp", ".oplib", ".dat"])
@pytest.mark.parametrize("name", TEXTS)
def test_content_tells_the_format(name: str, suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"file{suffix}"
    path.write_text(TEXTS[name])
    instance = read_instance(path)
    assert [node.id for node in instance.nodes] == ["2"]
    assert instance.problem().travel[0, 1] == 5.0
    assert instance == read_instance(path, name)


@pytest.mark.parametrize(
    ("suffix", "words"),
    [
        (".json", "is no JSON"),
        (".txt", "'%': is no key of the header|'%': must be x, y and score"),
        (".tsp", "'%': must be 'KEY : value'"),
        (".oplib", "'%': must be 'KEY : value'"),
        (".dat", "is of no format that fiveroute knows; end its name in .json"),
    ],
)
def test_suffix_tells_the_format_of_an_unreadable_file(
    suffix: str, words: str, tmp_path: Path
) -> None:
    path = tmp_path / f"file{suffix}"
    path.write_text("%\n")
    with pytest.raises(InputError, match=f"file{suffix}.*({words})"):
        read_instance(path)


def test_every_format_is_read_from_what_it_writes(tmp_path: Path) -> None:
    for name, text in TEXTS.items():
        instance = FORMATS[name].read(text, "copy")
        path = tmp_path / f"copy{FORMATS[name].suffixes[0]}"
        write_instance(instance, path)
        assert read_instance(path) == instance
        write_instance(instance, tmp_path / f"{name}.native", "native")
        assert read_instance(tmp_path / f"{name}.native") == instance


def test_formats_have_names_of_their_own() -> None:
    suffixes = [suffix for known in FORMATS.values() for suffix in known.suffixes]
    assert len(suffixes) == len(set(suffixes))


def test_unknown_formats_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "file.json"
    path.write_text(TEXTS["native"])
    with pytest.raises(InputError, match="'tsplip': is no format; did you mean 'tsplib'"):
        read_instance(path, "tsplip")


def test_what_a_format_cannot_hold_leaves_no_file(tmp_path: Path) -> None:
    instance = FORMATS["native"].read(TEXTS["native"], "")
    with pytest.raises(InputError, match="know no endurance"):
        write_instance(instance, tmp_path / "file.tsp")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", [".", "missing.json", "missing/file.json"])
def test_unreadable_paths_are_named(name: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=str(tmp_path)):
        read_instance(tmp_path / name)


def test_endless_nesting_fails_fast(tmp_path: Path) -> None:
    """200 MB of brackets: refused by its size; a file just below the limit by its depth."""
    path = tmp_path / "file.json"
    path.write_bytes(b"[" * 200_000_000)
    with pytest.raises(InputError, match="is larger than 32 MB"):
        read_instance(path)
    path.write_bytes(b"[" * 30_000_000)
    with pytest.raises(InputError, match="nested too deeply"):
        read_instance(path)


def test_large_honest_files_are_read(tmp_path: Path) -> None:
    nodes = tuple(Node(str(i), i * 0.123, -i * 0.456, 0.654321) for i in range(2, 100_002))
    large = Instance("large", nodes, Point(0, 0), Point(0, 0), Fleet(9, 1.0, 9.0))
    path = tmp_path / "large.json"
    write_instance(large, path)
    assert read_instance(path).nodes[-1] == nodes[-1]
