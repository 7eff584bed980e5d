"""A disk that is full, a pipe that is closed, no home, no terminal: one line, or all the same."""

import json
import os
import resource
import signal
import subprocess
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest

from fiveroute.formats import PlanFile, write_instance, write_plan
from fiveroute.generate import generate
from fiveroute.result import Result
from fiveroute.routes import Plan

ROOT = Path(__file__).parents[2]
GENERATE = ("generate", "uniform", "--nodes", "300", "--output")

Run = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture
def run(tmp_path: Path) -> Run:
    """Run the command line as a process of its own, in an empty folder."""

    def start(
        *arguments: object, env: dict[str, str] | None = None, **more: object
    ) -> subprocess.CompletedProcess[str]:
        given = {**os.environ, "PYTHONPATH": str(ROOT)} if env is None else env
        streams: dict[str, object] = {
            "stdout": subprocess.PIPE,
            "stderr": subprocess.PIPE,
            "stdin": subprocess.DEVNULL,
        }
        call = [sys.executable, "-m", "fiveroute", *map(str, arguments)]
        done: subprocess.CompletedProcess[str] = subprocess.run(
            call, cwd=tmp_path, env=given, encoding="utf-8", check=False, **(streams | more)
        )  # type: ignore[call-overload]
        return done

    return start


def told(done: subprocess.CompletedProcess[str]) -> str:
    """The one line of an error."""
    assert done.returncode == 2, done.stderr
    (line,) = done.stderr.splitlines()
    assert line.startswith("fiveroute: ")
    return line


def small_files(size: int = 1024) -> None:
    """A disk on which every file is full after a kilobyte."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))


def test_a_full_disk(run: Run, tmp_path: Path) -> None:
    (tmp_path / "sea.json").write_text("old")
    done = run(*GENERATE, "sea.json", "--force", preexec_fn=small_files)
    assert "sea.json: cannot be written (File too large)" in told(done)
    assert (tmp_path / "sea.json").read_text() == "old"
    assert [path.name for path in tmp_path.iterdir()] == ["sea.json"]


@pytest.mark.parametrize(
    "command",
    [
        "view bay.plan.json --output new.pdf",
        "simulate bay.json bay.plan.json --runs 1 --workers 1 --tracks new.nc",
    ],
)
def test_a_disk_that_is_full_before_a_library_has_written(
    command: str, run: Run, tmp_path: Path
) -> None:
    bay = generate("uniform", nodes=3, seed=1, fleet_size=1, currents="none")
    write_instance(bay, tmp_path / "bay.json")
    legs = bay.problem(1)
    result = Result.judged(legs, Plan.of([[1, 2]]), method="by-hand", seconds=0.0)
    write_plan(PlanFile.of(bay, legs, result), tmp_path / "bay.plan.json")
    done = run(*command.split(), preexec_fn=partial(small_files, 12288))
    assert done.returncode == 2
    *notes, line = done.stderr.splitlines()
    assert "cannot be written (File too large)" in line
    assert all("compiling its kernels" in note for note in notes)
    assert {path.name for path in tmp_path.iterdir()} == {"bay.json", "bay.plan.json"}


@pytest.mark.parametrize(
    ("place", "reason"),
    [
        ("/dev/full", "No space left on device"),
        ("/proc/sea.json", "cannot be written"),
        (".", "is a folder"),
        ("none/sea.json", "folder 'none' does not exist"),
        ("a" * 300, "File name too long"),
    ],
)
def test_a_place_that_cannot_be_written(place: str, reason: str, run: Run) -> None:
    assert reason in told(run(*GENERATE, place))


def test_a_full_standard_output(run: Run) -> None:
    with Path("/dev/full").open("w") as full:
        assert "No space left on device" in told(run("--help", stdout=full))


def test_a_reader_that_has_read_enough(run: Run) -> None:
    reading, writing = os.pipe()
    os.close(reading)
    try:
        done = run("--help", stdout=writing)
    finally:
        os.close(writing)
    assert done.stderr == ""


def without(*streams: int) -> Callable[[], None]:
    """Standard streams closed before the process begins."""

    def close() -> None:
        for stream in streams:
            os.close(stream)

    return close


def test_nobody_listens(run: Run, tmp_path: Path) -> None:
    """Standard input, output and error all closed."""
    done = run(*GENERATE, "sea.json", preexec_fn=without(0, 1, 2))
    assert done.returncode == 0
    assert json.loads((tmp_path / "sea.json").read_text())["name"]


def test_an_answer_that_nobody_hears(run: Run) -> None:
    assert "standard output is closed" in told(run("--version", preexec_fn=without(1)))
    assert run("--version", preexec_fn=without(0, 1, 2)).returncode == 2


def test_notes_that_nobody_hears(run: Run, tmp_path: Path) -> None:
    """A full standard error costs nothing but what would be said there."""
    (tmp_path / "chart.csv").write_text("id,x,y\na,1,2\n")
    chart = "convert chart.csv --to native --start 0,0 --destination 9,9 --speed 1 --endurance 99"
    with Path("/dev/full").open("w") as full:
        assert run(*chart.split(), "--output", "sea.json", stderr=full).returncode == 0
        assert run(*GENERATE, "none/sea.json", stderr=full).returncode == 2
        assert run(stderr=full).returncode == 2
    assert (tmp_path / "sea.json").is_file()


def test_an_output_that_is_a_link_to_itself(run: Run, tmp_path: Path) -> None:
    (tmp_path / "sea.json").symlink_to("sea.json")
    assert "sea.json: cannot be written (Too many levels" in told(run(*GENERATE, "sea.json"))


def test_a_poor_environment(run: Run, tmp_path: Path) -> None:
    """No home, no cache, no terminal, and a locale without accents, for ids that have some."""
    line = '{"id": "b\u00f8ye \u0915", "x": 1.0, "y": 2.0, "data": 1.0}'
    (tmp_path / "sea.json").write_text(
        f'{{"format": "fiveroute-instance/1", "name": "sj\u00f8", "nodes": [{line}], '
        '"start": {"x": 0.0, "y": 0.0}, "destination": {"x": 9.0, "y": 0.0}, '
        '"fleet": {"size": 1, "speed": 1.0, "endurance": 99.0}}',
        encoding="utf-8",
    )
    poor = {
        "PATH": "/usr/bin:/bin",
        "PYTHONPATH": str(ROOT),
        "LC_ALL": "C",
        "PYTHONUTF8": "0",
        "PYTHONCOERCECLOCALE": "0",
        "FIVEROUTE_CACHE": "/proc/none",
    }
    done = run("solve", "sea.json", "--method", "brute-force", "--output", "plan.json", env=poor)
    assert done.returncode == 0, done.stderr
    assert "b\\xf8ye \\u0915" in done.stdout
    done = run("verify", "sea.json", "plan.json", env=poor)
    assert done.returncode == 0, done.stderr


def test_a_name_of_a_file_that_is_no_text(run: Run, tmp_path: Path) -> None:
    name = os.fsencode(tmp_path) + b"/\xff.txt"
    Path(os.fsdecode(name)).write_text("n 2\nm 1\ntmax 1\n0 0 0\n1 1 0\n")
    done = run("convert", os.fsdecode(name), "--to", "native", "--output", "sea.json")
    assert done.returncode == 0, done.stderr
    assert json.loads((tmp_path / "sea.json").read_text())["name"] == "?"
    missing = run("convert", os.fsdecode(b"\xfe"), "--to", "native", "--output", "other.json")
    assert "does not exist" in told(missing)


NOBODY = """
import os
import numpy as np
from fiveroute.kernels import kernel
from fiveroute.paths.leg_cache import keep_table, kept_table
from fiveroute.paths.leg_table import LegTable
def thrice(x):
    return 3.0 * x
assert kernel(thrice)(2.0) == 6.0
thrice.__module__ = "fiveroute.check_paths"
os.setgid(54321)
os.setuid(54321)
keep_table("key", LegTable.of(2, {(0, 1): (5.0, np.zeros((2, 2)))}))
assert kept_table("key") is None
assert kernel(thrice)(2.0) == 6.0
print(os.listdir("."))
"""


@pytest.mark.skipif(os.getuid() != 0, reason="only root can become somebody else")
def test_a_user_without_a_home_keeps_nothing(tmp_path: Path) -> None:
    """As in a container: neither a home, nor a folder of the package that can be written."""
    script, folder = tmp_path / "script.py", tmp_path / "here"
    script.write_text(NOBODY)
    folder.mkdir()
    folder.chmod(0o777)
    poor = {"PATH": "/usr/bin:/bin", "PYTHONPATH": str(ROOT), "PYTHONDONTWRITEBYTECODE": "1"}
    done = subprocess.run(
        [sys.executable, str(script)],
        cwd=folder,
        env=poor,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == "[]\n"
