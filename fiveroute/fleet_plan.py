"""The plan of a fleet in its ocean, for people who call fiveroute from Python.

It knows its routes by the ids of the nodes, what they collect and how far that can be from optimal;
it can be saved, verified, looked at and exported.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

from fiveroute.instance import Instance
from fiveroute.paths.voyage import Voyage
from fiveroute.problem import TeamOrienteering, completion_rate
from fiveroute.result import Result, Status
from fiveroute.routes import Route

if TYPE_CHECKING:
    from fiveroute.formats.plan_file import PlanFile
    from fiveroute.mission import MissionPlan
    from fiveroute.ocean.currents import Current
    from fiveroute.vehicle_files import Choices
    from fiveroute.verdict import Verdict

__all__ = ["FleetPlan"]


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class FleetPlan:
    """Routes for a fleet, what they collect, and what is known about the optimum.

    Parameters
    ----------
    voyage
        The mission, its leg times, and the nodes that cannot be reached.
    problem
        The team orienteering problem that was solved, with the fleet that is sent.
    result
        What the method answered.
    pipeline
        How tiers 1 and 2 came to the plan; None for an exact method.
    """

    voyage: Voyage
    problem: TeamOrienteering
    result: Result
    pipeline: MissionPlan | None = None

    @classmethod
    def of(
        cls,
        voyage: Voyage,
        problem: TeamOrienteering,
        result: Result,
        pipeline: MissionPlan | None = None,
    ) -> FleetPlan:
        """What a method answered on the legs of a voyage; no proof where some are still open."""
        if not voyage.is_complete:
            status = Status.NO_SOLUTION if result.plan is None else Status.FEASIBLE
            result = replace(result, status=status, bound=None)
        return cls(voyage, problem, result, pipeline)

    @property
    def instance(self) -> Instance:
        """The mission as it was stated."""
        return self.voyage.mission

    @property
    def status(self) -> Status:
        """How the method ended."""
        return self.result.status

    @property
    def objective(self) -> float | None:
        """Data that the plan collects; None without a plan."""
        return self.result.objective

    @property
    def bound(self) -> float | None:
        """Proven upper bound on the data that any plan collects; None where none was computed."""
        return self.result.bound

    @property
    def gap(self) -> float | None:
        """(bound - objective) / objective; 0 for a plan that is proved optimal."""
        return self.result.gap

    @property
    def completion_rate(self) -> float | None:
        """Theta, equation (31): collected data over all data, nodes out of reach included."""
        if self.objective is None:
            return None
        return completion_rate(self.objective, self.instance.total_data)

    @property
    def fleet_size(self) -> int:
        """Number of AUVs."""
        return self.problem.fleet_size

    @property
    def routes(self) -> list[list[str]]:
        """Ids of the nodes that each AUV visits, in order, without start and destination."""
        if self.result.plan is None:
            return []
        return [self._named(route) for route in self.result.plan.routes]

    @property
    def durations(self) -> list[float]:
        """Travel and service time of every route in seconds."""
        if self.result.plan is None:
            return []
        if self.voyage.hasty is None:
            return list(self.result.plan.durations(self.problem))
        return [self._sailed(route, self.voyage.hasty) for route in self.result.plan.routes]

    def _sailed(self, route: Route, current: Current) -> float:
        """Seconds along the paths of a route, which the problem overstates a little."""
        from fiveroute.check_paths import sailing_time

        legs, speed = self.voyage.legs, self.instance.fleet.speed
        assert legs is not None
        stops = itertools.pairwise((0, *route, self.problem.destination))
        sailed = sum(sailing_time(legs.track(*leg), current, speed) for leg in stops)
        return sailed + float(self.problem.service[list(route)].sum())

    @property
    def unreachable(self) -> tuple[str, ...]:
        """Ids of the nodes that no AUV can reach, or from which none gets home."""
        return self.voyage.unreachable

    def filed(self) -> PlanFile:
        """The plan as a file holds it.

        Raises
        ------
        InputError
            If there is no plan.
        """
        from fiveroute.formats.plan_file import PlanFile

        voyage = self.voyage
        filed = PlanFile.of(voyage.instance, self.problem, self.result, voyage.legs)
        return replace(filed, instance=voyage.mission, durations=tuple(self.durations))

    def save(
        self, path: str | PathLike[str], *, force: bool = False, source: Path | None = None
    ) -> None:
        """Write the plan to a file of its own, whole or not at all.

        Parameters
        ----------
        path
            The file.
        force
            Overwrite an existing file.
        source
            File that the instance comes from, where a name in it is relative.

        Raises
        ------
        InputError
            If there is no plan, or the file exists already.
        """
        from fiveroute.formats.plan_file import write_plan

        target = Path(path)
        write_plan(self.filed(), target, force, source=source or target)

    def verify(self, folder: Path | None = None) -> Verdict:
        """Ask the judge of plan files, who shares nothing with the planners.

        Parameters
        ----------
        folder
            Folder that the name of the instance's file of currents is relative to.
        """
        from fiveroute.verdict import judge

        straight = self.voyage.legs is None
        return judge(self.instance, self.filed(), folder, straight_lines=straight)

    def view(
        self,
        path: str | PathLike[str] | None = None,
        *,
        force: bool = False,
        folder: Path | None = None,
    ) -> Path:
        """Write a page that plays the plan, a picture, or a film, and return its file.

        Parameters
        ----------
        path
            The file, .html, .png, .svg, .pdf or .gif; None opens a page in the browser.
        force
            Overwrite an existing file.
        folder
            Folder that the name of the instance's file of currents is relative to.
        """
        from fiveroute.view.looks import show_look
        from fiveroute.view.scene import scene_of

        return show_look([scene_of(self.filed(), folder)], path, force=force)

    def export(
        self,
        format_name: str,
        path: str | PathLike[str],
        choices: Choices | None = None,
        *,
        force: bool = False,
    ) -> None:
        """Write the plan for vehicles or map programs, or refuse an unsafe one.

        Parameters
        ----------
        format_name
            One of `fiveroute.vehicle_files.VEHICLE_FORMATS`.
        path
            File or folder.
        choices
            What the plan leaves open: depth, origin, names of the vehicles, departure.
        force
            Overwrite what is there.

        Raises
        ------
        InputError
            If the plan crosses land, dives too deep, takes too long, or the format cannot hold it.
        """
        from fiveroute.vehicle_files import export_plan

        target = Path(path)
        export_plan(self.filed(), target, format_name, target, choices, force)

    def _repr_html_(self) -> str:
        """A small map and a table, for notebooks."""
        from fiveroute.view.notebook import no_plan_html, plan_html

        if self.result.plan is None:
            return no_plan_html(self.instance.name, self.status)
        return plan_html(self.filed())

    def __repr__(self) -> str:
        """Its first line: the mission alone has thousands of numbers."""
        return f"<{type(self).__name__} {self._headline()}>"

    def __str__(self) -> str:
        """A line an AUV, and the figures that matter."""
        lines = [
            f"AUV {auv}: {' '.join(route) or 'straight home'} ({duration:.0f} s)"
            for auv, (route, duration) in enumerate(
                zip(self.routes, self.durations, strict=True), start=1
            )
        ]
        return "\n".join([self._headline(), *lines])

    def _headline(self) -> str:
        figures = [f"{self.instance.name}: {self.status}"]
        if self.objective is not None:
            figures.append(f"{self.objective:.6g} collected ({self.completion_rate:.1%})")
        if self.gap is not None:
            figures.append(f"gap {self.gap:.2%}")
        return ", ".join(figures)

    def _named(self, route: tuple[int, ...]) -> list[str]:
        nodes = self.voyage.instance.nodes
        return [nodes[vertex - 1].id for vertex in route]
