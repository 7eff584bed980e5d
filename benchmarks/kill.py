"""Every command that writes, killed at any moment: what it writes is the old file or the new one.

    python benchmarks/kill.py COMMAND|all [--count N] [--seed N]

A command is carried out twice, which gives its time, its files, and its moments: each time that it
names a draft, or opens, renames or removes a file in its folder. Then it is started again and again
over them, in every other run with the files taken away before. One run in four is killed (SIGKILL)
at any time. The others have a timer set at one of the moments that runs out before the next, and
ends the process in the midst of a call (SIGALRM, of which nobody takes notice): the milliseconds in
which files are written get most of the kills, however long a command takes. After each kill every
file must be whole, or missing where it was missing; only hidden drafts may lie beside them.
"""

from __future__ import annotations

import argparse
import csv
import importlib
import io
import json
import os
import random
import re
import shutil
import signal
import sys
import tempfile
import time
import zipfile
from contextlib import suppress
from itertools import pairwise
from pathlib import Path
from typing import Any

import xarray

from fiveroute import whole_files
from fiveroute.cli import main as fiveroute
from fiveroute.formats import read_instance, read_plan, write_instance
from fiveroute.generate import generate
from fiveroute.studio.session import Session

COMMANDS = {
    "generate": "generate uniform --nodes 5000 --output new.json",
    "convert": "convert bay.json --to native --output new.json",
    "plan": "plan bay.json --output new.plan.json",
    "solve": "solve bay.json --output new.plan.json --certificate new.certificate.json",
    "export-folder": "export bay.plan.json --to moos --depth 5 --origin 10,63 --output new",
    "export-archive": "export bay.plan.json --to neptus --depth 5 --origin 10,63 "
    "--output new.nmisz",
    "export-file": "export bay.plan.json --to kml --depth 5 --origin 10,63 --output new.kml",
    "view": "view bay.plan.json --output new.html",
    "picture": "view bay.plan.json --output new.png",
    "film": "view bay.plan.json --output new.gif",
    "path": "path bay.json start 2 --picture new.svg",
    "simulate": "simulate bay.json bay.plan.json --runs 3 --workers 1 --events new.jsonl "
    "--output new.csv",
    "parquet": "simulate bay.json bay.plan.json --runs 3 --workers 1 --output new.parquet",
    "tracks": "simulate bay.json bay.plan.json --runs 2 --workers 1 --actuation vehicle "
    "--events new.jsonl --tracks new.nc",
    "studio": "studio bay.plan.json",
    "gap": "gap bay.json --time-limit 0.2 --exact-time-limit 0.2 --workers 1 --keep kept "
    "--output new.csv",
    "decide": "decide fleet-size bay.json --sizes 1,2 --time-limit 1 --output new.csv "
    "--picture new.pdf",
    "speed": "decide speed bay.json --speeds 1,2 --bound none --output new.md --picture new.png",
    "experiment": "experiment preplanning --scenarios 1 --output new",
    "stochastic": "experiment stochastic --scenarios 1 --runs 2 --workers 1 --output new",
    "coordination": "experiment coordination --scenarios 0 --runs 1 --output new",
}

_POLL = 0.002  # seconds between two looks
_CHANGES = {
    *("open", "os.rename", "os.remove", "os.mkdir", "os.rmdir", "os.chmod", "shutil.rmtree"),
}
_REPORT = "report"  # beside the folder of a command: its moments, and the modules that it took


def is_whole(path: Path) -> bool:
    """Whether a file is complete, by the rules of its format."""
    content = path.read_bytes()
    if path.name.endswith(".plan.json"):
        read_plan(path)
    elif path.suffix == ".json" and b"fiveroute-instance/1" in content:
        read_instance(path)
    elif path.suffix == ".json":
        json.loads(content)
    elif path.suffix == ".jsonl":
        return content.endswith(b"\n") and all(map(json.loads, content.splitlines()))
    elif path.suffix == ".csv":
        rows = list(csv.reader(io.StringIO(content.decode())))
        return content.endswith(b"\n") and len({len(row) for row in rows}) == 1
    elif path.suffix == ".nmisz":
        return zipfile.ZipFile(path).testzip() is None
    elif path.suffix == ".png":
        return content.endswith(b"IEND\xaeB`\x82")
    elif path.suffix == ".gif":
        return content.startswith(b"GIF89a") and content.endswith(b";")
    elif path.suffix == ".nc":
        xarray.load_dataset(path, engine="h5netcdf")
    elif path.suffix == ".parquet":
        return content.startswith(b"PAR1") and content.endswith(b"PAR1")
    else:
        ends = {".html": b"</html>", ".kml": b"</kml>", ".svg": b"</svg>", ".pdf": b"%%EOF"}
        end = ends.get(path.suffix, b"")
        return len(content) > 0 and content.rstrip().endswith(end)
    return True


def started(arguments: list[str], folder: Path, aim: tuple[int, float] | None = None) -> int:
    """The process of a command, forked so that nothing has to be imported again.

    With an aim it ends itself so many seconds after the moment of that number.
    """
    child = os.fork()
    if child:
        return child
    os.chdir(folder)
    nowhere = os.open(os.devnull, os.O_RDWR)
    for stream in range(3):
        os.dup2(nowhere, stream)
    moments = watched(folder, aim)
    try:
        if arguments[0] == "studio":
            Session.opened(Path(arguments[1])).save("new.json", "new.plan.json", overwrite=True)
        else:
            fiveroute(arguments)
        os._exit(0)
    except SystemExit as end:
        report = {"moments": moments, "modules": sorted(sys.modules)}
        (folder.parent / _REPORT).write_text(json.dumps(report))
        os._exit(end.code if isinstance(end.code, int) else 0)
    finally:
        os._exit(99)


def watched(folder: Path, aim: tuple[int, float] | None) -> list[float]:
    """When this process changes something in a folder; a list that grows."""
    moments = list[float]()

    def note() -> None:
        moments.append(time.monotonic())
        if aim is not None and len(moments) == aim[0] + 1:
            signal.setitimer(signal.ITIMER_REAL, max(aim[1], 1e-6))

    def hear(event: str, arguments: tuple[Any, ...]) -> None:
        if event not in _CHANGES or not isinstance(arguments[0], str | os.PathLike):
            return
        place = Path(arguments[0]).absolute()
        is_read = event == "open" and arguments[2] & os.O_ACCMODE == os.O_RDONLY
        if place.is_relative_to(here) and (place.name.startswith(".") or not is_read):
            note()

    class Secrets:
        """Drafts are named with it, before a library makes the file that nobody hears of."""

        @staticmethod
        def token_hex(size: int) -> str:
            note()
            return os.urandom(size).hex()

    here = folder.resolve()
    whole_files.secrets = Secrets  # type: ignore[assignment]
    sys.addaudithook(hear)
    return moments


def has_ended(child: int) -> bool:
    """Whether a process is over; it can still be waited for."""
    return os.waitid(os.P_PID, child, os.WEXITED | os.WNOHANG | os.WNOWAIT) is not None


def wait(child: int, seconds: float) -> None:
    """Wait for some time, or to the end of a process."""
    until = time.monotonic() + seconds
    while time.monotonic() < until and not has_ended(child):
        time.sleep(min(_POLL, max(until - time.monotonic(), 0.0)))


def seen(folder: Path, inputs: frozenset[str]) -> frozenset[str]:
    """Files of a command, without its inputs, its drafts and the journals of its runs."""
    names = (str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file())
    hidden = re.compile(r"(^|/)\.|\.run\.jsonl$|/cells/.*\.jsonl$")
    return frozenset(name for name in names if not hidden.search(name)) - inputs


def reset(folder: Path, model: Path) -> int:
    """Make a folder the same as another one; the number of drafts that were in it."""
    drafts = sum(path.name.startswith(".") for path in folder.rglob("*"))
    shutil.rmtree(folder)
    shutil.copytree(model, folder)
    return drafts


def prepared(folder: Path) -> frozenset[str]:
    """Write what commands read; in a process of its own, since a fork has no solver's threads."""
    bay = generate("uniform", nodes=6, seed=1, fleet_size=2, currents="none")
    write_instance(bay, folder / "bay.json")
    _, status = os.waitpid(started(["plan", "bay.json", "--output", "bay.plan.json"], folder), 0)
    assert status == 0, "plan"
    return frozenset(path.name for path in folder.iterdir())


def run(name: str, count: int, seed: int) -> int:
    """Kill a command again and again; the number of findings."""
    rng = random.Random(f"{name} {seed}")
    arguments = [*COMMANDS[name].split(), "--force"]
    with tempfile.TemporaryDirectory() as place:
        folder, before, after = (Path(place) / part for part in ("here", "before", "after"))
        folder.mkdir()
        inputs = prepared(folder)
        shutil.copytree(folder, before)
        for _ in range(2):  # the first one may compile kernels
            begun = time.monotonic()
            _, status = os.waitpid(started(arguments, folder), 0)
            assert status == 0, name
            end, report = time.monotonic(), json.loads((Path(place) / _REPORT).read_text())
            for module in report["modules"]:
                with suppress(Exception):
                    importlib.import_module(module)
        whole, gaps = seen(folder, inputs), spaces(report["moments"])
        shutil.copytree(folder, after)
        assert whole, name
        killed = drafts = findings = 0
        for k in range(count):
            reset(folder, before if k % 2 else after)
            if rng.random() < 0.25:
                child = started(arguments, folder)
                wait(child, rng.uniform(0.0, end - begun))
                os.kill(child, signal.SIGKILL)
            else:
                moment = rng.randrange(len(gaps))
                child = started(arguments, folder, (moment, rng.uniform(0.0, gaps[moment])))
            _, status = os.waitpid(child, 0)
            killed += os.WIFSIGNALED(status)
            for fault in faults(folder, inputs, whole, is_over=k % 2 == 0):
                findings += 1
                sys.stdout.write(f"{name}: {fault}\n")
            drafts += reset(folder, before)
    sys.stdout.write(
        f"{name}: {count} runs of {end - begun:.2f} s, {killed} killed, {drafts} drafts left, "
        f"{len(gaps)} moments, {findings} findings\n"
    )
    sys.stdout.flush()
    return findings


def spaces(moments: list[float]) -> list[float]:
    """Seconds from each moment to the next, and a millisecond after the last."""
    return [*(after - before for before, after in pairwise(moments)), 1e-3]


def faults(
    folder: Path, inputs: frozenset[str], whole: frozenset[str], *, is_over: bool
) -> list[str]:
    """What is wrong with the files of a killed command."""
    found = seen(folder, inputs)
    wrong = [f"{path} is not whole" for path in found if not is_whole(folder / path)]
    strange = {path for path in found if not path.startswith("kept/")} - whole
    wrong += [f"{path} is not one of its files" for path in strange]
    if is_over:
        wrong += [f"{path} is lost" for path in whole if path not in found]
    if (folder / "new").exists() and whole - found and "new/report.md" not in whole:
        wrong.append("new is half a folder")  # reports are several files, one after the other
    return wrong


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("command", choices=[*COMMANDS, "all"])
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seed", type=int, default=0)
    asked = parser.parse_args()
    names = list(COMMANDS) if asked.command == "all" else [asked.command]
    sys.exit(sum(run(name, asked.count, asked.seed) for name in names) > 0)


if __name__ == "__main__":
    main()
