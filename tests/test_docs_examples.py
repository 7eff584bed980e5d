"""What docs/ and README.md show works: Python examples run, calls of the command line are calls."""

import re
import shlex
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import click
import pytest

import fiveroute as fr
from fiveroute.cli import COMMANDS

ROOT = Path(__file__).parent.parent
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
NODES = "id,lon,lat,data\na,10.39,63.44,1\nb,10.37,63.45,2\n"


def examples() -> list[tuple[str, str]]:
    """The pages' examples in Python; README.md has a test of its own."""
    return [
        (page.name, code)
        for page in PAGES[1:]
        for code in re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)
    ]


def calls() -> list[str]:
    """Every line that calls the command line, in the pages' order."""
    lines = [
        line
        for page in PAGES
        for line in re.findall(
            r"^    (?:\$ )?fiveroute (.*)", page.read_text(encoding="utf-8"), re.MULTILINE
        )
    ]
    return [line.split("#")[0].replace("...", "").strip() for line in lines]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A mission, its plan and a chart of nodes, named as the pages name them."""
    there = tmp_path_factory.mktemp("pages")
    terms = shlex.split(
        "--start 10.38,63.44 --destination 10.38,63.44 --speed 1.5 --endurance 20000"
    )
    (there / "nodes.csv").write_text(NODES, encoding="utf-8")
    chart = ("convert", "nodes.csv", "--to", "native", "--output", "sea.json", *terms)
    module = (sys.executable, "-m", "fiveroute")
    subprocess.run([*module, *chart, "--fleet-size", "1"], cwd=there, check=True)
    fr.plan(fr.read(there / "sea.json")).save(there / "plan.json")
    return there


@pytest.mark.parametrize(("page", "code"), examples(), ids=lambda text: str(text).split("\n")[0])
def test_examples_run(folder: Path, page: str, code: str) -> None:
    served = code.replace("    studio.serve_forever()\n", "")  # it would serve for ever
    done = subprocess.run(
        [sys.executable, "-c", served], cwd=folder, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, f"{page}: {done.stderr}"


@pytest.mark.parametrize("call", calls())
def test_calls_are_understood(call: str) -> None:
    name, *words = shlex.split(call)
    assert name in COMMANDS
    command = import_module(f"fiveroute.cli.{name.replace('-', '_')}").command
    if isinstance(command, click.Group):
        command, words = command.commands[words[0]], words[1:]
    command.make_context(name, words)
