"""Exact methods: a proof, or the best plan and bound that the time allows.

`METHODS` names them. Each has the signature

    method(problem, limits, *, warm_start=None, routes=(), progress=None) -> Result

and is imported when it is first called, so that importing this package costs nothing.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from importlib import import_module
from types import MappingProxyType
from typing import cast

from fiveroute.errors import InputError
from fiveroute.limits import Limits, ProgressCallback
from fiveroute.problem import TeamOrienteering
from fiveroute.result import Result
from fiveroute.routes import Plan, Route

__all__ = ["METHODS", "Method", "choose", "solve"]


@dataclass(frozen=True, slots=True)
class Method:
    """An exact method, known by its module until it is called.

    Parameters
    ----------
    module
        Where it is.
    takes_routes
        Whether it can make use of good routes.
    """

    module: str
    takes_routes: bool = False

    def __call__(
        self,
        problem: TeamOrienteering,
        limits: Limits | float | None = None,
        *,
        warm_start: Plan | None = None,
        routes: Sequence[Route] = (),
        progress: ProgressCallback | None = None,
    ) -> Result:
        """Solve the problem, its data counted in a unit that fits them."""
        from fiveroute.models.data_unit import in_fitting_unit

        _require_problem(problem)
        limits = Limits.of(limits)
        method = import_module(self.module)
        known = {"routes": routes} if self.takes_routes else {}

        def run(problem: TeamOrienteering, progress: ProgressCallback | None) -> Result:
            result = method.solve(
                problem, limits, warm_start=warm_start, progress=progress, **known
            )
            return cast(Result, result)

        return in_fitting_unit(run, problem, progress)

    def supports(self, problem: TeamOrienteering) -> bool:
        """Whether the method takes such a problem."""
        return bool(import_module(self.module).supports(problem))


def _require_problem(problem: object) -> None:
    if not isinstance(problem, TeamOrienteering):
        raise InputError(
            "is no TeamOrienteering problem; an instance makes one, instance.problem()",
            field="problem",
            value=problem,
        )


METHODS: Mapping[str, Method] = MappingProxyType(
    {
        "branch-price": Method("fiveroute.models.branch_price", takes_routes=True),
        "brute-force": Method("fiveroute.models.brute_force"),
        "circuit": Method("fiveroute.models.circuit"),
        "compact": Method("fiveroute.models.compact"),
        "enumeration": Method("fiveroute.models.enumeration"),
        "flow": Method("fiveroute.models.flow"),
    }
)
"""Exact methods by name."""

_FEW_NODES, _MANY_NODES = 40, 500


def choose(problem: TeamOrienteering) -> str:
    """Name of the method to expect most of.

    Column generation up to 500 nodes; flow beyond, and for the one long route of a single AUV
    over more than 40 nodes. With 10 to 30 nodes and up to 3 AUVs column generation takes a
    tenth of the time of the flow model and of circuits.
    """
    most = _FEW_NODES if problem.fleet_size == 1 else _MANY_NODES
    return "branch-price" if problem.n <= most else "flow"


def solve(
    problem: TeamOrienteering,
    method: str = "auto",
    limits: Limits | float | None = None,
    *,
    warm_start: Plan | None = None,
    routes: Sequence[Route] = (),
    progress: ProgressCallback | None = None,
) -> Result:
    """Solve a problem with the method of that name, and shorten the routes it found.

    Parameters
    ----------
    problem
        The problem.
    method
        A name in `METHODS`, or ``auto`` for what `choose` says; the result names it.
    limits
        Seconds, or limits; None goes on until the plan is proved.
    warm_start
        A plan to start from; one that the judge rejects is left aside.
    routes
        Good routes, for methods that can make use of them; late ones are left aside.
    progress
        Told of better plans and bounds.

    Raises
    ------
    InputError
        If there is no such method, it does not take such a problem, or that is none.
    """
    _require_problem(problem)
    name = choose(problem) if method == "auto" else method
    if name not in METHODS:
        raise InputError(
            f"no such method; choose auto, {', '.join(METHODS)}", field="method", value=method
        )
    result = METHODS[name](problem, limits, warm_start=warm_start, routes=routes, progress=progress)
    if result.plan is None:
        return result
    from fiveroute.models.shorten import shortened

    return replace(result, plan=shortened(problem, result.plan))
