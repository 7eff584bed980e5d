"""The pure combinatorial problem: team orienteering with service times.

This is all that `fiveroute.models` and `fiveroute.heuristics` see. Vertex 0 is the start
N_1 of the paper, vertices 1 to n are its sensor nodes, from N_2 on, and vertex n + 1 is the
destination, the last of its N. Times are in seconds and may be asymmetric: a current makes the
way back longer than the way out. Nothing is assumed about the triangle inequality.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fiveroute.errors import InputError

__all__ = ["TIME_TOLERANCE", "TeamOrienteering", "completion_rate"]

TIME_TOLERANCE = 1e-9
"""Relative excess over a budget that is put down to rounding, not to the route."""


def completion_rate(collected: float, total: float) -> float:
    """Theta, equation (31): collected data over all data; where there is none, all of it."""
    return collected / total if total > 0.0 else 1.0


@dataclass(frozen=True, slots=True, eq=False)
class TeamOrienteering:
    """A team orienteering problem; all arrays are read-only copies.

    Every AUV sails exactly one route from start to destination, visits each sensor node
    at most once over the fleet, and keeps within its own budget, constraints (3) to (8)
    of the paper. An empty route is the direct leg, and it too must fit the budget.

    Parameters
    ----------
    travel
        Leg times t_ij in seconds, shape (n + 2, n + 2), finite and non-negative; the
        diagonal is ignored and stored as zero.
    service
        Service times t_j in seconds, shape (n + 2,); zero at start and destination.
    profit
        Data rho_j, shape (n + 2,); zero at start and destination.
    budgets
        Time limit T_max,m of every AUV in seconds, shape (M,), M at least 1.
    """

    travel: NDArray[np.float64]
    service: NDArray[np.float64]
    profit: NDArray[np.float64]
    budgets: NDArray[np.float64]

    def __init__(
        self, travel: ArrayLike, service: ArrayLike, profit: ArrayLike, budgets: ArrayLike
    ) -> None:
        legs = np.array(travel, dtype=np.float64)
        if legs.ndim != 2 or legs.shape[0] != legs.shape[1] or legs.shape[0] < 2:
            raise InputError(
                "leg times must be a square matrix over start, nodes and destination",
                field="travel",
                value=legs.shape,
            )
        np.fill_diagonal(legs, 0.0)
        size = (legs.shape[0],)
        for name, values, shape in (
            ("travel", legs, legs.shape),
            ("service", np.array(service, dtype=np.float64), size),
            ("profit", np.array(profit, dtype=np.float64), size),
            ("budgets", np.array(budgets, dtype=np.float64), None),
        ):
            _require_non_negative(name, values, shape)
            values.setflags(write=False)
            object.__setattr__(self, name, values)
        for name in ("service", "profit"):
            ends = getattr(self, name)[[0, -1]]
            if ends.any():
                raise InputError(
                    f"start and destination have no {name}; set both ends to 0",
                    field=name,
                    value=ends.tolist(),
                )

    @property
    def n(self) -> int:
        """Number of sensor nodes."""
        return len(self.travel) - 2

    @property
    def fleet_size(self) -> int:
        """Number M of AUVs."""
        return len(self.budgets)

    @property
    def destination(self) -> int:
        """Index of the destination vertex, n + 1."""
        return len(self.travel) - 1

    @property
    def total_profit(self) -> float:
        """Data of all sensor nodes together, the denominator of theta in (31)."""
        return float(self.profit.sum())

    @property
    def allowed(self) -> NDArray[np.float64]:
        """Budgets with the rounding tolerance added: what every feasibility test uses."""
        return self.budgets + TIME_TOLERANCE * np.maximum(1.0, self.budgets)

    @property
    def is_symmetric(self) -> bool:
        """Whether every leg takes the same time in both directions."""
        return bool(np.array_equal(self.travel, self.travel.T))

    @property
    def has_equal_budgets(self) -> bool:
        """Whether the AUVs are interchangeable (Assumption 1 of the paper)."""
        return bool((self.budgets == self.budgets[0]).all())

    def duration(self, route: Sequence[int]) -> float:
        """Travel and service time in seconds of one route, the left side of (6).

        Parameters
        ----------
        route
            Sensor nodes in the order of the visits, without start and destination.
        """
        stops = np.array([0, *route, self.destination])
        return float(self.travel[stops[:-1], stops[1:]].sum() + self.service[stops].sum())

    def collected(self, route: Sequence[int]) -> float:
        """Data collected on one route."""
        return float(self.profit[list(route)].sum()) if len(route) else 0.0

    def with_budgets(self, budgets: ArrayLike) -> TeamOrienteering:
        """The same nodes for another fleet."""
        return replace(self, budgets=np.array(budgets, dtype=np.float64))


def _require_non_negative(
    name: str, values: NDArray[np.float64], shape: tuple[int, ...] | None
) -> None:
    if shape is None:
        if values.ndim != 1 or values.size < 1:
            raise InputError(
                "one budget per AUV, and at least one AUV", field=name, value=values.shape
            )
    elif values.shape != shape:
        raise InputError(f"shape must be {shape}", field=name, value=values.shape)
    wrong = ~(np.isfinite(values) & (values >= 0.0))
    if wrong.any():
        where = tuple(int(i) for i in np.argwhere(wrong)[0])
        raise InputError(
            "must be finite and not negative",
            field=f"{name}[{', '.join(map(str, where))}]",
            value=float(values[where]),
        )
