from dataclasses import replace

import numpy as np
import pytest
from matplotlib.collections import QuadMesh
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon

from fiveroute.plots import plot_currents, plot_sea
from fiveroute.view.scene import Scene


def test_speed_is_the_charts(bay: Scene) -> None:
    assert bay.chart is not None
    own = Figure().subplots()
    ax = plot_currents(bay.chart, own)
    assert ax is own
    (mesh,) = (artist for artist in ax.collections if isinstance(artist, QuadMesh))
    uv = bay.chart.uv[0]
    assert np.asarray(mesh.get_array()).ravel() == pytest.approx(np.hypot(*uv.T).T.ravel())


def test_what_lies_in_the_sea_is_drawn_in_kilometres(bay: Scene) -> None:
    ax = plot_sea(bay, currents=False)
    (circle,) = (patch for patch in ax.patches if isinstance(patch, Circle))
    assert (*circle.center, circle.radius) == pytest.approx((3.0, 1.5, 0.2))
    assert sum(isinstance(patch, Polygon) for patch in ax.patches) == 2
    assert ax.get_xlim() == pytest.approx((bay.region.west / 1e3, bay.region.east / 1e3))
    assert ax.get_xlabel() == "x in km"


def test_units_of_benchmark_files_stay(pond: Scene) -> None:
    plan = replace(pond.plan, instance=replace(pond.instance, metric="EUC_2D"))
    ax = plot_sea(replace(pond, plan=plan))
    assert ax.get_xlabel() == "x"
    assert ax.get_xlim()[1] == pytest.approx(pond.region.east)
