"""Sailing a planned track in the true ocean: motion, guidance and avoidance together.

In every step the guidance chooses a heading by the position on the present leg; every ping of the
sonar may replace it by a heading that avoids; the vehicle then moves for a step on the heading
commanded. A waypoint has been reached when the vehicle is abeam of it or about to be, the last
one when it is also near. The steps are Runge and Kutta's of fourth order and half a second long,
a quarter of the shortest time constant of a vehicle at 1 m/s (2.3 s, of sway): a turn of a minute
then errs by less than 0.01 mm.

Where every heading leads into obstacles, the propeller goes astern with the thrust that it has
ahead, which stops the vehicle within (m - X_du) ln 2 / (-2 X_uu) = 6.7 m through the water.

Every voyage ends: where the rest of the way has not become shorter for some time, it is given up,
and the track says whether the current or obstacles were in the way. A track that meets a
barrier ends there. What clearance the vehicle kept is computed from the track it left behind.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fiveroute.errors import InputError
from fiveroute.kernels import kernel
from fiveroute.ocean.barriers import Barriers, clearance, leg_clearance, no_barriers
from fiveroute.ocean.current_grid import CurrentGrid, velocity
from fiveroute.vehicle.dynamics import Motion, State, Vehicle, advance
from fiveroute.vehicle.guidance import Guidance, Steering, adapted, desired_heading
from fiveroute.vehicle.obstacle_avoidance import Avoidance, Lookout, Manoeuvre, avoid, nearby
from fiveroute.vehicle.sailed_track import Outcome, SailedTrack, least_clearance
from fiveroute.vehicle.sonar import land_of, listen
from fiveroute.vehicle.waypoints import Headway, Place, Waypoints, made_good

__all__ = ["STEP", "sail_track"]

Floats = NDArray[np.float64]

STEP = 0.5
"""Seconds in one step of the motion."""

_ECHOES = 512  # that are remembered
_SLOWEST = 20.0  # times what still water takes, after which a voyage is broken off
_X, _Y, _HEADING, _ERROR, _MANOEUVRE = range(5)  # columns of the log
_ARRIVED, _SWEPT, _BLOCKED, _COLLIDED, _LATE = map(int, Outcome)
_UNDER_WAY = -1


class _Task(NamedTuple):
    """What to sail, and when to stop trying."""

    waypoints: Waypoints
    begin: float
    step: float
    reach: float
    patience: float


def sail_track(
    grid: CurrentGrid,
    track: ArrayLike,
    vehicle: Vehicle,
    *,
    barriers: Barriers | None = None,
    guidance: Guidance | None = None,
    avoidance: Avoidance | None = None,
    begin: float = 0.0,
    heading: float | None = None,
    longest: float = math.inf,
    patience: float = 1800.0,
    switch: float = 5.0,
    reach: float = 20.0,
    step: float = STEP,
) -> SailedTrack:
    """Sail a track through the true ocean.

    Parameters
    ----------
    grid
        The true current.
    track
        Waypoints in metres, shape (k, 2).
    vehicle
        The vehicle, which sets off at its speed.
    barriers
        The true obstacles, whether the plan knew them or not; None is open water.
    guidance, avoidance
        How it keeps to the legs, ALOS by default, and how it avoids what its sonar finds.
    begin
        When it sets off, in seconds.
    heading
        On what heading, in radians anticlockwise from east; None takes that of the first leg.
    longest
        Seconds after which the voyage is broken off; twenty times what still water takes at most.
    patience
        Seconds without progress after which it is given up.
    switch
        Metres before a waypoint at which the next leg begins; 5 m as in Fossen's simulator of the
        REMUS 100.
    reach
        Metres from the last waypoint within which it counts as reached, once the vehicle is
        abeam of it; about the turning radius, and within optical range of a node.
    step
        Seconds in one step.
    """
    points = _checked_track(track)
    _require_positive(step=step, patience=patience, longest=longest, switch=switch, reach=reach)
    barriers = _without_edge(barriers or no_barriers())
    pieces = np.hypot(*np.diff(points, axis=0).T)
    waypoints = Waypoints.of(points, switch)
    if heading is None:
        east, north = points[np.argmax(pieces > 0.0) + 1] - points[0]
        heading = math.atan2(north, east)
    time = min(longest, _SLOWEST * waypoints.left[0] / vehicle.speed + patience)
    log = np.empty((math.ceil(time / step) + 1, 5))
    arrivals = np.full(len(points), math.inf)
    motion = vehicle.motion
    count, outcome = _sail(
        motion,
        motion._replace(thrust=-motion.thrust),
        (guidance or Guidance()).steering,
        (avoidance or Avoidance()).lookout(vehicle, barriers.margin),
        grid,
        barriers,
        land_of(barriers),
        _Task(waypoints, *map(float, (begin, step, reach, patience))),
        vehicle.under_way(points[0, 0], points[0, 1], heading),
        log,
        arrivals,
    )
    times = begin + step * np.arange(count, dtype=np.float64)
    return _sailed(Outcome(outcome), times, log, arrivals, barriers)


def _sailed(
    outcome: Outcome, times: Floats, log: Floats, arrivals: Floats, barriers: Barriers
) -> SailedTrack:
    """What the log of a voyage says, as far as it was written."""
    columns = log[: len(times)].T.copy()
    positions = np.ascontiguousarray(columns[[_X, _Y]].T)
    return SailedTrack(
        outcome,
        times,
        positions,
        columns[_HEADING],
        columns[_ERROR],
        columns[_MANOEUVRE].astype(np.int64),
        arrivals,
        least_clearance(barriers, positions),
    )


def _without_edge(barriers: Barriers) -> Barriers:
    """Barriers without the edge of the data, which stops a planner but no vehicle."""
    infinite = math.inf
    return barriers._replace(west=-infinite, south=-infinite, east=infinite, north=infinite)


def _checked_track(track: ArrayLike) -> Floats:
    points = np.array(track, dtype=np.float64)
    if points.ndim != 2 or points.shape[1:] != (2,) or len(points) < 2:
        raise InputError("takes two waypoints at least, (k, 2)", field="track", value=points.shape)
    if not np.isfinite(points).all():
        raise InputError("all waypoints must be finite", field="track")
    return points


def _require_positive(**values: float) -> None:
    for name, value in values.items():
        if not value > 0.0:
            raise InputError("must be positive", field=name, value=value)


@kernel
def _sail(
    motion: Motion,
    astern: Motion,
    steering: Steering,
    lookout: Lookout,
    grid: CurrentGrid,
    barriers: Barriers,
    land: Barriers,
    task: _Task,
    state: State,
    log: Floats,
    arrivals: Floats,
) -> tuple[int, int]:
    """Fill in the log and the arrivals; return the rows that were written and the outcome."""
    echoes, heard, ping = np.empty((_ECHOES, 2)), 0, task.begin
    way, memory, desired = Headway(0, False, math.inf, task.begin), 0.0, state.heading
    manoeuvre, number = Manoeuvre(0.0, desired, -math.inf, False), 0
    free = clearance(barriers, state.x, state.y)  # no barrier is nearer than this
    arrivals[0] = task.begin
    for k in range(len(log)):
        t = task.begin + k * task.step
        calm = manoeuvre.side == 0.0

        # where is it, and is that the end?
        way, place = made_good(task.waypoints, state, way, t, arrivals)
        _write(log, k, state, place, 0 if calm else number)
        outcome = _outcome(task, way, place, manoeuvre, free, state.surge, t)
        if outcome != _UNDER_WAY:
            arrivals[-1] = t if outcome == _ARRIVED else math.inf
            return k + 1, outcome

        # where should it go?
        aim = place.bearing
        if not way.homing:
            aim = desired_heading(steering, place.bearing, place.error, memory)
        if calm and not way.homing:
            memory = adapted(steering, place.error, memory, task.step)
        desired += _wrapped(aim - desired)
        if t >= ping and not manoeuvre.hopeless:
            ping += lookout.beams.period
            if free < lookout.beams.reach:
                free = clearance(barriers, state.x, state.y)
                heard = listen(lookout.beams, barriers, land, state, echoes, heard)
            manoeuvre = _look_out(lookout, grid, echoes, heard, state, desired, manoeuvre, t)
            number += calm and manoeuvre.side != 0.0

        # go there for a step
        heading = desired if manoeuvre.side == 0.0 else manoeuvre.heading
        engine = astern if manoeuvre.hopeless else motion
        moved = advance(engine, grid, state, heading, t, task.step)
        free = _still_free(barriers, free, state, moved)
        state = moved
    return len(log), _LATE


@kernel
def _outcome(
    task: _Task,
    way: Headway,
    place: Place,
    manoeuvre: Manoeuvre,
    free: float,
    surge: float,
    t: float,
) -> int:
    """How the voyage has ended, if it has."""
    if free < 0.0:
        return _COLLIDED
    if way.homing and place.left <= task.reach:
        return _ARRIVED
    stopped = manoeuvre.hopeless and surge <= 0.0
    if stopped or t - way.progressed > task.patience:
        return _BLOCKED if stopped or manoeuvre.blocked >= way.progressed else _SWEPT
    return _UNDER_WAY


@kernel
def _still_free(barriers: Barriers, free: float, state: State, moved: State) -> float:
    """Metres within which no barrier is after a step, by those before it and the way made."""
    free -= math.hypot(moved.x - state.x, moved.y - state.y)
    if free < 0.0:
        return leg_clearance(barriers, state.x, state.y, moved.x, moved.y)
    return free


@kernel
def _look_out(
    lookout: Lookout,
    grid: CurrentGrid,
    echoes: Floats,
    heard: int,
    state: State,
    desired: float,
    manoeuvre: Manoeuvre,
    t: float,
) -> Manoeuvre:
    """Begin, continue or end a manoeuvre by the echoes that are near."""
    if heard == 0:
        return manoeuvre
    near = np.empty((len(echoes), 2))
    number = nearby(echoes, heard, state.x, state.y, lookout.beams.reach, near)
    if number == 0 and manoeuvre.side == 0.0:
        return manoeuvre
    current = velocity(grid, state.x, state.y, t)
    return avoid(lookout, near[:number], state, current, desired, manoeuvre, t)


@kernel
def _wrapped(angle: float) -> float:
    return angle - 2.0 * math.pi * round(angle / (2.0 * math.pi))


@kernel
def _write(log: Floats, k: int, state: State, place: Place, manoeuvre: int) -> None:
    log[k, _X], log[k, _Y], log[k, _HEADING] = state.x, state.y, state.heading
    log[k, _ERROR], log[k, _MANOEUVRE] = place.error, manoeuvre
