"""fiveroute: plans for fleets of autonomous underwater vehicles, with their optimality gap.

    import fiveroute as fr

    plan = fr.plan(fr.read("sea.json"))
    print(plan)

The names below are all that most programs need; they are loaded when they are first used, so that
the command line starts quickly. The tiers, models and heuristics behind them are public as well.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from fiveroute.errors import FiverouteError, InputError
    from fiveroute.fleet_plan import FleetPlan
    from fiveroute.fleet_planning import plan, solve
    from fiveroute.fleet_runs import FleetRuns
    from fiveroute.fleet_sailing import simulate
    from fiveroute.instance import Fleet, Instance, Node, Point, Service
    from fiveroute.limits import Limits, Progress
    from fiveroute.problem import TeamOrienteering
    from fiveroute.reading import read, read_plan
    from fiveroute.result import Status

__version__ = "0.1.0"

__all__ = [
    "FiverouteError",
    "Fleet",
    "FleetPlan",
    "FleetRuns",
    "InputError",
    "Instance",
    "Limits",
    "Node",
    "Point",
    "Progress",
    "Service",
    "Status",
    "TeamOrienteering",
    "plan",
    "read",
    "read_plan",
    "simulate",
    "solve",
]

_HOMES = {
    "FiverouteError": "fiveroute.errors",
    "Fleet": "fiveroute.instance",
    "FleetPlan": "fiveroute.fleet_plan",
    "FleetRuns": "fiveroute.fleet_runs",
    "InputError": "fiveroute.errors",
    "Instance": "fiveroute.instance",
    "Limits": "fiveroute.limits",
    "Node": "fiveroute.instance",
    "Point": "fiveroute.instance",
    "Progress": "fiveroute.limits",
    "Service": "fiveroute.instance",
    "Status": "fiveroute.result",
    "TeamOrienteering": "fiveroute.problem",
    "plan": "fiveroute.fleet_planning",
    "read": "fiveroute.reading",
    "read_plan": "fiveroute.reading",
    "simulate": "fiveroute.fleet_sailing",
    "solve": "fiveroute.fleet_planning",
}


if not TYPE_CHECKING:  # a type checker knows the names above, and no others

    def __getattr__(name: str) -> object:
        if name not in _HOMES:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        value = getattr(import_module(_HOMES[name]), name)
        globals()[name] = value
        return value


def __dir__() -> list[str]:
    return sorted({*__all__, *(name for name in globals() if name.startswith("__"))})
