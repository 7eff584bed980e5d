"""The report on coordination, of two small cases."""

from pathlib import Path

import pytest

from fiveroute.errors import InputError
from fiveroute.experiments.coordination_cases import Case
from fiveroute.experiments.coordination_report import FILES, report, summary, write_report
from fiveroute.generate import generate
from fiveroute.routes import Plan
from fiveroute.sea.simulation import simulate_fleet
from fiveroute.sea.world import World


def case_of(fleet_size: int) -> Case:
    instance = generate(nodes=14, seed=3)
    world = World.of(instance, fleet_size)
    plan = Plan.of([range(1 + 2 * auv, 3 + 2 * auv) for auv in range(fleet_size)])
    alone, together = (
        simulate_fleet(world, plan, planner=planner, runs=3).runs
        for planner in ("no-coordination", "five-tier")
    )
    return Case(7, instance, world, plan, alone, together)


@pytest.fixture(scope="module")
def cases() -> list[Case]:
    return [case_of(3), case_of(4)]


def test_the_paper_stands_beside_ours(cases: list[Case]) -> None:
    three, four = (line for line in report(cases, (), 3).splitlines() if "scenario 7" in line)
    assert three.endswith("0.957, +7.6 % |")
    assert four.endswith("1.000 |")
    with_it = summary(cases, ())["cases"][1]["with"]
    assert f"{with_it:.3f}" in four


def test_the_report_and_all_pictures_are_written(cases: list[Case], tmp_path: Path) -> None:
    write_report(cases, (), 3, tmp_path)
    assert {file.name for file in tmp_path.iterdir()} == set(FILES)
    with pytest.raises(InputError):
        write_report(cases, (), 3, tmp_path)
