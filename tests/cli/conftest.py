import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from fiveroute.cli import main

ROOT = Path(__file__).parent.parent.parent


@dataclass(frozen=True)
class Answer:
    code: int
    out: str
    err: str

    @property
    def doc(self) -> dict[str, Any]:
        document: dict[str, Any] = json.loads(self.out)
        return document


Call = Callable[..., Answer]


@pytest.fixture
def call(capsys: pytest.CaptureFixture[str]) -> Call:
    """Call the command line in this process."""

    def run(*arguments: object) -> Answer:
        with pytest.raises(SystemExit) as end:
            main([str(argument) for argument in arguments])
        out, err = capsys.readouterr()
        return Answer(end.value.code if isinstance(end.value.code, int) else 0, out, err)

    return run


@pytest.fixture
def tiny(tmp_path: Path) -> Path:
    """Three nodes on a line between start and destination, budget for all but the far one."""
    document = {
        "format": "fiveroute-instance/1",
        "name": "tiny",
        "nodes": [
            {"id": "a", "x": 10.0, "y": 0.0, "data": 0.5},
            {"id": "b", "x": 20.0, "y": 0.0, "data": 0.25},
            {"id": "far", "x": 20.0, "y": 900.0, "data": 1.0},
        ],
        "start": {"x": 0.0, "y": 0.0},
        "destination": {"x": 30.0, "y": 0.0},
        "fleet": {"size": 1, "speed": 1.0, "endurance": 60.0},
        "service": {"delay": 1.0, "rate": 2.0},
    }
    path = tmp_path / "tiny.json"
    path.write_text(json.dumps(document), encoding="utf-8")
    return path


@pytest.fixture
def edited(tiny: Path) -> Callable[..., Path]:
    """The tiny instance with some values changed, by dotted path."""

    def edit(**changes: object) -> Path:
        document = json.loads(tiny.read_text(encoding="utf-8"))
        for dotted, value in changes.items():
            *parents, last = dotted.split("__")
            place = document
            for parent in parents:
                place = place[int(parent) if parent.isdigit() else parent]
            place[last] = value
        path = tiny.with_name("edited.json")
        path.write_text(json.dumps(document), encoding="utf-8")
        return path

    return edit
