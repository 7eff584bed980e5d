"""Certificates on the command line: written, confirmed, refuted, refused."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

INSTANCE = Path(__file__).parent.parent.parent / "instances/small/small-12-m3-asymmetric.json"


@pytest.fixture
def certificate(call: Any, tmp_path: Path) -> Path:
    path = tmp_path / "certificate.json"
    assert call("solve", INSTANCE, "--certificate", path).code == 0
    return path


def edited(path: Path, **changes: object) -> Path:
    document = json.loads(path.read_text()) | changes
    path.write_text(json.dumps(document))
    return path


def test_a_bound_is_confirmed(call: Any, certificate: Path) -> None:
    optimum = call("solve", INSTANCE, "--method", "circuit", "--json").doc["objective"]
    answer = call("verify", INSTANCE, "--certificate", certificate, "--json")
    assert answer.code == 0
    assert answer.doc["confirmed"]
    assert answer.doc["bound"] >= optimum
    assert "no plan collects more" in call("verify", INSTANCE, "--certificate", certificate).out


def test_a_bound_that_is_too_low_is_refuted(call: Any, certificate: Path) -> None:
    worth = json.loads(certificate.read_text())["worth"]
    edited(certificate, worth=[value - 0.05 for value in worth])
    answer = call("verify", INSTANCE, "--certificate", certificate)
    assert answer.code == 1
    assert "refuted" in answer.out


def test_a_certificate_for_another_instance_is_refused(
    call: Any, certificate: Path, tiny: Path
) -> None:
    answer = call("verify", tiny, "--certificate", certificate)
    assert answer.code == 2
    assert "instance_hash" in answer.err


@pytest.mark.parametrize(
    ("text", "message"), [("{", "JSON text ends too early"), ("[]", "must be a JSON object")]
)
def test_what_is_no_certificate(call: Any, tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "certificate.json"
    path.write_text(text)
    answer = call("verify", INSTANCE, "--certificate", path)
    assert answer.code == 2
    assert message in answer.err


def test_a_plan_or_a_certificate(call: Any, certificate: Path) -> None:
    assert call("verify", INSTANCE).code == 2
    assert call("verify", INSTANCE, certificate, "--certificate", certificate).code == 2
