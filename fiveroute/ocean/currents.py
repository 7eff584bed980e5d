"""Currents: anything callable on positions and a time.

A current maps positions (x, y) in metres and a time in seconds since the mission began to the
components (u, v) of the water's velocity in metres per second, u east and v north:

    u, v = current(x, y, t)

x, y and t are scalars or arrays that broadcast. Currents add up (`Superposition`), as the paper
adds the velocities of its vortices. Planners, which ask millions of times, take a
`fiveroute.ocean.current_grid.CurrentGrid` instead.

References
----------
B. Garau, A. Alvarez and G. Oliver, "AUV navigation through turbulent ocean environments
supported by onboard H-ADCP", ICRA 2006, doi 10.1109/ROBOT.2006.1641772 (superposed vortices).
S. C. Shadden, F. Lekien and J. E. Marsden, "Definition and properties of Lagrangian coherent
structures from finite-time Lyapunov exponents in two-dimensional aperiodic flows", Physica D
212 (2005), doi 10.1016/j.physd.2005.10.007 (the double gyre).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fiveroute.errors import InputError

__all__ = ["Current", "DoubleGyre", "LambVortices", "Shear", "Superposition", "UniformCurrent"]

Floats = NDArray[np.float64]

_CENTRE = 1e-12  # squared distance from a centre, in radii, below which the core turns rigidly


class Current(Protocol):
    """A velocity field of the water."""

    @property
    def is_steady(self) -> bool:
        """Whether the time makes no difference."""
        ...

    @property
    def length_scale(self) -> float:
        """Distance in metres that a grid must resolve; infinite where nothing varies."""
        ...

    def __call__(self, x: ArrayLike, y: ArrayLike, t: ArrayLike = 0.0) -> tuple[Floats, Floats]:
        """Velocity at positions and times.

        Parameters
        ----------
        x, y
            Positions in metres, x east and y north.
        t
            Seconds since the mission began.

        Returns
        -------
        u, v : array
            Components in metres per second, in the broadcast shape.
        """
        ...


@dataclass(frozen=True, slots=True)
class UniformCurrent:
    """The same velocity everywhere.

    Parameters
    ----------
    u, v
        Components in metres per second.
    """

    u: float
    v: float

    @property
    def is_steady(self) -> bool:
        """Always."""
        return True

    @property
    def length_scale(self) -> float:
        """Infinite."""
        return math.inf

    def __call__(self, x: ArrayLike, y: ArrayLike, t: ArrayLike = 0.0) -> tuple[Floats, Floats]:
        """Velocity at positions and times."""
        one = np.ones(np.broadcast_shapes(np.shape(x), np.shape(y), np.shape(t)))
        return self.u * one, self.v * one


@dataclass(frozen=True, slots=True)
class Shear:
    """An eastward current that grows to the north, u = rate (y - y0), v = 0.

    Parameters
    ----------
    rate
        In 1/s.
    y0
        Where the water stands still, in metres.
    """

    rate: float
    y0: float = 0.0

    @property
    def is_steady(self) -> bool:
        """Always."""
        return True

    @property
    def length_scale(self) -> float:
        """Infinite: what is linear needs no fine grid."""
        return math.inf

    def __call__(self, x: ArrayLike, y: ArrayLike, t: ArrayLike = 0.0) -> tuple[Floats, Floats]:
        """Velocity at positions and times."""
        zero = np.zeros(np.broadcast_shapes(np.shape(x), np.shape(y), np.shape(t)))
        return self.rate * (np.asarray(y, dtype=np.float64) - self.y0) + zero, zero


@dataclass(frozen=True, slots=True, eq=False)
class LambVortices:
    """Lamb vortices, equation (10), superposed.

    With r the distance from the centre (x0, y0), each moves the water by

        u = -Gamma / (2 pi r^2) (1 - exp(-r^2 / delta^2)) (y - y0)
        v = +Gamma / (2 pi r^2) (1 - exp(-r^2 / delta^2)) (x - x0)

    It is a Lamb-Oseen vortex at the age delta^2 / (4 nu) in water of viscosity nu: its vorticity
    Gamma / (pi delta^2) exp(-r^2 / delta^2) solves (9), and its circulation far away is Gamma.

    Parameters
    ----------
    x, y
        Centres in metres, shape (k,).
    circulation
        Gamma in m2/s, positive anticlockwise, shape (k,).
    radius
        Core radius delta in metres, shape (k,).
    """

    x: Floats
    y: Floats
    circulation: Floats
    radius: Floats

    def __post_init__(self) -> None:
        shapes = {np.shape(part) for part in (self.x, self.y, self.circulation, self.radius)}
        if len(shapes) != 1 or len(shapes.pop()) != 1:
            raise InputError("every vortex needs a centre, a circulation and a radius")
        if not (np.asarray(self.radius) > 0.0).all():
            raise InputError("a vortex needs a positive radius", field="radius")
        for name in ("x", "y", "circulation", "radius"):
            if not np.isfinite(getattr(self, name)).all():
                raise InputError("all must be finite numbers; correct them", field=name)

    @property
    def is_steady(self) -> bool:
        """Always."""
        return True

    @property
    def length_scale(self) -> float:
        """The smallest core."""
        return float(np.min(self.radius, initial=math.inf))

    def __call__(self, x: ArrayLike, y: ArrayLike, t: ArrayLike = 0.0) -> tuple[Floats, Floats]:
        """Velocity at positions and times."""
        u = np.zeros(np.broadcast_shapes(np.shape(x), np.shape(y), np.shape(t)))
        v = np.zeros_like(u)
        for x0, y0, circulation, radius in zip(
            self.x, self.y, self.circulation, self.radius, strict=True
        ):
            east, north = np.asarray(x) - x0, np.asarray(y) - y0
            squared = np.maximum((east**2 + north**2) / radius**2, _CENTRE)
            swirl = circulation / (2.0 * math.pi * radius**2) * -np.expm1(-squared) / squared
            u -= swirl * north
            v += swirl * east
        return u, v


@dataclass(frozen=True, slots=True)
class DoubleGyre:
    """Two gyres side by side whose border swings to and fro.

    On the rectangle of width 2 L and height L from (x0, y0), with X = (x - x0) / L and
    Y = (y - y0) / L, the stream function A L / pi sin(pi f(X, t)) sin(pi Y), where
    f = a X^2 + (1 - 2 a) X and a = epsilon sin(omega t), gives

        u = -A sin(pi f) cos(pi Y),    v = A cos(pi f) sin(pi Y) df/dX.

    Parameters
    ----------
    speed
        A in metres per second.
    size
        L in metres.
    epsilon
        Amplitude of the swing; 0 is steady.
    omega
        Angular frequency of the swing in rad/s.
    x0, y0
        South-western corner in metres.
    """

    speed: float
    size: float
    epsilon: float = 0.0
    omega: float = 0.0
    x0: float = 0.0
    y0: float = 0.0

    def __post_init__(self) -> None:
        if not self.size > 0.0:
            raise InputError("a gyre needs a positive size", field="size", value=self.size)

    @property
    def is_steady(self) -> bool:
        """Whether the border stands still."""
        return self.epsilon * self.omega == 0.0

    @property
    def length_scale(self) -> float:
        """A third of a gyre."""
        return self.size / 3.0

    def __call__(self, x: ArrayLike, y: ArrayLike, t: ArrayLike = 0.0) -> tuple[Floats, Floats]:
        """Velocity at positions and times."""
        across = (np.asarray(x, dtype=np.float64) - self.x0) / self.size
        up = (np.asarray(y, dtype=np.float64) - self.y0) / self.size
        a = self.epsilon * np.sin(self.omega * np.asarray(t, dtype=np.float64))
        phase = math.pi * (a * across**2 + (1.0 - 2.0 * a) * across)
        slope = 2.0 * a * across + 1.0 - 2.0 * a
        u = -self.speed * np.sin(phase) * np.cos(math.pi * up)
        v = self.speed * np.cos(phase) * np.sin(math.pi * up) * slope
        return u, v


@dataclass(frozen=True, slots=True)
class Superposition:
    """Currents that add up; none is still water.

    Parameters
    ----------
    parts
        The currents.
    """

    parts: tuple[Current, ...]

    @property
    def is_steady(self) -> bool:
        """Whether every part is."""
        return all(part.is_steady for part in self.parts)

    @property
    def length_scale(self) -> float:
        """The smallest of the parts'."""
        return min((part.length_scale for part in self.parts), default=math.inf)

    def __call__(self, x: ArrayLike, y: ArrayLike, t: ArrayLike = 0.0) -> tuple[Floats, Floats]:
        """Velocity at positions and times."""
        u = np.zeros(np.broadcast_shapes(np.shape(x), np.shape(y), np.shape(t)))
        v = np.zeros_like(u)
        for part in self.parts:
            more = part(x, y, t)
            u += more[0]
            v += more[1]
        return u, v
