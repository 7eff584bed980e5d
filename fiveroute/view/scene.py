"""All that a picture of a plan shows, in metres and seconds."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from fiveroute.errors import InputError
from fiveroute.formats.plan_file import PlanFile
from fiveroute.instance import Currents, Instance
from fiveroute.ocean.current_grid import Region
from fiveroute.ocean.currents import Superposition
from fiveroute.ocean.stated import stated_current
from fiveroute.routes import Plan
from fiveroute.view.chart import Chart, chart_of, region_of, seen_current
from fiveroute.view.event_log import RunLog
from fiveroute.view.timed_legs import Leg, Shapes, planned_legs, shapes_of

__all__ = ["Scene", "scene_of"]

_HELD = "The current changes with time; the plan takes it as it is when the mission begins."
_IGNORED = "The plan ignores the current: straight lines in still water."
_STRAIGHT = (
    "Where a run leaves the planned paths, its legs are drawn straight and in pieces, even across "
    "land: the log tells stops and times, not positions. `simulate --tracks` tells the rest."
)


@dataclass(frozen=True, slots=True, eq=False)
class Scene:
    """A plan laid out to be looked at.

    Parameters
    ----------
    plan
        The plan as filed.
    routes
        Its routes as vertices.
    region
        The rectangle that holds everything.
    chart
        The sea; None where there is none, or its file is not at hand.
    shapes
        The planned paths.
    legs
        The planned legs of every AUV.
    runs
        Logs of simulated runs.
    notes
        What the viewer should know, a sentence each.
    title
        What it is called beside another.
    """

    plan: PlanFile
    routes: Plan
    region: Region
    chart: Chart | None
    shapes: Shapes
    legs: tuple[tuple[Leg, ...], ...]
    runs: tuple[RunLog, ...] = ()
    notes: tuple[str, ...] = ()
    title: str = ""

    @property
    def instance(self) -> Instance:
        """The mission."""
        return self.plan.instance

    @property
    def duration(self) -> float:
        """When the last AUV is home, in the plan or any run, or its last event, in seconds."""
        ends = [legs[-1].done for legs in self.legs if legs]
        return max([*ends, *(run.events[-1].t for run in self.runs)], default=0.0)


def scene_of(
    plan: PlanFile,
    folder: Path | None = None,
    *,
    runs: tuple[RunLog, ...] = (),
    title: str = "",
) -> Scene:
    """Lay a plan out.

    Parameters
    ----------
    plan
        The plan.
    folder
        Folder that the name of its file of currents is relative to.
    runs
        Logs of simulated runs of it, see `fiveroute.view.event_log`.
    title
        What it is called beside another; empty takes the name of its instance.

    Raises
    ------
    InputError
        If a route names a node that the instance does not have.
    """
    routes = plan.plan
    ends = len(plan.instance.nodes) + 1
    unknown = plan.vertex_names[ends + 1 :]
    if unknown:
        raise InputError("is no node of the instance; correct it", field="routes", value=unknown[0])
    current, notes = _current(plan, folder)
    shapes = shapes_of(plan, routes, current)
    sailed = [track[:, :2] for run in runs for track in run.tracks or ()]
    region = region_of(plan.instance, [*(shape.points for shape in shapes.paths), *sailed])
    chart = None
    if current is not None:
        chart = chart_of(current, region, max(plan.durations, default=0.0))
        if len(chart.times) > 1:
            notes.append(_HELD)
    if shapes.paths and any(run.tracks is None for run in runs):
        notes.append(_STRAIGHT)
    return Scene(
        plan,
        routes,
        region,
        chart,
        shapes,
        planned_legs(plan, routes, current),
        runs,
        tuple(notes),
        title or plan.instance.name,
    )


def _current(plan: PlanFile, folder: Path | None) -> tuple[Superposition | None, list[str]]:
    """The current, or why there is none to be drawn."""
    if plan.instance.ocean.currents == Currents():
        return None, []
    try:
        plan.require_currents(folder or Path())
        current = stated_current(plan.instance, folder)
    except InputError as error:
        return None, [f"The current is not drawn: {error}."]
    return seen_current(current), [] if plan.paths is not None else [_IGNORED]
