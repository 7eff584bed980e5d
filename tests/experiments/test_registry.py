"""The registry: one campaign at a time in one place, and what it was computed from."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from fiveroute.errors import InputError
from fiveroute.experiments.registry import Registry, file_hash

CONFIG: dict[str, Any] = {"seed": 1, "runs": 50, "loss": None}
INPUTS = {"instance": "abc", "currents": None}


def begin(path: Path, **changes: Any) -> Registry:
    return Registry.begin(path, CONFIG | changes, INPUTS, __name__)


def test_it_says_what_was_computed_and_by_what(tmp_path: Path) -> None:
    registry = begin(tmp_path / "run.json")
    record = json.loads(registry.path.read_text())
    assert record["config"] == CONFIG
    assert record["inputs"] == INPUTS
    assert record["versions"]["numpy"] == np.__version__
    assert record["ended"] is None
    registry.end()
    record = json.loads(registry.path.read_text())
    assert record["begun"] <= record["ended"]


def test_the_same_call_goes_on_and_another_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "run.json"
    first = begin(path)
    assert begin(path).record == first.record
    with pytest.raises(InputError, match=r"seed was 1, and is 2.*--force"):
        begin(path, seed=2)
    with pytest.raises(InputError, match="its input was another"):
        Registry.begin(path, CONFIG, INPUTS | {"instance": "xyz"}, __name__)
    with pytest.raises(InputError, match="fiveroute has changed"):
        Registry.begin(path, CONFIG, INPUTS, "fiveroute.sea.simulation")
    assert json.loads(path.read_text()) == first.record


def test_a_campaign_that_is_over_or_forced_out_makes_room(tmp_path: Path) -> None:
    path = tmp_path / "run.json"
    begin(path)
    journal = begin(path).journal
    journal.add([])
    assert Registry.begin(path, {"seed": 2}, {}, __name__, force=True).record["config"]["seed"] == 2
    assert not journal.path.exists()
    Registry.begin(path, {"seed": 2}, {}, __name__).end()
    assert begin(path).record["config"]["seed"] == 1


def test_half_a_registry_is_none(tmp_path: Path) -> None:
    path = tmp_path / "run.json"
    path.write_text('{"config": {"se')
    assert begin(path).record["config"] == CONFIG


def test_the_hash_of_a_file_is_that_of_its_bytes(tmp_path: Path) -> None:
    one, two = tmp_path / "one", tmp_path / "two"
    one.write_text("same")
    two.write_text("same")
    assert file_hash(one) == file_hash(two)
    two.write_text("other")
    assert file_hash(one) != file_hash(two)
