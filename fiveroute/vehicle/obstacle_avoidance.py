"""Avoiding obstacles that the plan did not know, by what the sonar has heard of them.

The vehicle cannot stop. A heading is taken only if it is *clear*: if the way on it, predicted over
the ground with the current at hand (first straight for the yaw's time constant, then round the
turning circle, then straight as far as the sonar reaches), keeps a standoff from every echo, and
if there is a place on it from which the vehicle could still turn round, in a circle that keeps
half of the standoff. So it does not enter a dead end in which it cannot turn.

The desired heading of the guidance is followed as long as it is clear. When it is not, a manoeuvre
begins: of the clear headings to port and to starboard the one that deviates least is followed,
and its side is kept until the manoeuvre ends, so that the vehicle follows the outline of the
obstacle. The deviation is counted without wrapping, as in the Pledge algorithm for mazes: a
vehicle that has been turned round in a pocket has to turn back before the desired heading counts
as followed again, and so leaves the pocket. If no heading is clear it circles to the freer
side, or else takes the heading on which the echoes stay farthest away; if all of them lead into
echoes, it must stop. A manoeuvre ends when the desired heading has been clear for some time.

References
----------
The prediction of arcs, among which the best is chosen, is that of the dynamic window: D. Fox,
W. Burgard, S. Thrun, "The dynamic window approach to collision avoidance", IEEE Robotics &
Automation Magazine 4 (1997), doi 10.1109/100.580977; for AUVs B.-O. H. Eriksen, M. Breivik,
K. Y. Pettersen, M. S. Wiig, "A modified dynamic window algorithm for horizontal collision
avoidance for AUVs", IEEE Conference on Control Applications 2016, doi 10.1109/CCA.2016.7587879.
The unwrapped deviation: H. Abelson and A. A. diSessa, "Turtle Geometry", MIT Press 1981.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.kernels import kernel
from fiveroute.vehicle.dynamics import State, Vehicle
from fiveroute.vehicle.sonar import Beams, Sonar

__all__ = ["Avoidance", "Lookout", "Manoeuvre", "avoid", "nearby"]

Floats = NDArray[np.float64]

_FAN = math.radians(10.0)  # between two headings that are tried
_BACK = 14  # of them by which a deviation may shrink from ping to ping
_TURN = 18  # of them in half a turn
_ARC = math.radians(20.0)  # of a turning circle in one straight piece of the prediction
_STRAIGHT = 3  # straight pieces of the prediction after the turn
_ENOUGH = 0.4  # of the standoff, where there is no choice: fewer stop at 0.2, but some collide
_LET = 0.1  # metres by which a vehicle within the standoff may approach still


class Lookout(NamedTuple):
    """How a vehicle looks out, as kernels need it; see `Avoidance`."""

    beams: Beams
    standoff: float
    calm: float
    speed: float
    lag: float
    turning_speed: float
    turning_rate: float
    turning_radius: float


class Manoeuvre(NamedTuple):
    """An avoidance manoeuvre under way.

    Parameters
    ----------
    side
        1 to port, -1 to starboard, 0 if there is none.
    heading
        Heading in radians that is to be followed, not wrapped.
    blocked
        When the desired heading was last found not to be clear, in seconds.
    hopeless
        Whether every heading leads into the echoes, so that only stopping is left.
    """

    side: float
    heading: float
    blocked: float
    hopeless: bool


@dataclass(frozen=True, slots=True)
class Avoidance:
    """How a vehicle avoids obstacles.

    Parameters
    ----------
    sonar
        Its forward-looking sonar.
    standoff
        Distance in metres that it tries to keep; half of the least turning radius of a REMUS 100.
    calm
        Seconds for which the way must be clear before a manoeuvre counts as over, about the
        time in which the guidance comes back to its leg, lookahead / V.
    """

    sonar: Sonar = field(default_factory=Sonar)
    standoff: float = 10.0
    calm: float = 20.0

    def __post_init__(self) -> None:
        for name in ("standoff", "calm"):
            value = getattr(self, name)
            if not 0.0 <= value < math.inf:
                raise InputError("must be finite and not negative", field=name, value=value)

    def lookout(self, vehicle: Vehicle, margin: float = 0.0) -> Lookout:
        """The numbers for a vehicle, and a safety margin in metres besides."""
        turn = vehicle.steady_turn(vehicle.rudder_limit)
        return Lookout(
            self.sonar.fan,
            float(self.standoff + margin),
            float(self.calm),
            float(vehicle.speed),
            float(vehicle.turning_length / vehicle.speed),
            float(turn.speed),
            float(turn.yaw_rate),
            float(turn.radius),
        )


@kernel
def nearby(echoes: Floats, heard: int, x: float, y: float, reach: float, near: Floats) -> int:
    """Fill in the echoes within reach of a position, and return their number."""
    number = 0
    for k in range(min(heard, len(echoes))):
        if (echoes[k, 0] - x) ** 2 + (echoes[k, 1] - y) ** 2 <= reach * reach:
            near[number, 0], near[number, 1] = echoes[k, 0], echoes[k, 1]
            number += 1
    return number


@kernel
def avoid(
    lookout: Lookout,
    near: Floats,
    state: State,
    current: tuple[float, float],
    desired: float,
    manoeuvre: Manoeuvre,
    t: float,
) -> Manoeuvre:
    """What to do about the echoes at hand, shape (k, 2), with the desired heading not wrapped."""
    wanted = max(min(lookout.standoff, _nearest(near, state) - _LET), 0.0)
    side = manoeuvre.side
    if side == 0.0:
        if _distance(lookout, near, state, current, desired, wanted) >= wanted:
            return Manoeuvre(0.0, desired, manoeuvre.blocked, False)
        for deviation in range(1, _TURN + 1):
            for side in (1.0, -1.0):
                heading = desired + side * deviation * _FAN
                if _distance(lookout, near, state, current, heading, wanted) >= wanted:
                    return Manoeuvre(side, heading, t, False)
        heading, hopeless = _last_resort(lookout, near, state, current, wanted)
        return Manoeuvre(1.0 if heading >= desired else -1.0, heading, t, hopeless)
    followed = max(math.ceil(side * (manoeuvre.heading - desired) / _FAN), 0)
    for deviation in range(max(followed - _BACK, 0), followed + _TURN + 1):
        heading = desired + side * deviation * _FAN
        if _distance(lookout, near, state, current, heading, wanted) >= wanted:
            if deviation > 0:
                return Manoeuvre(side, heading, t, False)
            over = t - manoeuvre.blocked >= lookout.calm
            return Manoeuvre(0.0 if over else side, desired, manoeuvre.blocked, False)
    heading, hopeless = _last_resort(lookout, near, state, current, wanted)
    return Manoeuvre(side, heading, t, hopeless)


@kernel
def _last_resort(
    lookout: Lookout, near: Floats, state: State, current: tuple[float, float], wanted: float
) -> tuple[float, bool]:
    """Circle where that is safe; otherwise go where the echoes stay farthest away, if they do."""
    port = _circling(lookout, near, state, current, 1.0)
    starboard = _circling(lookout, near, state, current, -1.0)
    enough = min(_ENOUGH * lookout.standoff, wanted)
    if max(port, starboard) >= enough:
        return state.heading + (0.5 if port >= starboard else -0.5) * math.pi, False
    best, most = state.heading, -1.0
    for turn in range(-_TURN, _TURN + 1):
        heading = state.heading + turn * _FAN
        distance = _distance(lookout, near, state, current, heading, -1.0)
        if distance > most:
            best, most = heading, distance
    return best, most < enough


@kernel
def _circling(
    lookout: Lookout, near: Floats, state: State, current: tuple[float, float], side: float
) -> float:
    """Distance of the echoes to the disc that half a turn to one side needs, as it drifts."""
    ahead, left = math.cos(state.heading), math.sin(state.heading)
    straight = lookout.speed * _delay(lookout, state, side)
    radius = side * lookout.turning_radius
    time = math.pi / lookout.turning_rate
    x, y = state.x + straight * ahead - radius * left, state.y + straight * left + radius * ahead
    least = _from_piece(near, x, y, time * current[0], time * current[1])
    return least - lookout.turning_radius


@kernel
def _delay(lookout: Lookout, state: State, side: float) -> float:
    """Time in seconds until a turn to one side is under way; none if it is already."""
    return lookout.lag * (1.0 - side * state.yaw_rate / lookout.turning_rate)


@kernel
def _nearest(near: Floats, state: State) -> float:
    least = math.inf
    for k in range(len(near)):
        least = min(least, math.hypot(near[k, 0] - state.x, near[k, 1] - state.y))
    return least


@kernel
def _distance(
    lookout: Lookout,
    near: Floats,
    state: State,
    current: tuple[float, float],
    heading: float,
    wanted: float,
) -> float:
    """Least distance to the echoes on the way to a heading and on it.

    It is exact where it is at least `wanted`, and -1 if there is nowhere room to turn round.
    """
    x, y, angle = state.x, state.y, state.heading
    least, turn, room = math.inf, heading - state.heading, wanted < 0.0
    margin = min(0.5 * lookout.standoff, wanted)
    pieces = math.ceil(abs(turn) / _ARC)
    for piece in range(pieces + 1 + _STRAIGHT):
        if piece == 0:  # straight on, until the turn begins
            speed = lookout.speed
            time = _delay(lookout, state, math.copysign(1.0, turn))
        elif piece <= pieces:  # along a chord of the turning circle
            angle += (0.5 if piece == 1 else 1.0) * turn / pieces
            speed, time = lookout.turning_speed, abs(turn) / pieces / lookout.turning_rate
        else:
            angle, speed = heading, lookout.speed
            time = lookout.beams.reach / _STRAIGHT / speed
        east = time * (speed * math.cos(angle) + current[0])
        north = time * (speed * math.sin(angle) + current[1])
        least = min(least, _from_piece(near, x, y, east, north))
        if least < wanted:
            return least
        x, y = x + east, y + north
        if not room and piece <= pieces + 1:  # no farther than the beams see a whole circle
            there = State(x, y, angle, state.surge, state.sway, 0.0)
            port = _circling(lookout, near, there, current, 1.0)
            room = port >= margin or _circling(lookout, near, there, current, -1.0) >= margin
    return least if room else -1.0


@kernel
def _from_piece(near: Floats, x: float, y: float, east: float, north: float) -> float:
    """Least distance of the echoes from a straight piece."""
    least, squared = math.inf, east * east + north * north
    for k in range(len(near)):
        right, up = near[k, 0] - x, near[k, 1] - y
        share = 0.0
        if squared > 0.0:
            share = min(max((right * east + up * north) / squared, 0.0), 1.0)
        right, up = right - share * east, up - share * north
        least = min(least, right * right + up * up)
    return math.sqrt(least)
