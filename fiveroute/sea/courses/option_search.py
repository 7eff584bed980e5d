"""The search for the courses that are worth most to a fleet that may leave nodes out under way.

What the courses of a fleet are worth, options included, is the sum of the V_0 of
`fiveroute.sea.courses.recourse`. Simulated annealing seeks its maximum. A trial takes a string of
nodes from its place and puts it, perhaps reversed, next to a node that is near; or exchanges it for
the string that is there; or reverses the way between the two. Nodes that no AUV has as options are
in a row of their own, which is worth nothing.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.limits import Clock
from fiveroute.randomness import RandomState, below, random_state, uniform
from fiveroute.routes import Route
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.sea.courses.recourse import look_ahead, next_stop
from fiveroute.stops import Ints

__all__ = ["best_options"]

_NEAR = 10  # near vertices among which a string may find a new place
_LONGEST = 4  # nodes of a string, but for one in ten, which goes on to the end
_WARM, _COLD = 0.1, 0.005  # temperatures, as shares of the mean data of a node
_SLICE = 500  # trials between two looks at the clock


class _Courses(NamedTuple):
    """Courses as kernels have them, a row each.

    Parameters
    ----------
    rows
        The start, nodes, and room for all others and the destination, shape (k, n + 3).
    lengths
        Number of nodes on each, shape (k,).
    worths
        V_0 of each, shape (k,).
    """

    rows: Ints
    lengths: Ints
    worths: NDArray[np.float64]

    def copy(self) -> _Courses:
        """The same in arrays of their own."""
        return _Courses(self.rows.copy(), self.lengths.copy(), self.worths.copy())


def best_options(
    view: Outlook,
    routes: Sequence[Route],
    budgets: NDArray[np.float64],
    trials: int,
    rng: np.random.Generator,
    clock: Clock | None = None,
) -> tuple[tuple[Route, ...], float]:
    """The courses found that are worth most, and what they are worth together.

    Parameters
    ----------
    view
        What the AUVs expect.
    routes
        Courses from the start to begin with; nodes on none of them are tried as options.
    budgets
        T_max of every AUV in seconds.
    trials
        Number of trials.
    rng
        Source of the one seed that the kernels draw from.
    clock
        Ends the search early; no limit without one.
    """
    home = len(view.profit) - 1
    idle = sorted(set(range(1, home)).difference(*routes))
    now = _Courses(
        np.zeros((len(routes) + 1, home + 2), np.int64),
        np.array([len(route) for route in (*routes, idle)]),
        np.zeros(len(routes) + 1),
    )
    for row, route in zip(now.rows, (*routes, idle), strict=True):
        row[1 : 1 + len(route)] = route
    distances = view.legs + np.diag(np.full(home + 1, np.inf))
    near = np.ascontiguousarray(np.argsort(distances, axis=1)[:, :_NEAR])
    _reckon(view, now, budgets.copy())
    best = now.copy()
    state, scale = random_state(rng), float(view.profit[1:home].mean()) if home > 1 else 0.0
    for begin in range(0, trials if home > 1 else 0, _SLICE):
        warmth = scale * _WARM * (_COLD / _WARM) ** (begin / trials)
        _anneal(view, now, best, budgets.copy(), near, warmth, _SLICE, state)
        if clock is not None and clock.expired:
            break
    found = zip(best.rows[:-1], best.lengths[:-1].tolist(), strict=True)
    courses = tuple(tuple(row[1 : 1 + length].tolist()) for row, length in found)
    return courses, float(best.worths.sum())


@kernel
def _reckon(view: Outlook, courses: _Courses, budgets: NDArray[np.float64]) -> None:
    """Fill in what courses are worth; the last row, of nodes that nobody has, is worth nothing."""
    values = np.empty((courses.rows.shape[1], view.late.shape[1]))
    for m in range(len(budgets)):
        row, length = courses.rows[m], courses.lengths[m]
        courses.worths[m] = _worth(view, row, length, budgets[m], values)


@kernel
def _worth(
    view: Outlook,
    row: Ints,
    length: int,
    budget: float,
    values: NDArray[np.float64],
) -> float:
    """V_0 of a row of nodes after the start."""
    row[length + 1] = len(view.profit) - 1
    look_ahead(view, row, length + 2, values)
    _, worth = next_stop(view, row, length + 2, 0, budget, values)
    return float(worth)


@kernel
def _anneal(
    view: Outlook,
    now: _Courses,
    best: _Courses,
    budgets: NDArray[np.float64],
    near: Ints,
    warmth: float,
    trials: int,
    state: RandomState,
) -> None:
    """Change courses, and the best of them, in place."""
    size = now.rows.shape[1]
    values = np.empty((size, view.late.shape[1]))
    new = _Courses(np.zeros((2, size), np.int64), np.zeros(2, np.int64), np.zeros(2))
    pair = np.zeros(2, np.int64)
    for _ in range(trials):
        changed = _propose(now, near, pair, new, state)
        change = 0.0
        for k in range(changed):
            m = pair[k]
            new.worths[k] = 0.0
            if m < len(budgets):
                new.worths[k] = _worth(view, new.rows[k], new.lengths[k], budgets[m], values)
            change += new.worths[k] - now.worths[m]
        if changed == 0 or change < warmth * math.log(1.0 - uniform(state)):
            continue
        for k in range(changed):
            m = pair[k]
            now.rows[m, :], now.lengths[m] = new.rows[k], new.lengths[k]
            now.worths[m] = new.worths[k]
        if now.worths.sum() > best.worths.sum() + 1e-9:
            best.rows[:], best.lengths[:], best.worths[:] = now.rows, now.lengths, now.worths


@kernel
def _propose(now: _Courses, near: Ints, pair: Ints, new: _Courses, state: RandomState) -> int:
    """Fill in up to two rows as they would become, and which; returns how many."""
    rows, lengths = now.rows, now.lengths
    idle = len(rows) - 1  # the row of nodes that nobody has
    a, p = _locate(rows, lengths, 1 + below(state, lengths.sum()))
    wanted = near[rows[a, p], below(state, near.shape[1])]
    b, q = _find(rows, lengths, wanted)
    if uniform(state) < 0.1:
        b, q = idle, 0
    elif b < 0:
        b, q = below(state, idle), 0  # the start is near
    if a == idle and b == idle:
        return 0
    count = _string(lengths[a] + 1 - p, state)
    pair[0], pair[1] = a, b
    kind = uniform(state)
    if a == b:
        return _move_within(rows[a], lengths[a], p, count, q, kind, new, state)
    other = 0
    if kind < 0.35 and q > 0 and b != idle:
        other = _string(lengths[b] + 1 - q, state)
        q -= 1
    elif q > 0 and uniform(state) < 0.5:
        q -= 1
    turn = uniform(state) < 0.25
    _splice(rows[a], lengths[a], p - 1, count, rows[b], q + 1, other, False, new.rows[0])
    _splice(rows[b], lengths[b], q, other, rows[a], p, count, turn, new.rows[1])
    new.lengths[0] = lengths[a] - count + other
    new.lengths[1] = lengths[b] - other + count
    return 2


@kernel
def _locate(rows: Ints, lengths: Ints, number: int) -> tuple[int, int]:
    """Row and position of the node of this number, counted row by row from 1."""
    row = 0
    while number > lengths[row]:
        number -= lengths[row]
        row += 1
    return row, number


@kernel
def _find(rows: Ints, lengths: Ints, node: int) -> tuple[int, int]:
    """Row and position of a node; -1 where it is none."""
    for row in range(len(rows)):
        for at in range(1, lengths[row] + 1):
            if rows[row, at] == node:
                return row, at
    return -1, 0


@kernel
def _string(most: int, state: RandomState) -> int:
    """Length of a string: short, or now and then all there is."""
    return most if uniform(state) < 0.1 else 1 + below(state, min(_LONGEST, most))


@kernel
def _move_within(
    row: Ints,
    length: int,
    p: int,
    count: int,
    q: int,
    kind: float,
    new: _Courses,
    state: RandomState,
) -> int:
    """A string moves within its row, or the way between two nodes is turned round."""
    new.lengths[0] = length
    if kind < 0.35:
        low, high = min(p, q + 1), max(p, q)
        new.rows[0, :] = row
        for at in range(low, high + 1):
            new.rows[0, at] = row[low + high - at]
        return 1 if high > low else 0
    if uniform(state) < 0.5 and q > 0:
        q -= 1
    if p - 1 <= q < p + count:
        return 0
    _splice(row, length, p - 1, count, row, 1, 0, False, new.rows[1])  # without the string
    if q >= p + count:
        q -= count
    turn = uniform(state) < 0.25
    _splice(new.rows[1], length - count, q, 0, row, p, count, turn, new.rows[0])
    return 1


@kernel
def _splice(
    row: Ints,
    length: int,
    keep: int,
    drop: int,
    donor: Ints,
    at: int,
    count: int,
    turn: bool,
    new: Ints,
) -> None:
    """Fill in a row that has, after `keep` nodes, not its next `drop` but others of a donor."""
    for k in range(keep + 1):
        new[k] = row[k]
    for k in range(count):
        new[keep + 1 + k] = donor[at + (count - 1 - k if turn else k)]
    for k in range(keep + drop + 1, length + 1):
        new[k - drop + count] = row[k]
