"""A plan: one route for every AUV."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from fiveroute.problem import TeamOrienteering

__all__ = ["Plan", "Route"]

Route = tuple[int, ...]
"""Sensor nodes (vertices 1 to n) in the order of the visits, without the two ends."""


@dataclass(frozen=True, slots=True)
class Plan:
    """Routes R_1 to R_M, one per AUV, in the order of the problem's budgets."""

    routes: tuple[Route, ...]

    @classmethod
    def of(cls, routes: Iterable[Iterable[int]]) -> Plan:
        """Build a plan from any nested iterables of vertex numbers."""
        return cls(tuple(tuple(int(node) for node in route) for route in routes))

    @classmethod
    def empty(cls, fleet_size: int) -> Plan:
        """Every AUV goes straight to the destination."""
        return cls(((),) * fleet_size)

    @property
    def visited(self) -> frozenset[int]:
        """All sensor nodes on some route."""
        return frozenset(node for route in self.routes for node in route)

    def objective(self, problem: TeamOrienteering) -> float:
        """Collected data J, equation (2); every node counts once."""
        return problem.collected(sorted(self.visited))

    def durations(self, problem: TeamOrienteering) -> tuple[float, ...]:
        """Travel plus service time of every route, in seconds."""
        return tuple(problem.duration(route) for route in self.routes)

    def idle(self, problem: TeamOrienteering) -> tuple[int, ...]:
        """Sensor nodes on no route, in ascending order."""
        return tuple(sorted(set(range(1, problem.n + 1)) - self.visited))
