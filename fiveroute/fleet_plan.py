"""Plans of a fleet in its ocean, for people who call fiveroute from Python.

    import fiveroute as fr

    plan = fr.plan(fr.read("sea.json"))
    print(plan)
    plan.save("plan.json")

`plan` and `solve` do what the commands of the same names do: the legs are planned in the ocean of
the instance first (tier 3), then the fleet (tiers 1 and 2, or an exact method). What they return
knows its routes by the ids of the nodes, and how far it can be from optimal.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

from fiveroute.errors import InputError
from fiveroute.instance import Instance
from fiveroute.limits import Limits, ProgressCallback
from fiveroute.paths.voyage import Voyage
from fiveroute.problem import TeamOrienteering, completion_rate
from fiveroute.result import Result, Status
from fiveroute.routes import Plan, Route

if TYPE_CHECKING:
    from fiveroute.formats.plan_file import PlanFile
    from fiveroute.mission import Bounding, MissionPlan, Search
    from fiveroute.ocean.currents import Current
    from fiveroute.tiers.preplanning import Allocation
    from fiveroute.vehicle_files import Choices
    from fiveroute.verdict import Verdict

__all__ = ["FleetPlan", "plan", "reachable_routes", "read", "read_plan", "sail", "solve"]

_SHARE_OF_PATHS = 0.5
"""Share of a time limit that planning the paths may take."""


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
    def of(cls, voyage: Voyage, planned: MissionPlan) -> FleetPlan:
        """What tiers 1 and 2 came to on the legs of a voyage."""
        return cls(voyage, planned.problem, _known(voyage, planned.result), planned)

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
        from fiveroute.view.looks import require_look, write_look
        from fiveroute.view.scene import scene_of

        scenes = [scene_of(self.filed(), folder)]
        if path is not None:
            target = Path(path)
            require_look(target)
            write_look(scenes, target, force=force)
            return target
        import tempfile
        import webbrowser

        page = Path(tempfile.mkdtemp(prefix="fiveroute-")) / "plan.html"
        write_look(scenes, page)
        webbrowser.open(page.as_uri())
        return page

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


def read(path: str | PathLike[str], format_name: str | None = None) -> Instance:
    """Read an instance of any format; its file of currents is named in full.

    Parameters
    ----------
    path
        The file.
    format_name
        Name of its format; None goes by what it holds.

    Raises
    ------
    InputError
        If the file cannot be read, with the line or field, the rule and the remedy.
    """
    from fiveroute.formats import read_instance

    return _with_full_name(read_instance(Path(path), format_name), Path(path))


def read_plan(path: str | PathLike[str], *, limits: Limits | float | None = None) -> FleetPlan:
    """Read a plan that was saved; its legs are planned again, unless this machine has kept them.

    Parameters
    ----------
    path
        The file.
    limits
        Seconds, or limits, of planning the legs.

    Raises
    ------
    InputError
        If the file is no valid plan, or its routes break a rule.
    """
    from fiveroute.check import check
    from fiveroute.formats.plan_file import read_plan as read_file

    file = Path(path)
    filed = read_file(file)
    filed.require_currents(file.parent)
    mission = _with_full_name(filed.instance, file)
    voyage = sail(mission, straight_lines=filed.paths is None, limits=Limits.of(limits))
    known = {node.id for node in voyage.instance.nodes}
    strange = [name for route in filed.routes for name in route if name not in known]
    if strange:
        raise InputError(
            "is no node that an AUV can reach", file=file, field="routes", value=strange[0]
        )
    routes = reachable_routes(filed, voyage)
    problem = voyage.instance.problem(len(filed.routes), voyage.travel)
    if violations := check(problem, routes):
        raise InputError(f"{violations[0]}; plan it anew", file=file, field="routes")
    result = Result(
        filed.method, filed.status, routes, filed.objective, filed.bound, 0.0, filed.seed
    )
    return FleetPlan(voyage, problem, _known(voyage, result))


def reachable_routes(filed: PlanFile, voyage: Voyage) -> Plan:
    """The routes of a plan file over the nodes that can be reached."""
    vertex = {node.id: k for k, node in enumerate(voyage.instance.nodes, start=1)}
    return Plan.of([vertex[name] for name in route if name in vertex] for route in filed.routes)


def _with_full_name(instance: Instance, source: Path) -> Instance:
    """An instance from a file, its file of currents named in full."""
    from fiveroute.formats.native import currents_file

    named = currents_file(instance, source.absolute())
    if named is None:
        return instance
    currents = replace(instance.ocean.currents, file=str(named))
    return replace(instance, ocean=replace(instance.ocean, currents=currents))


def sail(
    instance: Instance,
    *,
    folder: Path | None = None,
    straight_lines: bool = False,
    limits: Limits | None = None,
    seed: int = 0,
    progress: ProgressCallback | None = None,
) -> Voyage:
    """Plan the legs of a mission in its ocean, or take straight lines where it has none.

    Parameters
    ----------
    instance
        The mission.
    folder
        Folder that the name of its file of currents is relative to.
    straight_lines
        Whether to ignore the ocean.
    limits
        Limits of all the work; the legs take half of the time at most.
    seed
        Seed of the random numbers.
    progress
        Told how many paths are planned.
    """
    if not isinstance(instance, Instance):
        raise InputError(
            "is no mission; read its file first, fiveroute.read(path)",
            field="instance",
            value=instance,
        )
    if straight_lines or not instance.has_ocean:
        return Voyage.straight(instance)
    from fiveroute.tiers.pathing import at_sea

    limits = limits or Limits()
    until = limits.within(_SHARE_OF_PATHS * limits.time)
    return at_sea(instance, folder, limits=until, seed=seed, progress=progress)


def plan(
    instance: Instance,
    *,
    fleet_size: int | None = None,
    search: Search = "fleet",
    bound: Bounding = "quick",
    allocation: Allocation = "giant-route",
    samples: int = 0,
    quantile: float | None = None,
    straight_lines: bool = False,
    limits: Limits | float | None = None,
    seed: int = 0,
    workers: int = 1,
    progress: ProgressCallback | None = None,
    folder: Path | None = None,
) -> FleetPlan:
    """Plan a fleet: how many AUVs, the route of each, and how far from optimal.

    Parameters
    ----------
    instance
        The mission.
    fleet_size
        Number of AUVs; None takes that of the instance, or else estimates it by (17).
    search
        ``fleet``, or the paper's pipeline alone.
    bound
        Where the upper bound comes from: ``none``, ``quick``, or ``exact``, which may improve
        the plan as well.
    allocation
        How the paper's pipeline first shares the nodes out.
    samples, quantile
        Number of sampled leg times to plan with, for the search ``paper``, and the quantile of
        a route's time that must fit the endurance; None takes their mean.
    straight_lines
        Whether to ignore the ocean.
    limits
        Seconds, or limits; None lets every search end by itself.
    seed
        Seed of the random numbers; without a time limit it determines the plan.
    workers
        Number of threads of the fleet search; the plan does not depend on it.
    progress
        Called as the work goes on.
    folder
        Folder that the name of the instance's file of currents is relative to.

    Raises
    ------
    InputError
        If the options contradict each other, a stop lies on land, or no fleet size is stated
        and none can be estimated.
    """
    from fiveroute.mission import plan_mission

    clock = Limits.of(limits).start()
    voyage = sail(
        instance,
        folder=folder,
        straight_lines=straight_lines,
        limits=clock.limits,
        seed=seed,
        progress=progress,
    )
    planned = plan_mission(
        voyage.instance,
        travel=voyage.travel,
        fleet_size=fleet_size,
        allocation=allocation,
        search=search,
        bound=bound,
        samples=samples,
        quantile=quantile,
        limits=clock.rest(),
        seed=seed,
        workers=workers,
        progress=progress,
    )
    return FleetPlan.of(voyage, planned)


def solve(
    instance: Instance,
    *,
    method: str = "auto",
    fleet_size: int | None = None,
    straight_lines: bool = False,
    limits: Limits | float | None = None,
    seed: int = 0,
    progress: ProgressCallback | None = None,
    folder: Path | None = None,
) -> FleetPlan:
    """The best plan with a proof, or the best plan and bound in the time given.

    Parameters
    ----------
    instance
        The mission.
    method
        A name in `fiveroute.models.METHODS`, or ``auto``.
    fleet_size
        Number of AUVs; None takes that of the instance.
    straight_lines
        Whether to ignore the ocean.
    limits
        Seconds, or limits; None goes on until the plan is proved.
    seed
        Seed of the search for the plan that the proof starts from.
    progress
        Told of better plans and bounds.
    folder
        Folder that the name of the instance's file of currents is relative to.
    """
    from fiveroute.exact import solve_from_good_plan

    clock = Limits.of(limits).start()
    voyage = sail(
        instance,
        folder=folder,
        straight_lines=straight_lines,
        limits=clock.limits,
        seed=seed,
        progress=progress,
    )
    problem = voyage.instance.problem(fleet_size, voyage.travel)
    result = solve_from_good_plan(problem, method, clock.rest(), seed=seed, progress=progress)
    return FleetPlan(voyage, problem, _known(voyage, result))


def _known(voyage: Voyage, result: Result) -> Result:
    """A result without its proof where an interruption left legs open."""
    if voyage.is_complete:
        return result
    status = Status.NO_SOLUTION if result.plan is None else Status.FEASIBLE
    return replace(result, status=status, bound=None)
