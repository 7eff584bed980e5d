"""Other people's solvers on our problems, for comparisons side by side.

`PEERS` names them. A peer gets the same problem as we do, the same time and one core, and is
used as strongly as its interface allows; how is said in its module. Its answer is worth what our
judge makes of it: a plan that he rejects is reported as such and counts nothing. Peers are no
dependency: an extra installs them, and nothing of ours is built on their answers.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from importlib import import_module
from importlib.metadata import version
from types import MappingProxyType

from fiveroute.check import check
from fiveroute.errors import InputError, MissingExtraError
from fiveroute.limits import Limits
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan

__all__ = ["PEERS", "Peer", "PeerAnswer", "ask", "require_peers"]


@dataclass(frozen=True, slots=True)
class Peer:
    """A solver of somebody else's.

    Parameters
    ----------
    module
        Ours, with ``plan(problem, limits, seed) -> Plan | None``.
    package
        Theirs, as it is installed.
    extra
        What of ours brings it; empty if it always comes with us.
    """

    module: str
    package: str
    extra: str = ""

    @property
    def version(self) -> str:
        """Version of the package."""
        return version(self.package)


PEERS: Mapping[str, Peer] = MappingProxyType(
    {
        "ortools": Peer("fiveroute.peers.ortools", "ortools"),
        "pyvrp": Peer("fiveroute.peers.pyvrp", "pyvrp", "peers"),
        "vroom": Peer("fiveroute.peers.vroom", "pyvroom", "vroom"),
    }
)
"""Peers by name."""


@dataclass(frozen=True, slots=True)
class PeerAnswer:
    """What a peer made of a problem.

    Parameters
    ----------
    objective
        Data that its plan collects, as we count it; None without a plan that the judge accepts.
    status
        ``feasible``, ``rejected`` by the judge, or ``no_solution``.
    seconds
        Wall-clock time, from our problem to its plan.
    violations
        Number of faults that the judge found.
    """

    objective: float | None
    status: str
    seconds: float
    violations: int = 0


def ask(name: str, problem: TeamOrienteering, limits: Limits, seed: int = 0) -> PeerAnswer:
    """Let a peer plan, and judge its plan.

    Parameters
    ----------
    name
        A name in `PEERS`.
    problem
        The problem.
    limits
        When to stop; peers need a time limit.
    seed
        Seed of its random numbers, where it has any.

    Raises
    ------
    InputError
        If there is no such peer, or no time limit.
    MissingExtraError
        If the peer is not installed.
    """
    require_peers([name], limits.time)
    solver = import_module(PEERS[name].module)
    clock = limits.start()
    plan: Plan | None = solver.plan(problem, limits, seed)
    seconds = clock.seconds
    if plan is None:
        return PeerAnswer(None, "no_solution", seconds)
    violations = check(problem, plan)
    if violations:
        return PeerAnswer(None, "rejected", seconds, len(violations))
    return PeerAnswer(plan.objective(problem), "feasible", seconds)


def require_peers(names: Iterable[str], time_limit: float) -> None:
    """Refuse peers that could not be asked, before any time is spent.

    Parameters
    ----------
    names
        Names in `PEERS`.
    time_limit
        Seconds; peers need a limit.

    Raises
    ------
    InputError
        If there is no such peer, or no time limit.
    MissingExtraError
        If a peer is not installed.
    """
    for name in names:
        if name not in PEERS:
            raise InputError(f"no such peer; choose {', '.join(PEERS)}", field="peer", value=name)
        if not math.isfinite(time_limit):
            raise InputError("a peer needs a time limit; state one", field="peer", value=name)
        peer = PEERS[name]
        try:
            import_module(peer.module)
        except ImportError:
            raise MissingExtraError(
                f"peer: {name!r}: needs {peer.package}; install fiveroute[{peer.extra}]"
            ) from None
