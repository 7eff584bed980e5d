"""Missions and plans from files, for people who call fiveroute from Python."""

from __future__ import annotations

from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

from fiveroute.errors import InputError
from fiveroute.fleet_plan import FleetPlan
from fiveroute.fleet_planning import sail
from fiveroute.instance import Instance
from fiveroute.limits import Limits
from fiveroute.paths.voyage import Voyage
from fiveroute.result import Result, Status
from fiveroute.routes import Plan

if TYPE_CHECKING:
    from fiveroute.formats.plan_file import PlanFile

__all__ = ["on_voyage", "read", "read_plan"]


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
    plan = on_voyage(filed, voyage)
    assert plan.result.plan is not None
    if violations := check(plan.problem, plan.result.plan):
        raise InputError(f"{violations[0]}; plan it anew", file=file, field="routes")
    return plan


def on_voyage(filed: PlanFile, voyage: Voyage) -> FleetPlan:
    """A plan from a file over the nodes that can be reached, on legs that are planned anew.

    Parameters
    ----------
    filed
        The plan. Its proof holds if it was made for the same kind of legs, along paths or straight.
    voyage
        The legs.
    """
    vertex = {node.id: k for k, node in enumerate(voyage.instance.nodes, start=1)}
    routes = Plan.of([vertex[name] for name in route if name in vertex] for route in filed.routes)
    problem = voyage.instance.problem(len(filed.routes), voyage.travel)
    is_same = (filed.paths is None) == (voyage.legs is None)
    status, bound = (filed.status, filed.bound) if is_same else (Status.FEASIBLE, None)
    result = Result(filed.method, status, routes, filed.objective, bound, 0.0, filed.seed)
    return FleetPlan.of(voyage, problem, result)


def _with_full_name(instance: Instance, source: Path) -> Instance:
    """An instance from a file, its file of currents named in full."""
    from fiveroute.formats.native import currents_file

    named = currents_file(instance, source.absolute())
    if named is None:
        return instance
    currents = replace(instance.ocean.currents, file=str(named))
    return replace(instance, ocean=replace(instance.ocean, currents=currents))
