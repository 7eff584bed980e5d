"""Damaged files of every kind are read, or refused in one line; `benchmarks/fuzz.py` goes on."""

import importlib.util
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fiveroute.errors import InputError

_SOURCE = Path(__file__).parents[2] / "benchmarks" / "fuzz.py"
if not _SOURCE.is_file():
    pytest.skip("the long run is not shipped here", allow_module_level=True)
_SPEC = importlib.util.spec_from_file_location("fiveroute_fuzz", _SOURCE)
assert _SPEC is not None
assert _SPEC.loader is not None
fuzz: Any = importlib.util.module_from_spec(_SPEC)
sys.modules[_SPEC.name] = fuzz
sys.path.insert(0, str(_SOURCE.parent))  # as it is when it runs by itself
_SPEC.loader.exec_module(fuzz)
sys.path.remove(str(_SOURCE.parent))

INPUTS = {"netcdf": 60, "tracks": 60, "sea": 100, "certificate": 60, "kept": 100}

FOUND = [
    # what the long run found, and no reader may do again
    ("native", b'{"format": "fiveroute-instance/1", "name": "a", "nodes": [{"id": "a"' + b"}]}"),
    ("native", b'{"format": "fiveroute-instance/1", "' + b"x" * 3000 + b'": 1}'),
    ("native", b'{"format": "fiveroute-instance/1", "nodes": [], "nodes": [{}, {}, {"id": 1}]}'),
    ("native", b'{"format": "fiveroute-instance/1", "nodes": [{}, {}, {"id": 1}], "nodes": []}'),
    ("events", b'{"' + b"k" * 3000 + b'": 1}'),
    (
        "geojson",
        b'{"type": "Feature", "properties": {"id": "\\ud800"}, '
        b'"geometry": {"type": "Point", "coordinates": [10, 63]}}',
    ),
    ("certificate", b"[" * 100_000),
    ("certificate", b'{"a": ' + b"9" * 5000 + b"}"),
    ("certificate", b'{"format": "\\ud800"}'),
    ("kept", b"[" * 100_000),
    ("kept", b'{"peers": {"vroom": 1}}'),
    ("kept", b'{"instance": "\\ud800"}'),
    ("reference", b"instance,best_known\na," + b"1" * 200_000),
    ("reference", b'instance,best_known\na,"1\rb'),
    ("reference", b"instance,best_known\n\0"),
    ("reference", b"\xef\xbb\xbfinstance,best_known\na,nan"),
    ("netcdf", b"CDF\x01" + b"\xff" * 200),
    ("netcdf", b"\x89HDF\r\n\x1a\n" + b"\0" * 500),
]


def must_be_read_or_refused(name: str, content: bytes, folder: Path) -> None:
    kind = fuzz.reader(name)
    path = folder / f"file{kind.suffix}"
    path.write_bytes(content)
    assert fuzz.fault_of(kind, path) is None, content


@pytest.mark.parametrize("name", fuzz.READERS)
def test_whole_files_are_read(name: str, tmp_path: Path) -> None:
    kind = fuzz.reader(name)
    for content in kind.files:
        path = tmp_path / f"file{kind.suffix}"
        path.write_bytes(content)
        kind.read(path)


@pytest.mark.parametrize("name", fuzz.READERS)
def test_damaged_files_are_read_or_refused(name: str, tmp_path: Path) -> None:
    kind = fuzz.reader(name)

    @given(st.randoms(use_true_random=False))
    @settings(
        deadline=None,
        max_examples=INPUTS.get(name, 200),
        suppress_health_check=list(HealthCheck),
        database=None,
    )
    def read(rng: Any) -> None:
        must_be_read_or_refused(name, kind.spoilt(rng), tmp_path)

    read()


@pytest.mark.parametrize(("name", "content"), FOUND)
def test_what_was_found_once(name: str, content: bytes, tmp_path: Path) -> None:
    must_be_read_or_refused(name, content, tmp_path)


def put(sea: Any, name: str, dims: tuple[str, ...], values: Any, **attributes: Any) -> Any:
    """The same sea with a variable written over; its attributes stay where none are given."""
    sea.sizes |= dict(zip(dims, fuzz.np.shape(values), strict=True))
    sea.add(name, dims, values, **(attributes or sea.variables[name][2]))
    return sea


AXES, PLANE, ROMS, _, PROJECTED = fuzz.spoilt_seas.LAYOUTS


@pytest.mark.parametrize(
    ("sea", "said"),
    [
        (put(AXES(), "time", ("depth", "time"), [[0.0, 6.0]] * 2), "a time for each field"),
        (put(AXES(), "depth", ("time", "depth"), [[0.5, 9.0]] * 2), "a depth for each level"),
        (
            put(
                AXES(), "longitude", ("longitude",), [1.0] * 5, units="degrees", scale_factor=1e999
            ),
            "is no number with its scale_factor",
        ),
        (
            put(PLANE(), "mask_rho", ("none", "j", "i"), fuzz.np.ones((0, 4, 5)), units="1"),
            "mask_rho: is empty",
        ),
        (
            put(PROJECTED(), "y", ("y",), [0.0, 1e3, 2e3, 3e3], axis="X", units="m"),
            "contradict each other",
        ),
        (
            put(ROMS(), "angle", ("eta_rho", "xi_rho"), [[fuzz.np.nan] * 6] * 5),
            "angle: has no values",
        ),
        (
            put(
                AXES(), "time", ("time",), [0.0, 6.0], units="days since 2020-01-01", add_offset="x"
            ),
            "cannot be read as times",
        ),
        (
            put(
                AXES(),
                *("time", ("time",), [0.0, 6.0]),
                units="days since 2020-01-01",
                scale_factor=1e37,
            ),
            "cannot be read as times",
        ),
        (
            put(
                AXES(),
                *("longitude", ("longitude",), [5.0] * 5),
                units="degrees_east",
                add_offset=1e308,
            ),
            "no longitudes and latitudes of the Earth",
        ),
        (
            put(PLANE(), "lon", ("j", "i"), [[900.0] * 5] * 4, units="degrees_east"),
            "no longitudes and latitudes of the Earth",
        ),
        (
            put(PLANE(), "lon", ("j", "i"), [[5, 5, 5, 5, 6]] * 4, units="degrees_east"),
            "points for 20 cells; some lie far from the others",
        ),
        (
            put(
                PLANE(),
                *("lon", ("j", "i"), [[5.0, *[fuzz.np.nan] * 4]] + [[fuzz.np.nan] * 5] * 3),
                units="degrees_east",
            ),
            "cells in one place or on one line",
        ),
        (
            put(ROMS(), "s_rho", ("eta_rho", "xi_rho"), [[0.0] * 6] * 5, units="1"),
            "s_rho: .* must hold a depth for each level",
        ),
        (
            put(ROMS(), "s_rho", ("s_rho",), [fuzz.np.nan, -0.5], positive="up"),
            "s_rho: has levels without a depth",
        ),
        (
            put(PROJECTED(), "stereo", (), fuzz.np.int32(0), proj4="+init=epsg:4326"),
            "no longitudes and latitudes of the Earth",
        ),
    ],
)
def test_seas_that_were_found_once(sea: Any, said: str, tmp_path: Path) -> None:
    path = tmp_path / "sea.nc"
    path.write_bytes(fuzz.spoilt_seas.file_of(sea))
    with pytest.raises(InputError, match=said):
        fuzz.reader("sea").read(path)


def test_the_judge_of_readers_sees_faults(tmp_path: Path) -> None:
    """A reader that fails with a traceback, a warning or a page of text is told from a good one."""
    path = tmp_path / "file"

    def of(read: Any) -> str:
        return fuzz.fault_of(fuzz.Reader("", (), read), path) or ""

    assert "ZeroDivisionError" in of(lambda _: 1 // 0)
    assert "RuntimeWarning" in of(lambda _: fuzz.np.float64(1.0) / fuzz.np.float64(0.0))
    assert of(lambda _: None) == ""


HANGING = """
import itertools, sys
import fuzz

fuzz.SECONDS, fuzz.PATIENCE = 0.2, 0.5
fuzz._READERS["hangs"] = lambda: fuzz.Reader("", (b"x" * 99,), {})
sys.exit(fuzz.run("hangs", 2, 0))
"""


@pytest.mark.parametrize(
    "wait", ["lambda _: sum(itertools.repeat(0))", "lambda _: __import__('time').sleep(60)"]
)
def test_the_run_finds_what_never_ends_and_goes_on(wait: str) -> None:
    """A loop in C hears no signal handler of Python; a wait takes no processor time."""
    call = [sys.executable, "-c", HANGING.format(wait)]
    done = subprocess.run(
        call, cwd=_SOURCE.parent, capture_output=True, text=True, timeout=120, check=False
    )
    assert done.returncode == 2, done.stderr
    assert done.stdout.count("never comes to an end") == 2
    assert "in <lambda>" in done.stdout  # the place is told
    assert "hangs: 2 inputs, 2 findings" in done.stdout
