"""Labels: partial routes from one end, those that a better one replaces left out.

A label at node i is a partial route from the origin (the start, or the destination over
reversed legs) with its time, its value, the nodes it remembers and the state of the cuts. In
the ng-route relaxation of Baldacci, Mingozzi and Roberti (2011, doi 10.1287/opre.1110.0975) every
node i has a neighbourhood N_i; at i, a route remembers of its nodes those that were in the
neighbourhoods of all nodes since. It may not visit what it remembers, but may return to what it
forgot. The larger the neighbourhoods, the closer to elementary routes.

Label a replaces label b at the same node if it takes no more time, remembers no more, and is worth
as much even after the cuts that only a is half-way into have taken their price.

A route r pays sigma_S for a subset-row cut S = {i, j, k} for every second visit to S (M. Jepsen
et al. 2008, doi 10.1287/opre.1070.0449); a cut of limited memory (D. Pecin et al. 2017, doi
10.1287/ijoc.2016.0744) forgets the first visit when the route leaves the cut's memory.

Labels grow in order of time, up to half of the horizon or so; `fiveroute.models.branch_price.join`
puts both halves together.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.models.branch_price.buckets import Buckets, enter, is_replaced, priced, replace
from fiveroute.models.branch_price.completion import completion_bound

__all__ = [
    "BUCKET",
    "COUNT",
    "DONE",
    "FULL",
    "NODE",
    "PARENT",
    "PAUSED",
    "PENDING",
    "Graph",
    "extend_labels",
    "members_mask",
    "promising",
]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

NODE, PARENT, PENDING = 0, 1, 2
"""Columns of the links of a label: node, label before, next to grow."""

COUNT, BUCKET = 0, 1
"""Entries of the state of a search: number of labels, and bucket under way."""

DONE, PAUSED, FULL = 0, 1, 2
"""How a call ends: all labels grown, work for one call done, or no room for more labels."""

_EPS_TIME, _EPS_VALUE = 1e-13, 1e-13  # relative differences that are rounding, not merit


class Graph(NamedTuple):
    """The nodes worth a visit, numbered anew, and all that the kernels know of them.

    Parameters
    ----------
    nodes
        Their numbers in the problem, shape (size,); the start comes first, the destination last.
    leg
        Times of the legs with the service at their heads in seconds, shape (size, size).
    gain
        rho_i - pi_i, shape (size,).
    members, place
        Nodes of every neighbourhood, shape (size, largest), -1 beyond the last; and the place of
        every node among them, shape (size, size), -1 where it is none.
    in_cut, recall
        Cuts that contain a node, and cuts that remember there, in bits, shape (size,).
    sigma
        Price of the cut of every bit.
    toll
        What a route pays a second of its legs.
    """

    nodes: Ints
    leg: Floats
    gain: Floats
    members: Ints
    place: Ints
    in_cut: Ints
    recall: Ints
    sigma: Floats
    toll: float


@kernel
def members_mask(mask: int, members: Ints, place: Ints, node: int) -> int:
    """What a label that remembers `mask`, places in `members`, remembers at the next node."""
    new: int = 1 << place[node]
    for b in range(len(members)):
        if members[b] < 0:
            break
        if mask >> b & 1 and place[members[b]] >= 0:
            new |= 1 << place[members[b]]
    return new


@kernel
def extend_labels(
    graph: Graph,
    rest: Floats,
    nearest: Ints,
    step: float,
    limits: Floats,
    floors: Floats,
    half: float,
    exact: bool,
    scale: float,
    time: Floats,
    value: Floats,
    masks: Ints,
    links: Ints,
    kept: Ints,
    shelf: Buckets,
    waiting: Ints,
    state: Ints,
    work: int,
) -> int:
    """Grow labels in the order of their time; stop after `work` extensions or when full.

    The arrays from `time` on are changed in place. `kept` tells whether no other label replaces
    one, `waiting` the first label to grow of every span of time, shape (buckets,).
    """
    _, leg, gain, members, place, in_cut, recall, sigma, toll = graph
    size, buckets = shelf.first.shape
    origin = links[0, NODE]
    target = size - 1 - origin
    horizon = limits[-1]
    width = (horizon if horizon > 0.0 else 1.0) / buckets
    eps_time, eps_value = _EPS_TIME * horizon, _EPS_VALUE * scale
    alone = rest[:, :, :1].copy()  # of walks that may remember anything: small, and near at hand
    done = 0
    while state[BUCKET] < buckets:
        label = waiting[state[BUCKET]]
        if label < 0:
            state[BUCKET] += 1
            continue
        if done > work:
            return PAUSED
        if state[COUNT] + size > len(time) or shelf.state[0] + size > len(shelf.chain):
            return FULL
        waiting[state[BUCKET]] = links[label, PENDING]
        if kept[label] == 0 or time[label] > half:
            continue
        i = links[label, NODE]
        for j in range(1, size):
            if j == size - 1:
                j = target
            if j in (i, origin) or (j == target and origin > 0):
                continue
            t = time[label] + leg[i, j]
            if t > horizon:
                continue
            done += 1
            if place[i, j] >= 0 and masks[label, 0] >> place[i, j] & 1:
                continue
            cuts, paid = _with_cuts(masks[label, 1], in_cut[j], recall[j], sigma)
            v = value[label] + gain[j] - toll * leg[i, j] - paid
            if not promising(alone, step, limits, floors, t, v - gain[j], j, 0):
                continue
            mask = 0
            if j != target:
                mask = members_mask(masks[label, 0], members[i], place[j], j)
            known = _near_of(mask, nearest[j])
            if not promising(rest, step, limits, floors, t, v - gain[j], j, known):
                continue
            bucket = min(int(t / width), buckets - 1)
            if j != target:
                looks = is_replaced(
                    shelf, sigma, exact, t + eps_time, v - eps_value, mask, cuts, j, bucket
                )
                done += abs(looks)
                if looks < 0:
                    continue
                done += replace(
                    shelf, sigma, exact, t - eps_time, v + eps_value, mask, cuts, j, bucket, kept
                )
            new = state[COUNT]
            state[COUNT] += 1
            time[new], value[new], masks[new, 0], masks[new, 1] = t, v, mask, cuts
            links[new, NODE], links[new, PARENT], kept[new] = j, label, 1
            if j != target:
                enter(shelf, j, bucket, t, v, mask, cuts, new)
                links[new, PENDING] = waiting[bucket]
                waiting[bucket] = new
    return DONE


@kernel
def _with_cuts(cuts: int, in_cut: int, recall: int, sigma: Floats) -> tuple[int, float]:
    """State of the cuts after a visit, and what it pays for them."""
    kept = cuts & recall
    paid = kept & in_cut
    return kept ^ in_cut, priced(paid, sigma) if paid else 0.0


@kernel
def _near_of(mask: int, places: Ints) -> int:
    """The bits of a memory at some places, those at -1 left out."""
    known = 0
    for b in range(len(places)):
        if places[b] >= 0:
            known |= (mask >> places[b] & 1) << b
    return known


@kernel
def promising(
    rest: Floats,
    step: float,
    limits: Floats,
    floors: Floats,
    t: float,
    v: float,
    j: int,
    known: int,
) -> bool:
    """Whether some completion may be worth more than the floor of some class of AUVs."""
    for c in range(len(limits)):
        if v + completion_bound(rest, step, limits[c] - t, j, known) > floors[c]:
            return True
    return False
