r"""Straight legs: recognised where nothing else can be much faster.

In uniform flow the straight leg is the fastest path (`fiveroute.paths.zermelo`). Elsewhere
`straight_gaps` bounds by what share the straight leg, of time T and ground speed g, is slower than
the fastest path, without searching for that. Let s run along the leg from -L/2 to L/2 and n across
it. By a calibration (Carathéodory): if a function f has

    H(f) = V |grad f| + c . grad f <= 1 + E

wherever a path may go, then f grows along every path at most by 1 + E a second, so that every path
takes at least (f(goal) - f(start)) / (1 + E). Here

    f(s, n) = integral of ds / g(s, 0) + b n - k s n^2,

with g on the leg's line, so that f(goal) - f(start) = T. The theorem is T <= (1 + E) T_best. E is
bounded in closed form by one number, the Lipschitz constant G of the current:

- A path no slower than the leg keeps within the ellipse with foci start and goal and major axis
  2 S = (V + m) T, where m bounds the water's speed in it; |s| <= S, |n| <= N = sqrt(S^2 - L^2/4).
- On the leg's line the vector p = (1/g, -c_n/(w g)), w = sqrt(V^2 - c_n^2), along the heading has
  V |p| + c.p = 1 and V p/|p| + c = (g, 0). Let b be its second component in the middle: elsewhere
  it is within B of b, by the change G S of c at most and p's derivative with respect to c.
- grad f = p + q with |q_s| <= k n^2 and |q_n| <= B + 2 k S |n|. By |p + q| <= |p| + p.q / |p| +
  q^2 / (2 |p|) and |c(s, n) - c(s, 0)| <= G |n|,

      H <= 1 - g k n^2 + V (q_s^2 + q_n^2) / (2 |p|) + G |n| (|p| + |q|),

  which is 1 plus a quadratic e0 + e1 |n| - e2 n^2, of maximum E = e0 + e1^2 / (4 e2).

E is of second order in G L / V, as is the gain that bending the path can bring. The bound holds in
steady currents; barriers only take paths away, so that it is enough that the leg itself is clear.

References
----------
C. Carathéodory, "Variationsrechnung und partielle Differentialgleichungen erster Ordnung",
Teubner 1935 (calibrations). E. Zermelo 1931, doi 10.1002/zamm.19310110205 (the problem).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fiveroute.kernels import kernel
from fiveroute.ocean.barriers import leg_clearance
from fiveroute.ocean.current_grid import CurrentGrid, velocity
from fiveroute.paths.current_bounds import fastest_bound, gradient_within
from fiveroute.paths.legs import leg_time
from fiveroute.paths.waters import Waters

__all__ = ["are_straight", "straight_gaps"]

Floats = NDArray[np.float64]

_ROUNDS = 4  # of making the ellipse smaller


def are_straight(
    waters: Waters, starts: ArrayLike, goals: ArrayLike, *, tolerance: float = 1e-4
) -> NDArray[np.bool_]:
    """Which straight legs are clear, and proved no slower than 1 + tolerance times the best.

    Parameters
    ----------
    waters
        The ocean and the vehicle.
    starts, goals
        Positions in metres, shape (k, 2).
    tolerance
        Share of the best time.

    Returns
    -------
    array
        Shape (k,).
    """
    tails, heads = np.array(starts, dtype=np.float64), np.array(goals, dtype=np.float64)
    straight = np.array(
        [
            _may_be_proved(waters.grid, tail, head, waters.speed, tolerance)
            and leg_clearance(waters.barriers, *tail, *head) >= 0.0
            for tail, head in zip(tails, heads, strict=True)
        ],
        dtype=np.bool_,
    )
    straight[straight] = straight_gaps(waters, tails[straight], heads[straight]) <= tolerance
    return straight


def straight_gaps(waters: Waters, starts: Floats, goals: Floats) -> Floats:
    """Proved bounds E on T / T_best - 1 of straight legs, whatever barriers there are, shape (k,).

    Infinite where nothing is proved.

    Parameters
    ----------
    waters
        The ocean and the vehicle.
    starts, goals
        Positions in metres, shape (k, 2).
    """
    grid, fastest = waters.grid, fastest_bound(waters.grid)
    if fastest > 0.0 and not grid.is_steady:
        return np.full(len(starts), math.inf)
    return np.array(
        [
            _straight_gap(grid, start, goal, waters.speed, fastest)
            for start, goal in zip(starts, goals, strict=True)
        ]
    )


@kernel
def _may_be_proved(
    grid: CurrentGrid, start: Floats, goal: Floats, speed: float, tolerance: float
) -> bool:
    """Whether E, which grows with G, may be small: with the G seen on the leg, in no ellipse."""
    x, y = 0.5 * (start[0] + goal[0]), 0.5 * (start[1] + goal[1])
    length = math.hypot(goal[0] - start[0], goal[1] - start[1])
    if length == 0.0:
        return True
    u, v = velocity(grid, x, y, 0.0)
    gradient = 0.0
    for part in (-0.5, -0.25, -0.1, 0.1, 0.25, 0.5):
        there = velocity(
            grid, x + part * (goal[0] - start[0]), y + part * (goal[1] - start[1]), 0.0
        )
        change = math.hypot(there[0] - u, there[1] - v)
        gradient = max(gradient, change / (abs(part) * length))
    east, north = (goal[0] - start[0]) / length, (goal[1] - start[1]) / length
    flow = u * east + v * north, v * east - u * north
    least: float = _excess(flow, speed, math.hypot(u, v), gradient, 0.5 * length, 0.0)
    return least <= tolerance


@kernel
def _straight_gap(
    grid: CurrentGrid, start: Floats, goal: Floats, speed: float, fastest: float
) -> float:
    """E by the theorem, in an ellipse that shrinks as the current in it is known better."""
    x0, y0 = start
    x1, y1 = goal
    length = math.hypot(x1 - x0, y1 - y0)
    if length == 0.0 or fastest == 0.0:
        return 0.0
    time = leg_time(grid, x0, y0, x1, y1, 0.0, speed)
    if not math.isfinite(time):
        return math.inf
    x, y = 0.5 * (x0 + x1), 0.5 * (y0 + y1)
    u, v = velocity(grid, x, y, 0.0)
    east, north = (x1 - x0) / length, (y1 - y0) / length
    half, across, gradient = 0.0, 0.0, 0.0
    for _ in range(_ROUNDS):
        half = max(0.5 * (speed + fastest) * time, 0.5 * length)
        across = math.sqrt(half**2 - 0.25 * length**2)
        width = math.hypot(half * east, across * north)
        height = math.hypot(half * north, across * east)
        gradient = gradient_within(grid, 0, x - width, y - height, x + width, y + height)
        fastest = min(fastest, math.hypot(u, v) + gradient * half)
    flow = u * east + v * north, v * east - u * north
    return _excess(flow, speed, fastest, gradient, half, across)


@kernel
def _excess(
    flow: tuple[float, float],
    speed: float,
    fastest: float,
    gradient: float,
    half: float,
    across: float,
) -> float:
    """E from the flow along and across in the middle, m, G, and the half axes S and N.

    `ahead` and `slowest` bound w and g from below, `tilt` is B, `bend` bounds V / (2 |p|), and
    e2 = inward k - outward k^2.
    """
    change = gradient * half
    sideways = abs(flow[1]) + change
    if sideways >= speed:
        return math.inf
    ahead = math.sqrt(speed**2 - sideways**2)
    slowest = flow[0] + math.sqrt(speed**2 - flow[1] ** 2) - speed / ahead * change
    if slowest <= 0.0:
        return math.inf
    tilt = change * math.hypot(
        sideways / (ahead * slowest**2),
        1.0 / (ahead * slowest)
        + sideways**2 * (1.0 / (ahead**3 * slowest) + 1.0 / (ahead**2 * slowest**2)),
    )
    bend = 0.5 * speed * (speed + fastest)
    inward = slowest - gradient * (2.0 * half + across)
    if inward <= 0.0:
        return math.inf
    outward = bend * (across**2 + 4.0 * half**2)
    k = inward / (2.0 * outward)  # makes e2 largest
    e1 = 4.0 * bend * k * half * tilt + gradient * (speed / (ahead * slowest) + tilt)
    return bend * tilt**2 + e1**2 / (2.0 * inward * k)
