"""Subset-row cuts: of three nodes, plans visit two on at most one route.

For S = {i, j, k}, adding up the three node rows, halving and rounding down gives

    sum_r floor(visits of r to S / 2) lambda_r <= 1

(M. Jepsen, B. Petersen, S. Spoorendonk and D. Pisinger 2008, doi 10.1287/opre.1070.0449). A
cut remembers visits only at the nodes that the routes of the present solution need to pay for it
(D. Pecin, A. Pessoa, M. Poggi and E. Uchoa 2017, doi 10.1287/ijoc.2016.0744): it is as much
violated, and spares the pricing most of the trouble.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from fiveroute.models.branch_price.duals import Cut
from fiveroute.routes import Route

__all__ = ["MOST_CUTS", "separate"]

Floats = NDArray[np.float64]

MOST_CUTS = 62
"""Cuts whose states fit into one machine word."""

_VIOLATED = 0.03


def separate(routes: list[Route], shares: Floats, size: int, count: int) -> list[Cut]:
    """The `count` most violated cuts.

    Parameters
    ----------
    routes
        Routes of a fractional solution.
    shares
        Their lambda, shape (routes,).
    size
        n + 2.
    count
        Most cuts to return.
    """
    violations, triples = _most_violated(_visits(routes, size), shares, 20 * count)
    cuts: list[Cut] = []
    often = np.zeros(size)
    for k in np.argsort(-violations, kind="stable"):
        nodes = tuple(int(i) for i in triples[k])
        if often[list(nodes)].max() >= max(count // 4, 3):  # spread the cuts over the nodes
            continue
        often[list(nodes)] += 1
        cuts.append(Cut((nodes[0], nodes[1], nodes[2]), _memory(nodes, routes)))
        if len(cuts) == count:
            break
    return cuts


def _visits(routes: list[Route], size: int) -> Floats:
    visits = np.zeros((size, len(routes)))
    for r, route in enumerate(routes):
        visits[list(route), r] = 1.0
    return visits


def _most_violated(visits: Floats, shares: Floats, count: int) -> tuple[Floats, NDArray[np.int64]]:
    """Violations and triples i < j < k, at most `count` for every i."""
    together = (visits * shares) @ visits.T
    parts = list(_violations(visits, shares, together, count))
    if not parts:
        return np.zeros(0), np.zeros((0, 3), dtype=np.int64)
    return np.concatenate([v for v, _ in parts]), np.concatenate([t for _, t in parts])


def _violations(
    visits: Floats, shares: Floats, together: Floats, count: int
) -> Iterator[tuple[Floats, NDArray[np.int64]]]:
    """Violations of the triples with the smallest node i, for every i."""
    for i in range(1, len(visits) - 2):
        later = np.flatnonzero(together[i, i + 1 :] > 1e-9) + i + 1
        rest = np.arange(i + 1, len(visits) - 1)
        if not len(later):
            continue
        all_three = (visits[later] * (shares * visits[i])) @ visits[rest].T
        paid = (
            together[np.ix_(later, rest)]
            + together[i, later][:, None]
            + together[i, rest]
            - 2.0 * all_three
        )
        rows, columns = np.nonzero(paid > 1.0 + _VIOLATED)
        j, k = later[rows], rest[columns]
        once = (j < k) | ((j > k) & (together[i, k] <= 1e-9))
        rows, columns, j, k = rows[once], columns[once], j[once], k[once]
        violation = paid[rows, columns] - 1.0
        best = np.argsort(-violation, kind="stable")[:count]
        triples = np.stack([np.full(len(best), i), j[best], k[best]], axis=1)
        yield violation[best], triples


def _memory(nodes: tuple[int, ...], routes: list[Route]) -> frozenset[int]:
    """The nodes themselves and those between the first and second visit of every pair."""
    memory = set(nodes)
    for route in routes:
        first = -1
        for place, node in enumerate(route):
            if node not in nodes:
                continue
            if first < 0:
                first = place
            else:
                memory |= set(route[first:place])
                first = -1
    return frozenset(memory)
