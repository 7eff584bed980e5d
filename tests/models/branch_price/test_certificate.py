"""Certificates are confirmed by the independent check, and wrong ones are not."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.spatial.distance import cdist

from fiveroute.errors import InputError
from fiveroute.limits import Limits
from fiveroute.models import branch_price
from fiveroute.models.branch_price.certificate import certify
from fiveroute.models.certificate_check import check_certificate
from fiveroute.problem import TeamOrienteering


def field(n: int, seed: int, budgets: list[float]) -> TeamOrienteering:
    rng = np.random.default_rng(seed)
    xy = rng.uniform(0.0, 10.0, (n + 2, 2))
    profit = np.pad(1.0 - rng.random(n), 1)
    return TeamOrienteering(cdist(xy, xy), 0.1 * (profit > 0.0), profit, budgets)


@pytest.mark.parametrize("seed", range(24))
def test_odd_problems_are_confirmed(seed: int, odd: Callable[[int], Any]) -> None:
    truth = odd(seed)
    certificate = certify(truth.problem)
    if truth.optimum is None:
        return
    assert certificate is not None
    verdict = check_certificate(truth.problem, json.loads(json.dumps(certificate.document())))
    assert verdict.confirmed
    assert verdict.bound >= truth.optimum
    assert verdict.bound == pytest.approx(certificate.bound, rel=1e-6, abs=1e-6)


@pytest.mark.parametrize("budgets", [[11.0, 11.0], [11.0, 12.0, 12.0]])
def test_a_larger_problem_is_confirmed_and_tight(budgets: list[float]) -> None:
    problem = field(14, 1, budgets)
    certificate = certify(problem)
    assert certificate is not None
    verdict = check_certificate(problem, certificate.document())
    best = branch_price.solve(problem).objective
    assert best is not None
    assert verdict.confirmed
    assert best <= verdict.bound <= 1.1 * best


@pytest.mark.parametrize("field_name", ["worth", "multipliers"])
def test_a_claim_too_low_is_refuted(field_name: str) -> None:
    problem = field(15, 2, [11.0, 11.0])
    certificate = certify(problem)
    assert certificate is not None
    document = certificate.document()
    largest = max(range(len(document[field_name])), key=document[field_name].__getitem__)
    document[field_name][largest] *= 0.99
    verdict = check_certificate(problem, document)
    assert not verdict.confirmed
    assert verdict.excess > 0.0
    gain = problem.profit - np.pad(document["multipliers"], 1)
    assert verdict.excess == pytest.approx(gain[list(verdict.route)].sum() - document["worth"][0])


def test_a_certificate_of_another_problem_is_refuted() -> None:
    certificate = certify(field(15, 2, [9.0, 9.0]))
    assert certificate is not None
    assert not check_certificate(field(15, 2, [11.0, 11.0]), certificate.document()).confirmed


def test_a_check_that_is_stopped_confirms_nothing() -> None:
    problem = field(25, 3, [14.0, 14.0])
    certificate = certify(problem)
    assert certificate is not None
    document = certificate.document()
    document["worth"] = [worth + 0.5 for worth in document["worth"]]
    document["multipliers"] = [0.0] * 25
    assert not check_certificate(problem, document, Limits(time=0.0)).confirmed


def test_a_bound_cut_short_is_confirmed_too() -> None:
    problem = field(18, 3, [9.0, 9.0])
    certificate = certify(problem, Limits(time=0.05))
    if certificate is not None:
        assert check_certificate(problem, certificate.document()).confirmed


@pytest.mark.parametrize(
    ("name", "value", "rule"),
    [
        ("format", "something else", "no certificate"),
        ("multipliers", [1.0], "list of 15 numbers"),
        ("multipliers", [-1.0] * 15, "negative"),
        ("multipliers", ["a"] * 15, "numbers up to"),
        ("worth", [1.0, 2.0], "list of 1 numbers"),
        ("worth", [float("nan")], "numbers up to"),
        ("neighbours", [[1]], "15 lists"),
        ("neighbours", [[99]] * 15, "nodes 1 to 15"),
    ],
)
def test_what_is_no_certificate_is_refused(name: str, value: object, rule: str) -> None:
    problem = field(15, 2, [9.0, 9.0])
    certificate = certify(problem)
    assert certificate is not None
    with pytest.raises(InputError, match=rule):
        check_certificate(problem, {**certificate.document(), name: value})
