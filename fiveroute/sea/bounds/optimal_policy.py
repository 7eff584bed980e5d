"""The best that one AUV can do online: the exact policy over sets of visited nodes.

`fiveroute.sea.courses.recourse` looks ahead along one order of the nodes. Here nothing is given:
with the set S of nodes visited, at node i and with the time tau left, the AUV can expect

    V(S, i, tau) = max{ -c P(f(t_ih) > tau),
                        max over j not in S of rho_j + E V(S + j, j, tau - f(t_ij) - t_j) },

h being the destination, c the price of a late return, and V = -c where tau < 0. It sails to the j
for which the maximum is taken. This is dynamic programming over 2^n sets, with the same law of the
legs, the same steps of time and the same price as in `recourse`, so that the difference to a
planner that looks ahead is the planner's alone. It needs 36 MB for 10 nodes and
170 MB for 12, which are the most.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.kernels import kernel
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.sea.courses.recourse import gain_of, gains, toll_home
from fiveroute.sea.run import Run

__all__ = ["MOST_NODES", "OptimalPolicy", "Steersman"]

MOST_NODES = 12
"""Nodes that a policy is computed for at most."""


class OptimalPolicy:
    """What an AUV does best, whatever its luck.

    Parameters
    ----------
    view
        What the AUV expects, with the price of a late return.

    Raises
    ------
    InputError
        If there are more than `MOST_NODES` nodes.
    """

    def __init__(self, view: Outlook) -> None:
        nodes = len(view.profit) - 2
        if nodes > MOST_NODES:
            raise InputError(
                f"an exact policy is for {MOST_NODES} nodes at most", field="nodes", value=nodes
            )
        self.view = view
        self._values = np.empty((1 << nodes, nodes + 1, view.late.shape[1]))
        _fill(view, self._values)

    def worth(self, time: float) -> float:
        """Data less price that an AUV can expect at the start, `time` seconds being left."""
        return self._look((), 0, time)[1]

    def next_stop(self, visited: tuple[int, ...], at: int, left: float) -> int:
        """The vertex after `at`, with `left` seconds left."""
        return self._look(visited, at, left)[0]

    def _look(self, visited: tuple[int, ...], at: int, left: float) -> tuple[int, float]:
        seen = sum(1 << (node - 1) for node in visited)
        return _choose(self.view, self._values, seen, at, left)


class Steersman:
    """Steers the one AUV of a run by an optimal policy.

    Parameters
    ----------
    policy
        The policy.
    run
        The run.
    """

    def __init__(self, policy: OptimalPolicy, run: Run) -> None:
        self.policy, self.run = policy, run
        self.visited: tuple[int, ...] = ()

    def steer(self, auv: int, t: float) -> int:
        """The next vertex."""
        vessel = self.run.vessels[auv]
        vertex = self.policy.next_stop(self.visited, vessel.at, vessel.budget - t)
        self.visited = (*self.visited, vertex)
        return vertex

    def come_home(self, auv: int, t: float) -> None:
        """Nothing is left to do."""


@kernel
def _choose(
    view: Outlook, values: NDArray[np.float64], seen: int, i: int, left: float
) -> tuple[int, float]:
    """The vertex to sail to from i after a set of nodes, and V."""
    nodes = values.shape[1] - 1
    best, worth = nodes + 1, -toll_home(view, i, left)
    for j in range(1, nodes + 1):
        if seen >> (j - 1) & 1:
            continue
        gain = gain_of(view, i, j, left, values[seen | 1 << (j - 1), j])
        if gain > worth:
            best, worth = j, gain
    return best, worth


@kernel
def _fill(view: Outlook, values: NDArray[np.float64]) -> None:
    """Fill in V for every set of visited nodes, their last one, and the time left.

    Larger sets have larger numbers, so that those that come next are known.
    """
    nodes = values.shape[1] - 1
    gain = np.empty(values.shape[2])
    for seen in range(len(values) - 1, -1, -1):
        for i in range(nodes + 1):
            if (i == 0) != (seen == 0) or (i > 0 and not seen >> (i - 1) & 1):
                continue  # the start is left once, and a last node has been visited
            here = values[seen, i]
            for g in range(len(gain)):
                here[g] = -view.price * view.late[i, g]
            for j in range(1, nodes + 1):
                if seen >> (j - 1) & 1:
                    continue
                gains(view, i, j, values[seen | 1 << (j - 1), j], gain)
                for g in range(len(gain)):
                    here[g] = max(here[g], gain[g])
