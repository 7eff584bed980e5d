"""Public benchmark files, where the environment variable FIVEROUTE_DATA names their folder."""

import os
import re
from pathlib import Path

import pytest

from fiveroute.formats import chao, oplib, read_instance, tsplib
from fiveroute.instance import Instance

DATA = Path(os.environ.get("FIVEROUTE_DATA", "")) / "benchmarks"
NEEDED = pytest.mark.skipif(
    not os.environ.get("FIVEROUTE_DATA") or not DATA.is_dir(),
    reason="set FIVEROUTE_DATA to the folder above benchmarks/ to read public files",
)

# Closed tours that the TSPLIB collection publishes with the instances, and their lengths.
PUBLISHED_TOURS = {
    "att48": (
        "1 8 38 31 44 18 7 28 6 37 19 27 17 43 30 36 46 33 20 47 21 32 39 48 5 42 24 10 45 35 4 "
        "26 2 29 34 41 16 22 3 23 14 25 13 11 12 15 40 9",
        10628,
    ),
    "ulysses22": ("1 14 13 12 7 6 15 5 11 9 10 19 20 21 16 3 2 17 22 4 18 8", 7013),
}


def stated_size(path: Path) -> int:
    found = re.search(r"(?:^n[\s;]+|DIMENSION\s*:\s*)(\d+)", path.read_text(), re.MULTILINE)
    assert found is not None
    return int(found[1])


def files(folder: str, pattern: str) -> list[Path]:
    found = sorted((DATA / folder).glob(pattern))
    assert found, f"{DATA / folder} holds no {pattern}"
    return found


@NEEDED
@pytest.mark.parametrize("folder", ["top-chao", "top-large", "top-huge"])
def test_team_orienteering_files(folder: str) -> None:
    for path in files(folder, "*.txt"):
        instance = read_instance(path)
        assert len(instance.nodes) == stated_size(path) - 2
        assert instance.name == path.stem
        assert chao.read(chao.write(instance), path.stem) == instance


@NEEDED
def test_orienteering_files() -> None:
    for path in files("oplib", "*.oplib"):
        instance = read_instance(path)
        has_scored_depot = instance.nodes[0].id == "1"
        assert len(instance.nodes) == stated_size(path) - 1 + has_scored_depot
        if not has_scored_depot:
            assert oplib.read(oplib.write(instance), "") == instance


@NEEDED
def test_travelling_salesman_files() -> None:
    for path in files("tsplib", "*.tsp"):
        instance = read_instance(path)
        assert len(instance.nodes) == stated_size(path) - 1
        if len(instance.nodes) < 2000:
            assert tsplib.read(tsplib.write(instance), "") == instance


def length(instance: Instance, tour: list[int]) -> float:
    travel = instance.travel
    return float(sum(travel[i - 1, j - 1] for i, j in zip(tour, tour[1:] + tour[:1], strict=True)))


@NEEDED
@pytest.mark.parametrize("name", PUBLISHED_TOURS)
def test_published_tours_have_their_published_lengths(name: str) -> None:
    tour, published = PUBLISHED_TOURS[name]
    instance = read_instance(DATA / "tsplib" / f"{name}.tsp")
    assert length(instance, [int(node) for node in tour.split()]) == published


@NEEDED
def test_canonical_tour_of_pcb442() -> None:
    """1, 2, ..., n has length 221440 (TSPLIB 95, section 2)."""
    instance = read_instance(DATA / "tsplib" / "pcb442.tsp")
    assert length(instance, list(range(1, 443))) == 221440
