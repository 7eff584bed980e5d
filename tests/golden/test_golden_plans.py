"""Whole runs with a fixed seed, their data to the last digit.

Who changes a search moves these figures, and states them before and after in the commit.
"""

from typing import Any

import pytest

from fiveroute.check import check
from fiveroute.generate import paper_scenario, scenario
from fiveroute.instance import Instance
from fiveroute.mission import plan_mission

PAPER: dict[str, Any] = {"search": "paper"}
LITERAL: dict[str, Any] = {"search": "paper", "literal": True}

GOLDEN: dict[str, tuple[Instance, dict[str, Any], int, float]] = {
    "scenario-01, paper": (paper_scenario(1), PAPER, 4, 31.072208),
    "scenario-03, paper": (paper_scenario(3), PAPER, 3, 28.577842),
    "scenario-01, to the letter": (paper_scenario(1), LITERAL, 4, 30.517437),
    "scenario-01, k-means": (
        paper_scenario(1),
        {**LITERAL, "allocation": "k-means"},
        4,
        30.034552,
    ),
    "scenario-01, Voronoi": (
        paper_scenario(1),
        {**LITERAL, "allocation": "voronoi"},
        4,
        28.697901,
    ),
    "scenario-01, AHC": (paper_scenario(1), {**LITERAL, "allocation": "ahc"}, 4, 29.464919),
    "scenario-01, 90 % of 50 samples": (
        paper_scenario(1),
        {**LITERAL, "samples": 50, "quantile": 0.9},
        4,
        27.005129,
    ),
    "scenario-03, fleet": (paper_scenario(3), {}, 3, 29.445144),
    "clustered-40, fleet": (scenario("clustered", 40, 5, 3), {}, 3, 17.311590),
}


@pytest.mark.parametrize("name", GOLDEN)
def test_the_plan_is_as_good_as_ever(name: str) -> None:
    instance, options, fleet_size, objective = GOLDEN[name]
    planned = plan_mission(instance, seed=1, **options)
    assert planned.problem.fleet_size == fleet_size
    assert planned.result.plan is not None
    assert check(planned.problem, planned.result.plan) == []
    assert planned.result.objective == pytest.approx(objective, rel=1e-9)
