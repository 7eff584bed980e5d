"""The optima that instances/README.md states, proved again."""

import re
from pathlib import Path

import pytest

from fiveroute.formats import read_instance
from fiveroute.models import solve
from fiveroute.result import Status

INSTANCES = Path(__file__).parent.parent / "instances"
TABLE = re.search(
    "<!-- small:begin -->(.*)<!-- small:end -->",
    (INSTANCES / "README.md").read_text(encoding="utf-8"),
    re.DOTALL,
)
ROWS = re.findall(r"^\| (small-\S+) \|.*\| ([\d.]+) \|$", TABLE[1] if TABLE else "", re.MULTILINE)


def test_every_small_instance_has_its_optimum() -> None:
    assert {name for name, _ in ROWS} == {p.stem for p in INSTANCES.glob("small/*.json")}


@pytest.mark.parametrize(("name", "optimum"), ROWS)
def test_the_stated_optimum_is_proved(name: str, optimum: str) -> None:
    problem = read_instance(INSTANCES / "small" / f"{name}.json").problem()
    result = solve(problem, "circuit")
    assert result.status is Status.OPTIMAL
    assert result.objective == pytest.approx(float(optimum), abs=5e-7)
