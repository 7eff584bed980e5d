"""What is installed with fiveroute may be used by everybody: no GPL, LGPL or AGPL at run time."""

import re
import tomllib
from collections.abc import Iterable, Iterator
from importlib.metadata import Distribution, PackageNotFoundError, distribution
from pathlib import Path

import pytest
from packaging.requirements import Requirement

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "licences.md"
EXTRAS = ("cluster", "parquet", "peers", "vroom")

_SAID = ("License-Expression", "License")
_BOUND = re.compile(
    r"lib(cholmod|fftw3|fribidi|glpk|gmp|gsl|mpc|mpfr|quadmath|readline|umfpack)(?=\W)"
)
_KNOWN = {
    *(("numpy", "libquadmath"), ("scipy", "libquadmath")),
    *(("pyvroom", "libglpk"), ("pyvroom", "libgmp")),
}
_COPYLEFT = re.compile(r"\b[AL]?GPL|General Public License|\bSSPL|\bEUPL", re.IGNORECASE)


def project() -> dict[str, list[str]]:
    """Requirements at run time, and of the extras, as pyproject.toml states them."""
    with (ROOT / "pyproject.toml").open("rb") as stream:
        stated = tomllib.load(stream)["project"]
    more = {extra: stated["optional-dependencies"][extra] for extra in EXTRAS}
    return {"": stated["dependencies"], **more}


def plain(name: str) -> str:
    """A name of a distribution as indices spell it."""
    return re.sub(r"[-_.]+", "-", name).lower()


def closure(lines: Iterable[str]) -> Iterator[Distribution]:
    """The distributions that requirements bring, those that they bring in turn, and so on."""
    ahead, seen = [Requirement(line) for line in lines], set[tuple[str, frozenset[str]]]()
    while ahead:
        wanted = ahead.pop()
        if (plain(wanted.name), frozenset(wanted.extras)) in seen:
            continue
        seen.add((plain(wanted.name), frozenset(wanted.extras)))
        try:
            found = distribution(wanted.name)
        except PackageNotFoundError:
            pytest.skip(f"{wanted.name} is not installed")
        yield found
        for line in found.requires or ():
            then = Requirement(line)
            extras = ["", *wanted.extras]
            if then.marker is None or any(then.marker.evaluate({"extra": e}) for e in extras):
                ahead.append(then)


def licence(found: Distribution) -> str:
    """What a distribution says of its licence."""
    tell = found.metadata.get_all
    said = [text.splitlines()[0] for key in _SAID for text in tell(key) or () if text.strip()]
    kinds = [kind for kind in tell("Classifier") or () if kind.startswith("License ::")]
    return "; ".join([*said, *(kind.rpartition(" :: ")[2] for kind in kinds)])


def listed() -> dict[str, str]:
    """Distributions and licences in the page."""
    rows = re.findall(r"^\| ([\w.-]+) \| ([^|]+) \|", PAGE.read_text(encoding="utf-8"), re.M)
    return {plain(name): text.strip() for name, text in rows if name != "distribution"}


@pytest.mark.parametrize("extra", ["", *EXTRAS])
def test_no_distribution_is_copyleft_and_all_are_listed(extra: str) -> None:
    known = listed()
    found = {plain(one.metadata["Name"]): one for one in closure(project()[extra])}
    assert sorted(found.keys() - known.keys()) == []
    assert {
        name: licence(one) for name, one in found.items() if _COPYLEFT.search(licence(one))
    } == {}
    assert {name: text for name, text in known.items() if _COPYLEFT.search(text)} == {}


def bound_libraries(found: Distribution) -> set[tuple[str, str]]:
    """Compiled libraries under the GPL or LGPL among the files of a distribution."""
    names = (_BOUND.match(file.name) for file in found.files or ())
    return {(plain(found.metadata["Name"]), name[0]) for name in names if name}


@pytest.mark.parametrize("extra", ["", *EXTRAS])
def test_libraries_inside_of_wheels_are_known(extra: str) -> None:
    """A wheel whose own code is free may bring what is not; the page names all that do."""
    inside = set[tuple[str, str]]().union(*map(bound_libraries, closure(project()[extra])))
    assert inside <= _KNOWN
    assert all(library in PAGE.read_text(encoding="utf-8") for _, library in inside)


def test_the_walk_knows_copyleft() -> None:
    for text in ("LGPL-3.0-only", "GNU General Public License v3", "GPLv3+", "AGPL"):
        assert _COPYLEFT.search(text)
    for text in ("MIT", "BSD-3-Clause", "Apache-2.0", "MPL-2.0"):
        assert not _COPYLEFT.search(text)
