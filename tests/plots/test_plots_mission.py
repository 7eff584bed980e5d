import math
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from fiveroute.plots import plot_mission, plot_plan
from fiveroute.view.scene import Scene, scene_of


def tracks(ax: Axes) -> dict[str, list[list[float]]]:
    """Lines by their names."""
    return {
        str(line.get_label()): line.get_xydata().tolist()  # type: ignore[union-attr]
        for line in ax.lines
        if str(line.get_label()).startswith("AUV")
    }


def test_routes_lead_over_their_nodes(pond: Scene) -> None:
    own = Figure().subplots()
    ax = plot_plan(pond, own)
    assert ax is own
    shown = tracks(ax)
    assert list(shown) == ["AUV 1", "AUV 2"]
    assert [1.0, 0.0] in shown["AUV 1"]
    assert [2.0, 0.5] in shown["AUV 2"]
    assert ax.get_title() == "pond: 5 of 10 collected, gap 100.0%"


def test_mission_is_drawn_as_far_as_it_has_come(pond: Scene) -> None:
    ax = plot_mission(pond, t=500.0)
    shown = tracks(ax)
    assert shown["AUV 1"][-1] == pytest.approx([0.5, 0.0])
    assert shown["AUV 2"][-1] == pytest.approx([1.0 / math.sqrt(4.25), 0.25 / math.sqrt(4.25)])
    assert ax.get_title() == "pond, plan: 0 of 10 collected in 0.14 h"


def test_run_is_drawn_from_its_log(pond: Scene) -> None:
    ax = plot_mission(pond, pond.runs[0])
    shown = tracks(ax)
    assert shown["AUV 1"][-1] == pytest.approx([4.0, 0.0])
    assert shown["AUV 2"] == [[0.0, 0.0]]
    assert ax.get_title() == "pond, run 3: 2 of 10 collected"


def test_ways_that_nobody_told_are_drawn_in_pieces(pond: Scene) -> None:
    """The run goes home from node a, which no planned path does."""
    a, b, start, home = (1000.0, 0.0), (2000.0, 500.0), (0.0, 0.0), (4000.0, 0.0)
    paths = ((start, a), (a, b), (b, home)), ((start, home),)
    planned = replace(pond.plan, routes=(("a", "b"), ()), paths=paths)
    scene = scene_of(planned, runs=pond.runs)
    assert pieces(plot_mission(scene, pond.runs[0])) == [[[1.0, 0.0], [4.0, 0.0]]]
    assert pieces(plot_mission(scene, pond.runs[0], t=2500.0)) == [[[1.0, 0.0], [2.5, 0.0]]]
    assert pieces(plot_mission(scene, pond.runs[0], t=900.0)) == pieces(plot_plan(scene)) == []


def pieces(ax: Axes) -> list[list[list[float]]]:
    """What is drawn over tracks as gaps."""
    dashed = [line for line in ax.lines if line.get_linestyle() == "--"]
    return [np.asarray(line.get_xydata()).tolist() for line in dashed]


def test_ocean_is_beneath(bay: Scene) -> None:
    assert plot_plan(bay).collections[0].get_array() is not None
