"""Scenarios from a seed: the paper's, and three other layouts of the nodes.

The paper's region is 10 km x 10 km with 60 nodes (Section IV-A). It leaves start and
destination open; at (3, 5) km and (7, 5) km its published figures come out best.

Every kind of random number has a stream of its own, spawned from the seed, so that
scenarios that differ in one thing share everything else. Only the uniform numbers of PCG64
are used and all values are rounded, so that a file comes out the same on every machine.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from statistics import NormalDist

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.instance import (
    MAX_FLEET,
    Currents,
    Fleet,
    Instance,
    Node,
    Ocean,
    Point,
    Service,
    Uncertainty,
    Vortex,
)
from fiveroute.ocean.random_vortices import EFFECTIVE, PRINTED, VortexKind, draw_vortices, normal

__all__ = [
    "CURRENTS",
    "DEFAULT_UNCERTAINTY",
    "LAYOUTS",
    "generate",
    "paper_scenario",
    "scenario",
]

Positions = NDArray[np.float64]

SIDE = 10_000.0
"""Side of the square region in metres, Section IV-A."""

START, DESTINATION = Point(3000.0, 5000.0), Point(7000.0, 5000.0)
CENTRE = Point(5000.0, 5000.0)

PAPER_SERVICE = Service(delay=5.0, rate=20.0)
"""t_j = 5 + 20 rho_j seconds, equation (30)."""

DEFAULT_UNCERTAINTY = Uncertainty(
    drift=0.20, manoeuvres_per_km=0.5, manoeuvre_time=120.0, floor=0.2
)
"""The paper gives no figures for equation (12); with these, a fleet without coordination
loses 5 to 10 % of its data, as in the paper."""

CURRENTS = {"effective": EFFECTIVE, "printed": PRINTED, "none": None}
"""What the vortices are like: as printed, the field is too weak to matter."""

VORTICES = 20
"""Number of vortices, Section IV-A."""


def generate(
    layout: str = "paper",
    *,
    nodes: int = 60,
    seed: int = 0,
    fleet_size: int | None = None,
    currents: str = "effective",
) -> Instance:
    """Make a scenario by the name of its layout.

    Parameters
    ----------
    layout
        ``paper``, or one of `LAYOUTS`.
    nodes, seed, fleet_size
        See `paper_scenario` and `scenario`.
    currents
        One of `CURRENTS`, for the paper's layout only.
    """
    if layout == "paper":
        return paper_scenario(seed, nodes, currents, fleet_size)
    return scenario(layout, nodes, seed, fleet_size)


def paper_scenario(
    seed: int, nodes: int = 60, currents: str = "effective", fleet_size: int | None = None
) -> Instance:
    """One of the paper's random scenarios, Section IV-A.

    Parameters
    ----------
    seed
        Seed of the random numbers.
    nodes
        Number of sensor nodes, uniform over the region.
    currents
        One of `CURRENTS`: same centres and same signs in all of them.
    fleet_size
        Number of AUVs; None leaves it to the estimate of tier 1, as in the paper.
    """
    if currents not in CURRENTS:
        raise InputError(f"must be one of {', '.join(CURRENTS)}", field="currents", value=currents)
    _require_sizes(nodes, seed, fleet_size)
    where, data, field = _streams(seed, 3)
    kind = CURRENTS[currents]
    vortices = () if kind is None else _vortices(kind, field)
    return Instance(
        name=f"scenario-{seed:02d}",
        nodes=_nodes(_uniform(nodes, where), data),
        start=START,
        destination=DESTINATION,
        fleet=Fleet(fleet_size, 1.0, 18_000.0),
        service=PAPER_SERVICE,
        ocean=Ocean(Currents(vortices)),
        uncertainty=DEFAULT_UNCERTAINTY,
    )


def scenario(
    layout: str,
    nodes: int,
    seed: int,
    fleet_size: int | None = None,
    *,
    closed: bool = False,
    service: Service = PAPER_SERVICE,
    share: float = 0.8,
) -> Instance:
    """A scenario without currents, its endurance fitted to nodes and fleet.

    Parameters
    ----------
    layout
        One of `LAYOUTS`.
    nodes
        Number of sensor nodes.
    seed
        Seed of the random numbers.
    fleet_size
        Number of AUVs; None takes half the square root of the number of nodes.
    closed
        Whether start and destination coincide, in the middle of the region.
    service
        Time to collect data.
    share
        Endurance as a share of what the fleet would need for all nodes; with 0.8 it
        collects 80 to 95 % of the data.
    """
    if layout not in LAYOUTS:
        raise InputError(f"must be one of {', '.join(LAYOUTS)}", field="layout", value=layout)
    _require_sizes(nodes, seed, fleet_size)
    where, data = _streams(seed, 2)
    size = max(1, round(0.5 * math.sqrt(nodes))) if fleet_size is None else fleet_size
    instance = Instance(
        name=f"{layout}-{nodes}-{seed}",
        nodes=_nodes(LAYOUTS[layout](nodes, where), data),
        start=CENTRE if closed else START,
        destination=CENTRE if closed else DESTINATION,
        fleet=Fleet(size, 1.0, None),
        service=service,
        uncertainty=DEFAULT_UNCERTAINTY,
    )
    return _with_endurance(instance, share)


def _uniform(nodes: int, rng: np.random.Generator) -> Positions:
    """Anywhere in the region."""
    return np.multiply(SIDE, rng.random((nodes, 2)))


def _clustered(nodes: int, rng: np.random.Generator) -> Positions:
    """Around a few centres, normally distributed, cut off at the border."""
    clusters = max(1, round(0.5 * math.sqrt(nodes)))
    centres = SIDE * (0.1 + 0.8 * rng.random((clusters, 2)))
    spread = np.array([normal(u, NormalDist(0.0, 0.05 * SIDE)) for u in rng.random(2 * nodes)])
    chosen = np.arange(nodes) % clusters
    positions: Positions = np.clip(centres[chosen] + spread.reshape(nodes, 2), 0.0, SIDE)
    return positions


def _ring(nodes: int, rng: np.random.Generator) -> Positions:
    """In a ring around the middle, 3.5 to 4.5 km from it."""
    angle = 2.0 * math.pi * rng.random(nodes)
    radius = SIDE * (0.35 + 0.1 * rng.random(nodes))
    positions: Positions = SIDE / 2 + np.column_stack(
        [radius * np.cos(angle), radius * np.sin(angle)]
    )
    return positions


LAYOUTS: dict[str, Callable[[int, np.random.Generator], Positions]] = {
    "uniform": _uniform,
    "clustered": _clustered,
    "ring": _ring,
}
"""How nodes can lie: ``layout(nodes, rng)`` gives positions in metres, shape (nodes, 2)."""


def _require_sizes(nodes: int, seed: int, fleet_size: int | None) -> None:
    """Refuse sizes that no scenario can have."""
    for field, value, least, most in (
        ("nodes", nodes, 0, math.inf),
        ("seed", seed, 0, math.inf),
        ("fleet_size", fleet_size, 1, MAX_FLEET),
    ):
        if value is not None and not least <= value <= most:
            raise InputError(f"must be from {least} to {most}", field=field, value=value)


def _streams(seed: int, count: int) -> list[np.random.Generator]:
    """Independent streams of random numbers."""
    children = np.random.SeedSequence(seed).spawn(count)
    return [np.random.Generator(np.random.PCG64(child)) for child in children]


def _nodes(positions: Positions, rng: np.random.Generator) -> tuple[Node, ...]:
    """Sensor nodes "2", "3", ... with data uniform in (0, 1], all rounded."""
    amounts = np.maximum(np.round(1.0 - rng.random(len(positions)), 6), 1e-6)
    return tuple(
        Node(str(i), x, y, amount)
        for i, ((x, y), amount) in enumerate(
            zip(np.round(positions, 3).tolist(), amounts.tolist(), strict=True), start=2
        )
    )


def _vortices(kind: VortexKind, rng: np.random.Generator) -> tuple[Vortex, ...]:
    """Vortices with uniform centres, all rounded."""
    drawn = draw_vortices(kind, VORTICES, (0.0, 0.0, SIDE, SIDE), rng)
    parts = np.array([drawn.x, drawn.y, drawn.circulation, drawn.radius]).T.tolist()
    return tuple(Vortex(*(round(number, 3) for number in part)) for part in parts)


def _with_endurance(instance: Instance, share: float) -> Instance:
    """Give the fleet a share of what it needs for all nodes, in whole minutes.

    M routes that share a giant route of duration T_0 take T_0 + (M - 1) t together, where
    t is what a cut costs: a way to the destination and one from the start. An AUV can
    reach nine in ten nodes at least.
    """
    points = instance.points
    to_start, to_end = (np.hypot(*(points - end).T) for end in (points[0], points[-1]))
    detours = np.sort(to_start + to_end)  # the ends among them, at the direct distance
    size = instance.fleet_size or 1
    sailing = _giant_route_length(points) + (size - 1) * float(detours.mean())
    speed = instance.fleet.speed
    needed = sailing / speed + float(instance.service_times.sum())
    reach = float(detours[math.ceil(0.9 * len(detours)) - 1]) / speed
    minutes = math.ceil(max(share * needed / size, reach, 1.0) / 60.0)
    return replace(instance, fleet=replace(instance.fleet, endurance=60.0 * minutes))


def _giant_route_length(points: Positions) -> float:
    """Estimate from a space-filling curve, whose routes are some 37 % too long."""
    order = [0, *(_along_curve(points[1:-1]) + 1), len(points) - 1]
    return float(np.hypot(*np.diff(points[order], axis=0).T).sum()) / 1.37


def _along_curve(positions: Positions) -> NDArray[np.int64]:
    """Order of positions along Hilbert's curve on a grid of 2^16 x 2^16 cells."""
    x, y = np.minimum(positions / SIDE * 2**16, 2**16 - 1).astype(np.int64).T
    rank = np.zeros(len(positions), dtype=np.int64)
    for bit in range(15, -1, -1):
        right, upper = (x >> bit) & 1, (y >> bit) & 1
        rank = 4 * rank + ((3 * right) ^ upper)
        mirrored = (right == 1) & (upper == 0)
        x, y = np.where(mirrored, ~x, x), np.where(mirrored, ~y, y)
        x, y = np.where(upper == 0, y, x), np.where(upper == 0, x, y)
    return np.argsort(rank, kind="stable")
