import hashlib
import json
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.errors import InputError
from fiveroute.formats import instance_hash
from fiveroute.generate import LAYOUTS, SIDE, _along_curve, generate, paper_scenario, scenario
from fiveroute.instance import Instance, Point


def test_paper_scenario_is_that_of_section_iv() -> None:
    paper = paper_scenario(1)
    assert len(paper.nodes) == 60
    assert (paper.start, paper.destination) == (Point(3000.0, 5000.0), Point(7000.0, 5000.0))
    assert (paper.fleet.size, paper.fleet.speed, paper.fleet.endurance) == (None, 1.0, 18_000.0)
    data = np.array([node.data for node in paper.nodes])
    np.testing.assert_allclose(paper.service_times[1:-1], 5.0 + 20.0 * data)
    assert len(paper.ocean.currents.vortices) == 20
    assert [node.id for node in paper.nodes] == [str(i) for i in range(2, 62)]


def test_distributions_are_those_of_the_paper() -> None:
    """Means and standard deviations over 100 scenarios, within four standard errors."""
    scenarios = [paper_scenario(seed) for seed in range(100)]
    points = np.array([(n.x, n.y) for s in scenarios for n in s.nodes])
    data = np.array([n.data for s in scenarios for n in s.nodes])
    vortices = [v for s in scenarios for v in s.ocean.currents.vortices]
    circulation = np.array([v.circulation for v in vortices])
    radius = np.array([v.radius for v in vortices])
    for sample, mean, deviation in (
        (points[:, 0], 5000.0, 10_000.0 / 12**0.5),
        (points[:, 1], 5000.0, 10_000.0 / 12**0.5),
        (data, 0.5, 1.0 / 12**0.5),
        (circulation, 0.0, 1000.0),
        (radius, 800.0, 100.0),
    ):
        error = deviation / len(sample) ** 0.5
        assert abs(sample.mean() - mean) < 4.0 * error
        assert abs(sample.std() - deviation) < 4.0 * error
    assert data.min() > 0.0
    assert data.max() <= 1.0


def test_both_strengths_share_nodes_and_places_of_the_vortices() -> None:
    effective, printed, still = (
        paper_scenario(7, currents=name) for name in ("effective", "printed", "none")
    )
    assert effective.nodes == printed.nodes == still.nodes
    assert not still.has_ocean
    pairs = zip(effective.ocean.currents.vortices, printed.ocean.currents.vortices, strict=True)
    for strong, weak in pairs:
        assert (strong.x, strong.y) == (weak.x, weak.y)
        assert strong.circulation == pytest.approx(20.0 * weak.circulation, abs=0.02)
        assert strong.radius == pytest.approx(10.0 * weak.radius, abs=0.02)


@given(
    layout=st.sampled_from(["paper", *LAYOUTS]),
    nodes=st.integers(0, 40),
    seed=st.integers(0, 2**32),
    fleet_size=st.none() | st.integers(1, 6),
)
@settings(deadline=None, max_examples=50)
def test_every_scenario_is_sound(
    layout: str, nodes: int, seed: int, fleet_size: int | None
) -> None:
    made = generate(layout, nodes=nodes, seed=seed, fleet_size=fleet_size)
    assert len(made.nodes) == nodes
    assert made == generate(layout, nodes=nodes, seed=seed, fleet_size=fleet_size)
    for node in made.nodes:
        assert 0.0 <= node.x <= 10_000.0
        assert 0.0 <= node.y <= 10_000.0
        assert 0.0 < node.data <= 1.0
        assert (node.x, node.y) == (round(node.x, 3), round(node.y, 3))
    problem = made.problem(made.fleet_size or 4)
    assert problem.duration([]) <= problem.allowed[0]


@pytest.mark.parametrize("layout", LAYOUTS)
def test_an_auv_reaches_most_nodes(layout: str) -> None:
    problem = scenario(layout, 50, 3, 20).problem()
    reached = [problem.duration([node]) <= problem.allowed[0] for node in range(1, 51)]
    assert np.mean(reached) >= 0.85


@pytest.mark.parametrize("layout", LAYOUTS)
def test_a_larger_fleet_needs_less_endurance(layout: str) -> None:
    endurance = [scenario(layout, 100, 1, size).problem().budgets[0] for size in (1, 2, 4, 8)]
    assert endurance == sorted(endurance, reverse=True)
    assert endurance[0] > 2.0 * endurance[3]


def test_curve_goes_from_cell_to_neighbouring_cell() -> None:
    cells = (np.indices((16, 16)).reshape(2, -1).T + 0.5) * SIDE / 16
    steps = np.diff(cells[_along_curve(cells)], axis=0)
    np.testing.assert_allclose(np.abs(steps).sum(axis=1), SIDE / 16)


def test_seeds_differ() -> None:
    assert len({instance_hash(paper_scenario(seed)) for seed in range(20)}) == 20


def test_another_process_makes_the_same() -> None:
    code = (
        "from fiveroute.generate import *; from fiveroute.formats import native;"
        "print(native.write(paper_scenario(5)), end='')"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert json.loads(done.stdout)["nodes"][0]["x"] == paper_scenario(5).nodes[0].x


def test_golden_scenario_does_not_move() -> None:
    """Instances are named by their seeds in the README and in results: they must stay."""
    nodes = json.dumps([(n.x, n.y, n.data) for n in paper_scenario(1).nodes])
    digest = hashlib.sha256(nodes.encode()).hexdigest()
    assert digest == "e39a74c21c5268d4acdbe37f979e6183835a6461a28cf8e6f80319ab0c93aeeb"


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"layout": "spiral"}, "layout: 'spiral': must be one of uniform"),
        ({"nodes": -1}, "nodes: -1: must be from 0"),
        ({"nodes": -1, "layout": "ring"}, "nodes: -1: must be from 0"),
        ({"seed": -1}, "seed: -1: must be from 0"),
        ({"fleet_size": 0}, "fleet_size: 0: must be from 1"),
        ({"fleet_size": 10**6}, "fleet_size: 1000000: must be from 1"),
        ({"currents": "strong"}, "currents: 'strong': must be one of effective"),
    ],
)
def test_wrong_arguments_are_refused(arguments: dict[str, object], words: str) -> None:
    with pytest.raises(InputError, match=words):
        generate(**arguments)  # type: ignore[arg-type]


def test_empty_scenarios_are_legal() -> None:
    empty: Instance = generate("uniform", nodes=0, seed=1)
    assert empty.problem().n == 0
