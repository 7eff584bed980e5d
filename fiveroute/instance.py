"""A mission as the user states it: nodes, fleet, ocean and uncertainty.

SI units throughout: metres, seconds, metres per second; x east, y north. Every class here
is frozen and validates itself, whether it is read from a file or built in Python. The
solvers never see an instance: they see the `TeamOrienteering` problem it turns into.
"""

from __future__ import annotations

import math
import re
from numbers import Integral
from typing import Annotated, TypeVar

import numpy as np
from numpy.typing import NDArray
from pydantic import (
    AfterValidator,
    ConfigDict,
    Discriminator,
    Field,
    NonNegativeFloat,
    PositiveFloat,
    Tag,
)
from pydantic.dataclasses import dataclass

from fiveroute.errors import InputError
from fiveroute.metric import Metric, distances
from fiveroute.problem import TeamOrienteering

__all__ = [
    "MAX_FLEET",
    "TURNING_RADIUS",
    "Circle",
    "Currents",
    "Fleet",
    "Instance",
    "Many",
    "Node",
    "Ocean",
    "Point",
    "Polygon",
    "Service",
    "Uncertainty",
    "Uniform",
    "Vortex",
]

MAX_FLEET = 10_000
"""Most AUVs in a fleet: a slip of the keyboard must not fill the memory."""

TURNING_RADIUS = 10.0
"""Least radius in metres of a turn of a torpedo-shaped AUV two metres long."""

T = TypeVar("T")

Many = Annotated[tuple[T, ...], Field(fail_fast=True)]
"""Any number of them, up to the first that is wrong: ten million faults would fill the memory."""

_STRICT = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False)


@dataclass(frozen=True, slots=True, config=_STRICT)
class Point:
    """A position in metres."""

    x: float
    y: float


@dataclass(frozen=True, slots=True, config=_STRICT)
class Node:
    """A sensor node.

    Parameters
    ----------
    id
        Its name, unique in the instance.
    x, y
        Position in metres.
    data
        Amount of data rho_j.
    service_time
        Time t_j in seconds to collect it; None leaves it to `Service`.
    depth
        Where an AUV collects it, in metres, positive down; None leaves it to `Fleet.depth`.
        Plans do not depend on it, files for vehicles do.
    """

    id: Annotated[str, Field(min_length=1)]
    x: float
    y: float
    data: NonNegativeFloat
    service_time: NonNegativeFloat | None = None
    depth: NonNegativeFloat | None = None


def _endurance_kind(value: object) -> str:
    return "each" if isinstance(value, (list, tuple)) else "all"


_Endurance = Annotated[
    Annotated[PositiveFloat, Tag("all")]
    | Annotated[Many[PositiveFloat], Field(min_length=1, max_length=MAX_FLEET), Tag("each")],
    Discriminator(_endurance_kind),
]


@dataclass(frozen=True, slots=True, config=_STRICT)
class Fleet:
    """The AUVs.

    Parameters
    ----------
    size
        Number M of AUVs; None leaves it to the estimate of tier 1.
    speed
        Speed through the water in metres per second.
    endurance
        T_max in seconds, one number for all AUVs or one for each; None is unlimited.
    turning_radius
        Least radius of a turn in metres.
    depth
        Where the AUVs cruise, in metres, positive down; None leaves it open.
    depth_rating
        How deep they may dive, in metres; None leaves it open.
    """

    size: Annotated[int, Field(ge=1, le=MAX_FLEET)] | None
    speed: PositiveFloat
    endurance: _Endurance | None
    turning_radius: NonNegativeFloat = TURNING_RADIUS
    depth: NonNegativeFloat | None = None
    depth_rating: PositiveFloat | None = None

    def endurance_of(self, auv: int) -> float:
        """T_max of one AUV, counted from 0, in seconds; infinite where none is stated."""
        if isinstance(self.endurance, tuple):
            return self.endurance[auv]
        return math.inf if self.endurance is None else self.endurance


@dataclass(frozen=True, slots=True, config=_STRICT)
class Service:
    """Time to collect data, t_j = delay + rate * rho_j in seconds, equation (30)."""

    delay: NonNegativeFloat = 0.0
    rate: NonNegativeFloat = 0.0


@dataclass(frozen=True, slots=True, config=_STRICT)
class Vortex:
    """A Lamb vortex, equation (10): circulation in m2/s (signed), core radius in metres."""

    x: float
    y: float
    circulation: float
    radius: PositiveFloat


@dataclass(frozen=True, slots=True, config=_STRICT)
class Uniform:
    """A uniform current in metres per second, u east and v north."""

    u: float
    v: float


@dataclass(frozen=True, slots=True, config=_STRICT)
class Currents:
    """Parts of a current field, which add up.

    Parameters
    ----------
    vortices, uniform
        See their classes.
    file
        Name of a CF netCDF file of an ocean model.
    depth
        Depth in metres at which the file's current is taken, positive down.
    begin
        When the mission begins, UTC, as 2016-01-31T12:00; None takes the file's first time.
    """

    vortices: Many[Vortex] = ()
    uniform: Uniform | None = None
    file: Annotated[str, Field(min_length=1)] | None = None
    depth: NonNegativeFloat = 0.0
    begin: Annotated[str, Field(min_length=1)] | None = None


@dataclass(frozen=True, slots=True, config=_STRICT)
class Circle:
    """A round obstacle, in metres."""

    x: float
    y: float
    radius: PositiveFloat


@dataclass(frozen=True, slots=True, config=_STRICT)
class Polygon:
    """A polygon, its corners (x, y) in metres in either sense of rotation."""

    polygon: Annotated[Many[tuple[float, float]], Field(min_length=3)]


def _obstacle_kind(value: object) -> str:
    is_polygon = isinstance(value, Polygon) or (isinstance(value, dict) and "polygon" in value)
    return "polygon" if is_polygon else "circle"


_Obstacle = Annotated[
    Annotated[Circle, Tag("circle")] | Annotated[Polygon, Tag("polygon")],
    Discriminator(_obstacle_kind),
]


@dataclass(frozen=True, slots=True, config=_STRICT)
class Ocean:
    """Currents, obstacles and land.

    Parameters
    ----------
    currents, obstacles, land
        See their classes; land is to be avoided like an obstacle.
    margin
        Distance in metres that paths keep from obstacles and land.
    """

    currents: Currents = Currents()
    obstacles: Many[_Obstacle] = ()
    land: Many[Polygon] = ()
    margin: NonNegativeFloat = 0.0


@dataclass(frozen=True, slots=True, config=_STRICT)
class Uncertainty:
    """What makes a real leg time differ from the planned one, equation (12).

    f(t) = max(floor * t, t + N(0, (drift * t)^2) + K * manoeuvre_time) with K Poisson
    of mean manoeuvres_per_km times the length of the leg in kilometres.

    Parameters
    ----------
    drift
        Standard deviation of the current term, as a share of the leg time.
    manoeuvres_per_km
        Mean number of avoidance manoeuvres per kilometre.
    manoeuvre_time
        Seconds lost in each of them.
    floor
        Least share of the planned leg time that a real leg can take.
    """

    drift: NonNegativeFloat = 0.0
    manoeuvres_per_km: NonNegativeFloat = 0.0
    manoeuvre_time: NonNegativeFloat = 0.0
    floor: Annotated[float, Field(ge=0.0, le=1.0)] = 0.2


def _unique_ids(nodes: tuple[Node, ...]) -> tuple[Node, ...]:
    first: dict[str, int] = {}
    for i, node in enumerate(nodes):
        if first.setdefault(node.id, i) != i:
            raise InputError(
                f"is the id of nodes[{first[node.id]}] too; give every node an id of its own",
                field=f"nodes[{i}].id",
                value=node.id,
            )
    return nodes


@dataclass(frozen=True, slots=True, config=_STRICT)
class Instance:
    """A whole mission.

    Parameters
    ----------
    name
        Name of the instance.
    nodes
        Sensor nodes; none is legal, and gives an empty plan.
    start, destination
        Where the fleet is released and recovered; they may coincide.
    fleet, service, ocean, uncertainty
        See their classes.
    crs
        What the local metres are measured from: an azimuthal equidistant plane as a PROJ string,
        ``+proj=aeqd +lat_0=.. +lon_0=..``. None leaves that open; a file of currents is then
        laid with its middle at the origin.
    metric
        How coordinates become distances; ``euclidean`` but for benchmark formats.
    travel_times
        Leg times in seconds between start, nodes and destination, in this order, for the
        metric ``explicit``; they may be asymmetric.
    """

    name: str
    nodes: Annotated[Many[Node], AfterValidator(_unique_ids)]
    start: Point
    destination: Point
    fleet: Fleet
    service: Service = Service()
    ocean: Ocean = Ocean()
    uncertainty: Uncertainty = Uncertainty()
    crs: str | None = None
    metric: Metric = "euclidean"
    travel_times: Many[Many[NonNegativeFloat]] | None = None

    def __post_init__(self) -> None:
        if self.crs is not None and self.origin is None:
            raise InputError(
                "only local metres are supported; project the coordinates and set crs to null or "
                "to '+proj=aeqd +lat_0=.. +lon_0=..'",
                field="crs",
                value=self.crs,
            )
        endurance = self.fleet.endurance
        if isinstance(endurance, tuple) and self.fleet.size not in (None, len(endurance)):
            raise InputError(
                f"endurance has {len(endurance)} entries; give one number, or one per AUV",
                field="fleet.size",
                value=self.fleet.size,
            )
        if (self.metric == "explicit") != (self.travel_times is not None):
            raise InputError(
                "the metric 'explicit' and travel_times go together; give both or neither",
                field="metric",
                value=self.metric,
            )
        if self.travel_times is not None:
            self._check_shape(self.travel_times)

    def _check_shape(self, times: tuple[tuple[float, ...], ...]) -> None:
        size = len(self.nodes) + 2
        lengths = {"travel_times": len(times)}
        lengths |= {f"travel_times[{i}]": len(row) for i, row in enumerate(times)}
        for field, length in lengths.items():
            if length != size:
                raise InputError(
                    f"must have {size} entries: start, {len(self.nodes)} nodes, destination",
                    field=field,
                    value=length,
                )

    @property
    def origin(self) -> tuple[float, float] | None:
        """Longitude and latitude in degrees of the point that x and y are measured from."""
        parts = dict(re.findall(r"\+(\w+)=(\S+)", self.crs or ""))
        if parts.get("proj") != "aeqd":
            return None
        try:
            return float(parts["lon_0"]), float(parts["lat_0"])
        except (KeyError, ValueError):
            return None

    def _repr_html_(self) -> str:
        """A line and a small map, for notebooks."""
        from fiveroute.view.notebook import mission_html

        return mission_html(self)

    @property
    def has_ocean(self) -> bool:
        """Whether there is anything but still, open water."""
        return self.ocean != Ocean()

    @property
    def points(self) -> NDArray[np.float64]:
        """Positions of start, nodes and destination in metres, shape (n + 2, 2)."""
        stops: list[Point | Node] = [self.start, *self.nodes, self.destination]
        return np.array([(stop.x, stop.y) for stop in stops], dtype=np.float64)

    @property
    def travel(self) -> NDArray[np.float64]:
        """Leg times t_ij in still water in seconds, equation (1), shape (n + 2, n + 2)."""
        if self.travel_times is not None:
            return np.array(self.travel_times, dtype=np.float64)
        with np.errstate(over="ignore", invalid="ignore"):  # TeamOrienteering refuses these
            matrix = distances(self.metric, self.points)
            return np.divide(matrix, self.fleet.speed, out=matrix)

    @property
    def lengths_km(self) -> NDArray[np.float64]:
        """Lengths of straight legs in kilometres, for the mean number of manoeuvres in (12)."""
        return self.travel * (self.fleet.speed / 1000.0)

    @property
    def service_times(self) -> NDArray[np.float64]:
        """Service times in seconds, shape (n + 2,), zero at both ends."""
        return _at_nodes(
            [
                self.service.delay + self.service.rate * node.data
                if node.service_time is None
                else node.service_time
                for node in self.nodes
            ]
        )

    @property
    def total_data(self) -> float:
        """Data of all nodes together, those out of reach included."""
        return float(sum(node.data for node in self.nodes))

    @property
    def fleet_size(self) -> int | None:
        """Number of AUVs that the file states; None leaves it to tier 1."""
        endurance = self.fleet.endurance
        return len(endurance) if isinstance(endurance, tuple) else self.fleet.size

    def problem(
        self, fleet_size: int | None = None, travel: NDArray[np.float64] | None = None
    ) -> TeamOrienteering:
        """The combinatorial problem.

        Parameters
        ----------
        fleet_size
            Number of AUVs; None takes that of the instance.
        travel
            Leg times in seconds, shape (n + 2, n + 2), infinite where a leg cannot be sailed, which
            becomes a time beyond every budget; None takes straight legs in still water.

        Raises
        ------
        InputError
            If no fleet size is known, or it contradicts the endurances.
        """
        size, endurance = self._known_size(fleet_size), self.fleet.endurance
        legs, service = self.travel if travel is None else travel, self.service_times
        if endurance is None:
            sailed = legs if travel is None else np.where(np.isinf(legs), 0.0, legs)
            with np.errstate(over="ignore"):
                endurance = float(sailed.max(axis=1).sum() + service.sum()) or 1.0
        budgets = endurance if isinstance(endurance, tuple) else (endurance,) * size
        if travel is not None:
            legs = np.where(np.isinf(travel), 2.0 * max(budgets) + 1.0, travel)
        data = _at_nodes([node.data for node in self.nodes])
        return TeamOrienteering(legs, service, data, budgets)

    def _known_size(self, asked: int | None) -> int:
        """The fleet size that is asked for, or that of the instance, if either makes sense."""
        stated = self.fleet_size
        size = stated if asked is None else asked
        if not isinstance(size, Integral) or not 1 <= size <= MAX_FLEET:
            raise InputError(
                f"the fleet needs a size from 1 to {MAX_FLEET}; set it or pass --fleet-size",
                field="fleet.size",
                value=size,
            )
        if isinstance(self.fleet.endurance, tuple) and size != stated:
            raise InputError(
                f"fleet.endurance names {stated} AUVs; leave the fleet size to it",
                field="fleet size",
                value=size,
            )
        return size


def _at_nodes(values: list[float]) -> NDArray[np.float64]:
    return np.array([0.0, *values, 0.0], dtype=np.float64)
