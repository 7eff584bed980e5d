"""What one AUV is worth that pays for the nodes it visits and for coming home late.

Time is cut into K steps, and what a leg takes, service at its head included, is rounded down to
whole ones: an AUV has then more time than at sea, never less. An AUV at node i with k steps left
that remembers a set s of visited nodes can expect at most

    V_i(k, s) = max{ -c P(f_ih > k),  max over j not in s of g_j + E V_j(k - f_ij, s') },

h being the destination, c the price of a late return, g_j what a visit to j brings, and V = -c
where no time is left: an AUV that is late heads for home. A walk remembers of its nodes those near
to all that it has visited since, as in `fiveroute.models.branch_price.completion`, and may come
back to what it has forgotten. So V is an upper bound; with the memory of all nodes it is exact.

`look_behind` is the same for an AUV that knows the luck of a run, see
`fiveroute.sea.bounds.online_bound`.

Values have the shape (n + 2, K + 1, 2 ** memory); at the start only those of K steps are filled in.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.models.branch_price.completion import carried, nearest_nodes
from fiveroute.sea.world import World
from fiveroute.tiers.actuation import expected_legs, overruns

__all__ = ["Chart", "chart", "expectations", "look_ahead", "look_behind", "usage"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bytes = NDArray[np.int8]
Choices = NDArray[np.int16]

_RARE = 1e-5  # probability of the longest times of a leg, which count as the shortest of them
_NEVER = 1e-12  # probability that is left out of account
_QUARTERS = np.arange(4) / 4


class Chart(NamedTuple):
    """All that the kernels know of the sea, in steps.

    Parameters
    ----------
    share, begin, first, width
        Leg (i, j) takes first[i, j] + x steps with probability share[begin[i, j] + x], x below
        width[i, j]; the last three have the shape (n + 2, n + 2).
    quarters
        The least steps that a leg takes in each quarter of all cases, shape (n + 2, n + 2, 4).
    late
        Probability that the leg home takes longer than k steps, shape (n + 2, K + 1).
    order
        Nodes by their expected distance from every vertex, shape (n + 2, n + 2); -1 at the end.
    carry
        What a walk from i to j that remembers s remembers at j; -1 if it may not go there. Shape
        (n + 2, n + 2, 2 ** memory).
    """

    share: Floats
    begin: Ints
    first: Ints
    width: Ints
    quarters: Ints
    late: Floats
    order: Ints
    carry: Bytes

    def new_values(self) -> tuple[Floats, Choices]:
        """Room for values and for what is chosen."""
        shape = (*self.late.shape, self.carry.shape[2])
        return np.zeros(shape), np.zeros(shape, np.int16)


def chart(world: World, steps: int, memory: int, *, to_nearest: bool = False) -> Chart:
    """The law of all legs in steps.

    Parameters
    ----------
    world
        A mission with equal budgets.
    steps
        K. A leg of less than a step counts as one.
    memory
        Number of nodes near to each that a walk remembers.
    to_nearest
        Whether legs are rounded to the nearest step instead of down: V is then near, but no bound.
    """
    problem, law = world.problem, world.law
    horizon = float(problem.allowed[0])
    times = np.linspace(0.0, horizon + horizon / steps, steps + 2)
    size = problem.n + 2
    begin, first, width = (np.zeros((size, size), np.int64) for _ in range(3))
    quarters = np.zeros((size, size, len(_QUARTERS)), np.int64)
    shares, filled = [], 0
    for j in range(1, size - 1):
        longer = overruns(law, j, times - problem.service[j] - 0.5 * times[1] * to_nearest)
        for i in set(range(size - 1)) - {j}:
            first[i, j], share = _in_steps(longer[i])
            begin[i, j], width[i, j] = filled, len(share)
            quarters[i, j] = first[i, j] + np.searchsorted(share.cumsum(), _QUARTERS)
            shares.append(share)
            filled += len(share)
    mean = expected_legs(law)[0]
    nearest = nearest_nodes(mean, memory)
    mean[:, [0, -1]] = np.inf
    np.fill_diagonal(mean, np.inf)
    order = np.argsort(mean, axis=1, kind="stable")
    return Chart(
        np.concatenate(shares),
        begin,
        first,
        width,
        quarters,
        overruns(law, problem.destination, times[:-1]),
        np.where(np.isfinite(np.take_along_axis(mean, order, axis=1)), order, -1),
        np.ascontiguousarray(carried(nearest).transpose(0, 2, 1)),
    )


def _in_steps(longer: Floats) -> tuple[int, Floats]:
    """Least steps of a leg and the probabilities of these and more, rounded down.

    `longer` holds the probabilities that the leg takes longer than 0, 1, 2, ... steps.
    """
    beyond = np.concatenate([[1.0], longer[2:], [0.0]])
    low, high = np.searchsorted(1.0 - beyond[1:], [_NEVER, 1.0 - _RARE])
    beyond[high + 1] = 0.0
    return int(low) + 1, beyond[low : high + 1] - beyond[low + 1 : high + 2]


@kernel
def _expect(
    sea: Chart, i: int, j: int, k: int, price: float, value: Floats, expected: Floats
) -> None:
    """Fill in E V_j(k - f_ij, s), for every s."""
    first, begin = sea.first[i, j], sea.begin[i, j]
    expected[:] = 0.0
    in_time = 0.0
    for x in range(min(sea.width[i, j], k - first + 1)):
        share = sea.share[begin + x]
        in_time += share
        for s in range(len(expected)):
            expected[s] += share * value[j, k - first - x, s]
    expected -= price * (1.0 - in_time)


@kernel
def _at_most(sea: Chart, i: int, j: int, k: int, price: float, value: Floats) -> float:
    """Bound E V_j(k - f_ij, s) for every s, by the quarters of the law."""
    most = 0.0
    for steps in sea.quarters[i, j]:
        most += 0.25 * (value[j, k - steps, 0] if steps <= k else -price)
    return most


@kernel
def look_ahead(sea: Chart, gain: Floats, price: float, value: Floats, choice: Choices) -> None:
    """Fill in V and the next vertex of every AUV; no leg takes less than a step.

    Nodes that cannot be better than those near by, by the quarters of their law, are passed over.
    """
    size, horizon, memories = value.shape
    expected = np.empty(memories)
    for k in range(horizon):
        for i in range(size - 1):
            if i == 0 and k < horizon - 1:
                continue
            value[i, k] = -price * sea.late[i, k]
            choice[i, k] = size - 1
            for j in sea.order[i]:
                if j < 0:
                    break
                most = gain[j] + _at_most(sea, i, j, k, price, value)
                if most <= value[i, k, memories - 1]:
                    continue
                _expect(sea, i, j, k, price, value, expected)
                for s in range(memories):
                    carry = sea.carry[i, j, s]
                    if carry >= 0 and gain[j] + expected[carry] > value[i, k, s]:
                        value[i, k, s] = gain[j] + expected[carry]
                        choice[i, k, s] = j


@kernel
def usage(sea: Chart, choice: Choices) -> tuple[Floats, float]:
    """Expected visits to every vertex, and probability of being late, of who chooses so."""
    size, horizon, memories = choice.shape
    visits, late = np.zeros(size), 0.0
    here = np.zeros((size, horizon, memories))
    here[0, horizon - 1, 0] = 1.0
    for k in range(horizon - 1, -1, -1):
        for i in range(size - 1):
            for s in range(memories):
                share = here[i, k, s]
                if share == 0.0:
                    continue
                j = choice[i, k, s]
                if j == size - 1:
                    late += share * sea.late[i, k]
                    continue
                visits[j] += share
                then, carry = k - sea.first[i, j], sea.carry[i, j, s]
                for x in range(sea.width[i, j]):
                    part = share * sea.share[sea.begin[i, j] + x]
                    if then - x < 0:
                        late += part
                    else:
                        here[j, then - x, carry] += part
    return visits, late


@kernel
def expectations(sea: Chart, gain: Floats, price: float, value: Floats, margin: float) -> Floats:
    """E V_j(k - f_ij, s), shape (n + 2, n + 2, K + 1, 2 ** memory).

    Legs that lose more than a margin to whoever knows no luck are not worth the time: a bound is
    enough, by which luck is taxed too little.
    """
    size, horizon, memories = value.shape
    expected = np.empty((size, size, horizon, memories))
    for i in range(size - 1):
        for j in range(1, size - 1):
            if i == j:
                continue
            for k in range(0 if i else horizon - 1, horizon):
                most = _at_most(sea, i, j, k, price, value)
                if gain[j] + most <= value[i, k, memories - 1] - margin:
                    expected[i, j, k] = most
                else:
                    _expect(sea, i, j, k, price, value, expected[i, j, k])
    return expected


@kernel
def look_behind(
    sea: Chart,
    legs: Ints,
    gain: Floats,
    price: float,
    value: Floats,
    expected: Floats,
    best: Floats,
    choice: Choices,
) -> None:
    """Fill in the most that an AUV gets that knows its luck and pays for it.

    Nodes are passed over that are too bad for that in the light of V.

    Parameters
    ----------
    legs
        Steps that every leg takes, at least 1, shape (n + 2, n + 2).
    value, expected
        V and its `expectations`.
    best, choice
        What is filled in.
    """
    size, horizon, memories = value.shape
    beyond = np.full(size, -np.inf)  # the most that best exceeds value so far
    for k in range(horizon):
        for i in range(size - 1):
            if i == 0 and k < horizon - 1:
                continue
            best[i, k] = -price * sea.late[i, k]
            choice[i, k] = size - 1
            least = best[i, k, 0]
            for j in sea.order[i]:
                if j < 0:
                    break
                then = k - legs[i, j]
                most = gain[j] + expected[i, j, k, 0]
                if most + (beyond[j] if then >= 0 else 0.0) <= least:
                    continue
                least = np.inf
                for s in range(memories):
                    carry = sea.carry[i, j, s]
                    if carry >= 0:
                        worth = gain[j] + expected[i, j, k, carry]
                        if then >= 0:
                            worth += best[j, then, carry] - value[j, then, carry]
                        if worth > best[i, k, s]:
                            best[i, k, s] = worth
                            choice[i, k, s] = j
                    least = min(least, best[i, k, s])
        for i in range(1, size - 1):
            for s in range(memories):
                beyond[i] = max(beyond[i], best[i, k, s] - value[i, k, s])
