"""A torpedo-shaped AUV in the horizontal plane: surge, sway and yaw.

The state is the position (x, y), the heading psi anticlockwise from east, the velocity (u, v)
relative to the water, forward and to port, and the yaw rate r. With the current c = (c_x, c_y)
and the rudder angle delta, positive where it turns the vehicle to port,

    dx/dt = u cos(psi) - v sin(psi) + c_x,    dy/dt = u sin(psi) + v cos(psi) + c_y,
    d psi/dt = r,
    (m - X_du) du/dt = X + X_uu u |u| + (m - Y_dv) v r,
    (m - Y_dv) dv/dt = Y_uv u v - (m - Y_ur) u r - Y_d u^2 delta,
    dr/dt = u (k u delta - r) / l.

Surge and sway are those of Prestero's model of the REMUS, without the terms that are of second
order in slow sway; the thrust X is constant and balances the drag at the vehicle's speed. Yaw is
Nomoto's equation of first order, its gain k u and its time l / u scaled with the speed as usual,
fitted to the turns of Fossen's REMUS 100. The sources differ here: Prestero's yaw moment holds the
unstable (Munk) moment of the hull, which his fins do not outweigh (without a rudder the motion has
an eigenvalue of +0.66 u per metre), and turns at 15 degrees of rudder on 6 m; Fossen leaves that
moment out, and turns on 20 m. The water's acceleration is neglected against the vehicle's, as in
every model in relative velocity.

Every force is of second order in the velocities, so that a steady turn has a closed form: with the
rudder held the path's curvature is about k delta, that is

    r = k delta u,    v = -a k delta u,    u = V / sqrt(1 + b (k delta)^2),
    a = (m - Y_ur + Y_d / k) / -Y_uv,      b = (m - Y_dv) a / -X_uu,

on a radius sqrt(1 + (a k delta)^2) / (k delta) at all speeds; at a given yaw rate r it is
u = sqrt(V^2 - b r^2).

The autopilot places both poles of the yaw angle's error (Fossen 2021, section 15.3) and bounds
the rudder such that Nomoto's steady rate stays within the limit, which the rate therefore never
passes. Motion is integrated by Runge and Kutta's rule of fourth order with a fixed step.

References
----------
T. Prestero, "Verification of a six-degree of freedom simulation model for the REMUS autonomous
underwater vehicle", MSc thesis, MIT and WHOI 2001, doi 10.1575/1912/3040.
T. I. Fossen, "Handbook of Marine Craft Hydrodynamics and Motion Control", 2nd edition,
Wiley 2021, and his model of the REMUS 100, which the gain of the turn is fitted to.
K. Nomoto, T. Taguchi, K. Honda, S. Hirano, "On the steering qualities of ships", International
Shipbuilding Progress 4 (1957), doi 10.3233/ISP-1957-43504.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import NamedTuple

from fiveroute.errors import InputError
from fiveroute.kernels import kernel
from fiveroute.ocean.current_grid import CurrentGrid, velocity

__all__ = ["Motion", "State", "SteadyTurn", "Vehicle", "advance", "rudder_angle"]

_CREEP = 0.05  # metres per second: the autopilot expects no less speed


class State(NamedTuple):
    """Position in metres, heading in radians, velocity through the water in m/s, yaw rate in rad/s.

    The heading is not wrapped: a full turn to port adds 2 pi.
    """

    x: float
    y: float
    heading: float
    surge: float
    sway: float
    yaw_rate: float


class SteadyTurn(NamedTuple):
    """A turn with the rudder held: speed in m/s, radius in m, yaw rate in rad/s, drift in rad."""

    speed: float
    radius: float
    yaw_rate: float
    drift: float


class Motion(NamedTuple):
    """The coefficients of the equations as kernels need them; see `Vehicle`."""

    thrust: float
    drag: float
    coupling: float
    sway_damping: float
    sway_turning: float
    sway_rudder: float
    turning_gain: float
    turning_length: float
    rudder_limit: float
    yaw_rate_limit: float
    frequency: float
    damping: float


@dataclass(frozen=True, slots=True)
class Vehicle:
    """A torpedo-shaped AUV; all but its speed is by default that of a REMUS 100.

    Parameters
    ----------
    speed
        V, straight through the water, in metres per second.
    mass
        m in kilograms (Prestero: a weight of 299 N).
    surge_added_mass, sway_added_mass
        -X_du and -Y_dv in kilograms (Prestero).
    drag
        -X_uu in kg/m (Prestero).
    sway_damping
        -Y_uv in kg/m: lift of body and fins (Prestero).
    sway_turning
        Y_ur in kg: added mass and lift of the fins in a turn (Prestero).
    sway_rudder
        Y_d in kg/m per radian of rudder (Prestero).
    turning_gain
        k in 1/m per radian of rudder: a turn of 20.3 m radius at 15 degrees, as of Fossen's
        REMUS 100 at 1.67 m/s; his turns are from 25.7 m at 0.83 m/s to 18.5 m at 2.55 m/s.
    turning_length
        l in metres: (I_zz - N_dr) / -N_ur = 8.33 kg m2 / 2.00 kg m (Prestero). At 1 m/s that
        is a time constant of 4.2 s; Fossen's REMUS 100 has 5 s at low speed.
    rudder_limit
        In radians; 15 degrees (REMUS 100 of Fossen's simulator).
    yaw_rate_limit
        In radians per second; 5 degrees per second (the same).
    frequency, damping
        Natural frequency in rad/s and relative damping that the autopilot gives the heading; six
        times as fast as the guidance's V / lookahead = 0.05 rad/s, critically damped.
    """

    speed: float
    mass: float = 30.48
    surge_added_mass: float = 0.93
    sway_added_mass: float = 35.5
    drag: float = 1.62
    sway_damping: float = 28.6
    sway_turning: float = 5.22
    sway_rudder: float = 9.64
    turning_gain: float = 0.19
    turning_length: float = 4.165
    rudder_limit: float = math.radians(15.0)
    yaw_rate_limit: float = math.radians(5.0)
    frequency: float = 0.3
    damping: float = 1.0

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            if not 0.0 < value < math.inf:
                raise InputError("must be positive and finite", field=field.name, value=value)

    @property
    def motion(self) -> Motion:
        """The coefficients of the equations, each divided by its mass."""
        surge_mass = self.mass + self.surge_added_mass
        sway_mass = self.mass + self.sway_added_mass
        numbers = (
            self.drag * self.speed**2 / surge_mass,
            self.drag / surge_mass,
            sway_mass / surge_mass,
            self.sway_damping / sway_mass,
            (self.mass - self.sway_turning) / sway_mass,
            self.sway_rudder / sway_mass,
            self.turning_gain,
            self.turning_length,
            self.rudder_limit,
            self.yaw_rate_limit,
            self.frequency,
            self.damping,
        )
        return Motion(*map(float, numbers))

    def steady_turn(self, rudder: float) -> SteadyTurn:
        """The turn that a rudder angle in radians, not 0, leads to in still water."""
        slip_length = (
            self.mass - self.sway_turning + self.sway_rudder / self.turning_gain
        ) / self.sway_damping
        loss = (self.mass + self.sway_added_mass) * slip_length / self.drag
        curvature = self.turning_gain * min(abs(rudder), self.rudder_limit)
        surge = self.speed / math.sqrt(1.0 + loss * curvature**2)
        if curvature * surge > self.yaw_rate_limit:
            surge = math.sqrt(self.speed**2 - loss * self.yaw_rate_limit**2)
            curvature = self.yaw_rate_limit / surge
        slip = slip_length * curvature
        speed = surge * math.hypot(1.0, slip)
        yaw_rate = math.copysign(curvature * surge, rudder)
        return SteadyTurn(speed, speed / abs(yaw_rate), yaw_rate, math.atan(slip))

    @property
    def turning_radius(self) -> float:
        """Least radius of a steady turn in metres."""
        return self.steady_turn(self.rudder_limit).radius

    def under_way(self, x: float, y: float, heading: float) -> State:
        """At a position, at its speed, on a heading in radians anticlockwise from east."""
        return State(float(x), float(y), float(heading), float(self.speed), 0.0, 0.0)


@kernel
def rudder_angle(motion: Motion, error: float, surge: float, yaw_rate: float) -> float:
    """The autopilot: rudder angle in radians for a heading error in radians."""
    speed = max(surge, _CREEP)
    gain, time = motion.turning_gain * speed, motion.turning_length / speed
    wanted = (
        motion.frequency**2 * time * error
        - (2.0 * motion.damping * motion.frequency * time - 1.0) * yaw_rate
    ) / gain
    most = min(motion.rudder_limit, motion.yaw_rate_limit / gain)
    return min(max(wanted, -most), most)


@kernel
def advance(
    motion: Motion, grid: CurrentGrid, state: State, heading: float, t: float, step: float
) -> State:
    """One step of Runge and Kutta's rule, the commanded heading in radians held meanwhile."""
    half = 0.5 * step
    k1 = _rates(motion, grid, state, heading, t)
    k2 = _rates(motion, grid, _moved(state, k1, half), heading, t + half)
    k3 = _rates(motion, grid, _moved(state, k2, half), heading, t + half)
    k4 = _rates(motion, grid, _moved(state, k3, step), heading, t + step)
    sixth = step / 6.0
    middle = _moved(_moved(state, k1, sixth), k2, 2.0 * sixth)
    return _moved(_moved(middle, k3, 2.0 * sixth), k4, sixth)


@kernel
def _rates(motion: Motion, grid: CurrentGrid, state: State, heading: float, t: float) -> State:
    """The right-hand sides, with the rudder of the autopilot."""
    u, v, r = state.surge, state.sway, state.yaw_rate
    east, north = velocity(grid, state.x, state.y, t)
    ahead, left = math.cos(state.heading), math.sin(state.heading)
    rudder = rudder_angle(motion, heading - state.heading, u, r)
    return State(
        u * ahead - v * left + east,
        u * left + v * ahead + north,
        r,
        motion.thrust - motion.drag * u * abs(u) + motion.coupling * v * r,
        -u * (motion.sway_damping * v + motion.sway_turning * r + motion.sway_rudder * u * rudder),
        u * (motion.turning_gain * u * rudder - r) / motion.turning_length,
    )


@kernel
def _moved(state: State, rates: State, step: float) -> State:
    return State(
        state.x + step * rates.x,
        state.y + step * rates.y,
        state.heading + step * rates.heading,
        state.surge + step * rates.surge,
        state.sway + step * rates.sway,
        state.yaw_rate + step * rates.yaw_rate,
    )
