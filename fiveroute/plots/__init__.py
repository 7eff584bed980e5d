"""Plans, currents and missions as matplotlib figures.

Every function `plot_*` draws on the axes that it is handed, or on new ones, and returns them, so
that pictures can be put together:

    figure, (left, right) = plt.subplots(1, 2)
    plot_plan(scene, left)
    plot_mission(scene, scene.runs[0], ax=right)

Distances are in kilometres (those of benchmark files as they are). AUVs have the colours of Okabe
and Ito (2008), which colour-blind readers can tell apart; more AUVs than colours have dashes.
"""

from __future__ import annotations

from fiveroute.plots.gap import plot_gap
from fiveroute.plots.mission import plot_mission, plot_plan
from fiveroute.plots.sea import plot_currents, plot_sea

__all__ = ["plot_currents", "plot_gap", "plot_mission", "plot_plan", "plot_sea"]
