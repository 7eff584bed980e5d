"""Line-of-sight guidance: which heading leads a vehicle onto a straight leg and keeps it there.

A leg has the bearing pi_h, anticlockwise from east; the cross-track error e in metres is positive
to port of it. All but the first law steer for a point on the leg, the lookahead distance D ahead,

    hold:  psi = pi_h
    los:   psi = pi_h - atan(e / D)
    ilos:  psi = pi_h - atan((e + s i) / D),     di/dt = D e / ((e + s i)^2 + D^2)
    alos:  psi = pi_h - b - atan(e / D),         db/dt = g D e / sqrt(e^2 + D^2)

In a cross current w a vehicle of speed V must head into it by the crab angle asin(w / V). Heading
hold drifts away; LOS settles where the error makes up the crab angle, e = D w / sqrt(V^2 - w^2);
the integral i of ILOS and the estimated crab angle b of ALOS take its place, and e vanishes.
What the rate of i does by itself, ALOS needs a bound for: b is projected onto an interval, as
published, and rests far from the leg, where e says nothing about the current.

References
----------
ILOS: E. Borhaug, A. Pavlov, K. Y. Pettersen, "Integral LOS control for path following of
underactuated marine surface vessels in the presence of constant ocean currents", 47th IEEE
Conference on Decision and Control 2008, doi 10.1109/CDC.2008.4739352.
ALOS: T. I. Fossen, "An adaptive line-of-sight (ALOS) guidance law for path following of aircraft
and marine craft", IEEE Transactions on Control Systems Technology 31 (2023),
doi 10.1109/TCST.2023.3259819.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, NamedTuple, get_args

from fiveroute.errors import InputError
from fiveroute.kernels import kernel

__all__ = ["Guidance", "Law", "Steering", "adapted", "desired_heading"]

Law = Literal["hold", "los", "ilos", "alos"]

_LAWS: tuple[Law, ...] = get_args(Law)
_NEAR = 2.0  # lookahead distances within which ALOS learns: LOS alone gets there up to 63 degrees
_MOST_CRAB = math.radians(80.0)
_LOS, _ILOS, _ALOS = _LAWS.index("los"), _LAWS.index("ilos"), _LAWS.index("alos")


class Steering(NamedTuple):
    """A guidance law as kernels need it; see `Guidance`."""

    law: int
    lookahead: float
    integral: float
    adaptation: float


@dataclass(frozen=True, slots=True)
class Guidance:
    """A guidance law.

    Parameters
    ----------
    law
        One of the four of the module.
    lookahead
        D in metres; 20 m is the default for the REMUS 100 in Fossen's Marine Systems Simulator.
    integral
        s of ILOS in metres per second, less than the vehicle's speed over ground along the
        leg (Borhaug and others). About an error of 0 the poles are those of
        q^2 + (V / D) q + V s / D^2 = 0: critically damped at s = V / 4, thus 0.2 at about 1 m/s.
    adaptation
        g of ALOS in 1/(m s), 0.001 in Fossen's simulator. About an error of 0 its poles are those
        of q^2 + (V / D) q + V g = 0.
    """

    law: Law = "alos"
    lookahead: float = 20.0
    integral: float = 0.2
    adaptation: float = 1e-3

    def __post_init__(self) -> None:
        if self.law not in _LAWS:
            raise InputError(f"must be one of {', '.join(_LAWS)}", field="law", value=self.law)
        for name in ("lookahead", "integral", "adaptation"):
            value = getattr(self, name)
            if not 0.0 < value < math.inf:
                raise InputError("must be positive and finite", field=name, value=value)

    @property
    def steering(self) -> Steering:
        """The law in numbers."""
        return Steering(
            _LAWS.index(self.law),
            float(self.lookahead),
            float(self.integral),
            float(self.adaptation),
        )


@kernel
def desired_heading(steering: Steering, bearing: float, error: float, memory: float) -> float:
    """Heading in radians; the memory is ILOS's integral i or ALOS's crab angle b, at first 0."""
    if steering.law == _LOS:
        return bearing - math.atan(error / steering.lookahead)
    if steering.law == _ILOS:
        return bearing - math.atan((error + steering.integral * memory) / steering.lookahead)
    if steering.law == _ALOS:
        return bearing - memory - math.atan(error / steering.lookahead)
    return bearing


@kernel
def adapted(steering: Steering, error: float, memory: float, step: float) -> float:
    """The memory after a step in seconds, by Euler's rule, as an autopilot computes it."""
    lookahead = steering.lookahead
    if steering.law == _ILOS:
        aim = error + steering.integral * memory
        return memory + step * lookahead * error / (aim * aim + lookahead * lookahead)
    if steering.law == _ALOS and abs(error) <= _NEAR * lookahead:
        crab = memory + step * steering.adaptation * lookahead * error / math.hypot(
            error, lookahead
        )
        return min(max(crab, -_MOST_CRAB), _MOST_CRAB)
    return memory
