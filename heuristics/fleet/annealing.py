"""Simulated annealing over removals and insertions.

A trial removes strings around a random node and inserts idle nodes. With the worth

    W = sum rho_j y_j - price * sum of durations

it is kept when W_new > W - temperature * E, E exponentially distributed with mean 1
(S. Kirkpatrick, C. D. Gelatt, M. P. Vecchi 1983, doi 10.1126/science.220.4598.671, in the
threshold form). The small price of time makes slack worth something before it is large
enough for a node. The best routes are kept by profit first and total time second.
"""

from __future__ import annotations

import math

import numpy as np

from fiveroute.heuristics.fleet.chains import NEXT, measure, undo
from fiveroute.heuristics.fleet.insertion import insert_nodes
from fiveroute.heuristics.fleet.network import Floats, Ints
from fiveroute.heuristics.fleet.removal import remove_strings
from fiveroute.kernels import kernel
from fiveroute.randomness import RandomState, below, uniform

__all__ = ["BEST_PROFIT", "BEST_TIME", "PROFIT", "anneal"]

PROFIT, BEST_PROFIT, BEST_TIME = 0, 1, 2
"""Entries of `score`."""

LARGEST_EXPONENT = 3.0
"""Largest power of the profit by which nodes are put in order."""

ORDER_PERIOD = 50
"""Trials, besides one for every node, for which a power is kept: powers are slow."""


@kernel
def anneal(
    leg: Floats,
    back: Floats,
    profit: Floats,
    limit: Floats,
    near: Ints,
    stops: Ints,
    time: Floats,
    idle: Ints,
    log: Ints,
    best: Ints,
    score: Floats,
    trials: int,
    temperature: float,
    price: float,
    greed: float,
    state: RandomState,
) -> None:
    """Make `trials` trials at one temperature.

    The chains, their journal, `best` (the stop behind every stop in the best routes),
    `score` (see `PROFIT`) and the random state are changed in place.
    """
    size = len(profit)
    weight = np.empty(size)
    mark = np.zeros(size + 1, np.int64)
    measure(leg, stops, time)
    total = time.sum()
    score[PROFIT] = profit.sum() - profit[idle[1 : idle[0] + 1]].sum()
    for trial in range(trials):
        if trial % (size + ORDER_PERIOD) == 0:
            exponent = LARGEST_EXPONENT * uniform(state)
            for node in range(size):
                weight[node] = profit[node] ** exponent
        log[0, 0] = 0
        seed = below(state, size)
        remove_strings(leg, near, stops, time, idle, log, seed, state)
        insert_nodes(
            leg, back, near, limit, profit, weight, stops, time, idle, log, seed, mark, greed, state
        )
        gain = _gain(profit, log)
        new_total = time.sum()
        threshold = temperature * math.log(1.0 - uniform(state))
        if gain - price * (new_total - total) >= threshold and _in_time(time, limit):
            total = new_total
            score[PROFIT] += gain
            _note_best(stops, total, best, score)
        else:
            undo(leg, stops, time, idle, log)


@kernel
def _gain(profit: Floats, log: Ints) -> float:
    """Profit that the changes in the journal brought."""
    gain = 0.0
    for entry in range(1, log[0, 0] + 1):
        worth = profit[log[entry, 0]]
        gain += worth if log[entry, 1] < 0 else -worth
    return gain


@kernel
def _in_time(time: Floats, limit: Floats) -> bool:
    """Whether every route is in time; removing may lengthen one, if not in a metric."""
    for auv in range(len(time)):  # noqa: SIM110
        if time[auv] > limit[auv]:
            return False
    return True


@kernel
def _note_best(stops: Ints, total: float, best: Ints, score: Floats) -> None:
    """Keep the routes where they collect more than the best, or as much in less time."""
    margin = 1e-9 * max(score[PROFIT], score[BEST_PROFIT])
    more = score[PROFIT] > score[BEST_PROFIT] + margin
    as_much = score[PROFIT] > score[BEST_PROFIT] - margin
    if more or (as_much and total < score[BEST_TIME] * (1.0 - 1e-9)):
        score[BEST_PROFIT] = score[PROFIT]
        score[BEST_TIME] = total
        for stop in range(len(best)):
            best[stop] = stops[stop, NEXT]
