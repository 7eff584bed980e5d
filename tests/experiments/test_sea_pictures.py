"""Pictures of fleets at sea: what is drawn where."""

from collections.abc import Iterable

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle

from fiveroute.experiments.coordination_cases import Case, Round
from fiveroute.experiments.sea_pictures import (
    auction_rounds,
    coordination_case,
    scenario_chart,
    timeline,
)
from fiveroute.generate import generate
from fiveroute.routes import Plan
from fiveroute.sea.simulation import simulate_fleet
from fiveroute.sea.world import World


def texts(axis: Axes) -> list[str]:
    return [text.get_text() for text in axis.texts]


def boxes(axis: Axes) -> list[tuple[int, int]]:
    """Row and column of every boxed cell."""
    patches: Iterable[object] = axis.patches
    corners = [patch.get_xy() for patch in patches if isinstance(patch, Rectangle)]
    return sorted((round(y + 0.46), round(x + 0.46)) for x, y in corners)


def test_an_auction_boxes_its_winners_and_leaves_out_what_nobody_wants() -> None:
    psi = np.array([[2.0, 0.0, 4.0], [0.0, 0.0, 3.0]]) / 3600.0
    rounds = [Round((0, 2), (5, 6, 7), psi, (0, 2))]
    axis = auction_rounds(rounds, "t").axes[0]
    assert [label.get_text() for label in axis.get_xticklabels()] == ["5", "7"]
    assert [label.get_text() for label in axis.get_yticklabels()] == ["AUV 1", "AUV 3"]
    assert texts(axis) == ["2.00", "4.00", "–", "3.00"]
    assert boxes(axis) == [(0, 0), (1, 1)]


def test_no_auction_is_no_heat_map() -> None:
    assert auction_rounds([], "t").axes == []


def test_a_timeline_tells_every_node_and_mark() -> None:
    world = World.of(generate(nodes=14, seed=3), 2)
    plan = Plan.of([[1, 2, 3], [4, 5]])
    (run,) = simulate_fleet(world, plan, runs=1).runs
    (axis,) = timeline(world.problem, run.events, "t").axes
    collected = [str(event.node) for event in run.events if event.kind == "collect"]
    assert sorted(texts(axis)) == sorted(collected)
    for kind, mark in (("discard", "x"), ("pick_up", "+"), ("manoeuvre", "d"), ("arrive", "*")):
        drawn = [line for line in axis.lines if line.get_marker() == mark]
        shown = sum(len(np.atleast_1d(np.asarray(line.get_xdata()))) for line in drawn)
        assert shown == sum(event.kind == kind for event in run.events)


def test_a_case_shows_plan_both_runs_and_all_gains() -> None:
    instance = generate(nodes=14, seed=3)
    world, plan = World.of(instance, 2), Plan.of([[1, 2, 3], [4, 5]])
    alone, together = (
        simulate_fleet(world, plan, planner=planner, runs=3).runs
        for planner in ("no-coordination", "five-tier")
    )
    case = Case(1, instance, world, plan, alone, together)
    planned, without, with_it, gains = coordination_case(case).axes
    for axis, theta in (
        (planned, case.planned),
        (without, alone[case.typical].completion),
        (with_it, together[case.typical].completion),
    ):
        assert axis.get_title().endswith(f"{theta:.3f}")
    heights = [patch.get_height() for patch in gains.patches if isinstance(patch, Rectangle)]
    assert sum(heights) == 3


def test_scenarios_are_shaded_by_who_is_best() -> None:
    means = {"five-tier": [0.9, 0.8], "rmmp": [0.8, 0.85]}
    errors = {name: [0.01, 0.01] for name in means}
    above, below = scenario_chart(means, errors, [3, 4], 4).axes
    shades = [patch for patch in above.patches if isinstance(patch, Rectangle)]
    assert len(shades) == 2
    assert shades[0].get_facecolor() != shades[1].get_facecolor()
    bars = [patch.get_height() for patch in below.patches if isinstance(patch, Rectangle)]
    assert bars == [3, 4]
    labels = below.get_legend_handles_labels()[1]
    assert any("1 of 2" in label for label in labels)
