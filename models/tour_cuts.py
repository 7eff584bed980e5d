"""Cuts for the giant route: inequalities that a fractional point violates.

Start and destination count as one vertex, the depot 0, so that a route is a closed tour.
With x(S : S') the sum of the links between S and its complement S', every tour satisfies

    sub-tour elimination   x(S : S') >= 2                                    (7), (8)

for every set S of nodes, found exactly by maximum flows from the depot, and

    blossom   x((S : S') - F) - x(F) >= 1 - |F|,   F a subset of (S : S') of odd size,

because 2 x(S inside) = 2 |S| - x(S : S') is even (Edmonds 1965): a tour cannot cross
from S to S' by exactly the odd set F. Given S, the best F holds the links above one half,
made odd by the cheapest change. Sets S are guessed: the connected components of the
links that are neither zero nor nearly one (Grötschel and Holland 1991).

Both hold for arcs as well, the two directions between a pair of vertices counting together.

References
----------
J. Edmonds, "Maximum matching and a polyhedron with 0,1-vertices", J. Research NBS 69B,
1965, doi 10.6028/jres.069B.013.
M. Grötschel and O. Holland, "Solution of large-scale symmetric travelling salesman
problems", Mathematical Programming 51, 1991, doi 10.1007/BF01586932.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from fiveroute.limits import Clock
from fiveroute.models.max_flow_cuts import violated_sets

__all__ = ["Cut", "Pairs", "violated_cuts"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Booleans = NDArray[np.bool_]

_ZERO = 1e-6
"""Value of a link that counts as none, or as one when that near to it."""

_VIOLATED = 1e-2
"""Least violation worth a blossom."""

_ENOUGH = 200
"""Number of violated sets after which to stop looking."""

_SLICE = 400_000
"""Flows times links between two looks at the clock."""


@dataclass(frozen=True, slots=True)
class Cut:
    """An inequality weights x >= least over the links.

    Parameters
    ----------
    links
        Places of the links in it, shape (k,).
    weights
        Their coefficients, shape (k,).
    least
        Right side.
    """

    links: Integers
    weights: Floats
    least: float


@dataclass(frozen=True, slots=True)
class Pairs:
    """The pairs of vertices that links join, depot merged.

    Parameters
    ----------
    ends
        Vertices of every pair, the lower first, shape (2, p).
    of_link
        Pair of every link, shape (m,).
    nodes
        Number n of nodes beside the depot.
    """

    ends: Integers
    of_link: Integers
    nodes: int

    @classmethod
    def of(cls, tails: Integers, heads: Integers, nodes: int) -> Pairs:
        """Merge start and destination, n + 1, and the two directions of each link."""
        tails, heads = tails % (nodes + 1), heads % (nodes + 1)
        key = np.minimum(tails, heads) * (nodes + 1) + np.maximum(tails, heads)
        unique, of_link = np.unique(key, return_inverse=True)
        return cls(np.stack(np.divmod(unique, nodes + 1)), of_link, nodes)

    def total(self, values: Floats) -> Floats:
        """Sum of the link values of every pair, shape (p,)."""
        sums = np.zeros(self.ends.shape[1])
        np.add.at(sums, self.of_link, values)
        return sums

    def crossing(self, members: Booleans) -> Booleans:
        """Pairs with exactly one end in a vertex set, shape (p,)."""
        return np.asarray(members[self.ends[0]] != members[self.ends[1]])


def violated_cuts(pairs: Pairs, values: Floats, clock: Clock) -> list[Cut]:
    """Sub-tour eliminations that the link values violate; blossoms where there are none.

    There may be more of either, and any where the clock has expired.
    """
    total = pairs.total(values)
    cuts = [_subtour(pairs, members) for members in _separated(pairs, total, clock)]
    return cuts or list(_blossoms(pairs, total))


def _separated(pairs: Pairs, total: Floats, clock: Clock) -> Booleans:
    """Node sets that violate a sub-tour elimination, shape (any, n + 1).

    Vertices joined by a link of value one need not be told apart (Padberg and Rinaldi 1990).
    """
    labels = _components(pairs, total >= 1.0 - _ZERO)
    used = np.flatnonzero(total > 0.0)
    tails, heads = labels[np.hstack((pairs.ends[:, used], pairs.ends[::-1, used]))]
    values, depot = np.tile(total[used], 2), int(labels[0])
    waiting = np.setdiff1d(labels, [depot])
    portion = 1 + _SLICE // (1 + len(values))
    found = np.zeros((0, labels.max() + 1), np.bool_)
    while len(waiting) and len(found) < _ENOUGH and not clock.expired:
        demand = np.zeros(labels.max() + 1)
        demand[waiting[:portion]] = 2.0
        sets = violated_sets(tails, heads, values, demand, source=depot)
        found = np.concatenate((found, sets))
        waiting = waiting[portion:]
        small = sets[2 * sets.sum(axis=1) <= len(demand)]
        waiting = waiting[~small[:, waiting].any(axis=0)]
    return found[:, labels]


def _components(pairs: Pairs, joined: Booleans) -> Integers:
    """Number of the connected component of every vertex, shape (n + 1,)."""
    ends = pairs.ends[:, joined]
    size = pairs.nodes + 1
    graph = coo_array((np.ones(ends.shape[1]), (ends[0], ends[1])), shape=(size, size))
    labels: Integers = connected_components(graph, directed=False)[1].astype(np.int64)
    return labels


def _subtour(pairs: Pairs, members: Booleans) -> Cut:
    links = np.flatnonzero(pairs.crossing(members)[pairs.of_link])
    return Cut(links, np.ones(len(links)), 2.0)


def _blossoms(pairs: Pairs, total: Floats) -> Iterator[Cut]:
    seen = set()
    for most in (1.0 - _ZERO, 0.9, 0.7, 0.5):
        labels = _components(pairs, (total > _ZERO) & (total < most))
        sizes = np.bincount(labels)
        for component in np.flatnonzero((sizes >= 3) & (sizes <= pairs.nodes - 2)):
            members = labels == component
            if members.tobytes() not in seen:
                seen.add(members.tobytes())
                yield from _blossom(pairs, total, members)


def _blossom(pairs: Pairs, total: Floats, members: Booleans) -> Iterator[Cut]:
    """The most violated blossom with this set, if any is."""
    crossing = np.flatnonzero(pairs.crossing(members))
    x = total[crossing]
    teeth = x > 0.5
    violation = 1.0 - np.minimum(x, 1.0 - x).sum()
    if teeth.sum() % 2 == 0:
        cheapest = np.abs(1.0 - 2.0 * x).argmin()
        teeth[cheapest] = not teeth[cheapest]
        violation -= abs(1.0 - 2.0 * x[cheapest])
    if violation < _VIOLATED:
        return
    sign = np.zeros(pairs.ends.shape[1])
    sign[crossing] = np.where(teeth, -1.0, 1.0)
    links = np.flatnonzero(sign[pairs.of_link])
    yield Cut(links, sign[pairs.of_link][links], 1.0 - float(teeth.sum()))
