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

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.models.branch_price.completion import completion_bound

__all__ = [
    "BUCKET",
    "COUNT",
    "DONE",
    "FULL",
    "KEPT",
    "NEXT",
    "NODE",
    "PARENT",
    "PAUSED",
    "PENDING",
    "extend_labels",
    "members_mask",
    "priced",
    "promising",
]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

NODE, PARENT, NEXT, PENDING, KEPT = 0, 1, 2, 3, 4
"""Columns of the integer part of a label: node, label before, next in its bucket, next to grow,
and whether no other label replaces it."""

COUNT, BUCKET = 0, 1
"""Entries of the state of a search: number of labels, and bucket under way."""

DONE, PAUSED, FULL = 0, 1, 2
"""How a call ends: all labels grown, work for one call done, or no room for more labels."""

_EPS_TIME, _EPS_VALUE = 1e-13, 1e-13  # relative differences that are rounding, not merit


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
    leg: Floats,
    gain: Floats,
    members: Ints,
    place: Ints,
    in_cut: Ints,
    recall: Ints,
    sigma: Floats,
    rest: Floats,
    nearest: Ints,
    step: float,
    limits: Floats,
    floors: Floats,
    toll: float,
    half: float,
    exact: bool,
    scale: float,
    time: Floats,
    value: Floats,
    masks: Ints,
    links: Ints,
    first: Ints,
    top: Floats,
    waiting: Ints,
    state: Ints,
    work: int,
) -> int:
    """Grow labels in the order of their time; stop after `work` extensions or when full.

    The arrays from `time` on are changed in place. `first` and `top` hold the first label and
    the highest value of every bucket, shape (size, buckets); `waiting` the first label to grow.
    """
    size, buckets = first.shape
    origin = links[0, NODE]
    target = size - 1 - origin
    horizon = limits[-1]
    width = (horizon if horizon > 0.0 else 1.0) / buckets
    eps_time, eps_value = _EPS_TIME * horizon, _EPS_VALUE * scale
    done = 0
    while state[BUCKET] < buckets:
        label = waiting[state[BUCKET]]
        if label < 0:
            state[BUCKET] += 1
            continue
        if done > work:
            return PAUSED
        if state[COUNT] + size > len(time):
            return FULL
        waiting[state[BUCKET]] = links[label, PENDING]
        if links[label, KEPT] == 0 or time[label] > half:
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
            mask = 0
            if j != target:
                mask = members_mask(masks[label, 0], members[i], place[j], j)
            known = _near_of(mask, nearest[j])
            if not promising(rest, step, limits, floors, t, v - gain[j], j, known):
                continue
            bucket = min(int(t / width), buckets - 1)
            if j != target:
                looks = _looks(
                    time, value, masks, links, first, top, sigma, exact,
                    t + eps_time, v - eps_value, mask, cuts, j, bucket,
                )  # fmt: skip
                done += abs(looks)
                if looks < 0:
                    continue
                done += _replace(
                    time, value, masks, links, first, top, sigma, exact,
                    t - eps_time, v + eps_value, mask, cuts, j, bucket,
                )  # fmt: skip
            new = state[COUNT]
            state[COUNT] += 1
            time[new], value[new], masks[new, 0], masks[new, 1] = t, v, mask, cuts
            _enter(links, first, new, j, label, bucket)
            top[j, bucket] = max(top[j, bucket], v)
            if j != target:
                links[new, PENDING] = waiting[bucket]
                waiting[bucket] = new
    return DONE


@kernel
def _enter(links: Ints, first: Ints, new: int, node: int, parent: int, bucket: int) -> None:
    """Put a label into its bucket."""
    links[new, NODE], links[new, PARENT], links[new, KEPT] = node, parent, 1
    links[new, NEXT] = first[node, bucket]
    first[node, bucket] = new


@kernel
def _with_cuts(cuts: int, in_cut: int, recall: int, sigma: Floats) -> tuple[int, float]:
    """State of the cuts after a visit, and what it pays for them."""
    kept = cuts & recall
    paid = kept & in_cut
    return kept ^ in_cut, priced(paid, sigma) if paid else 0.0


@kernel
def priced(cuts: int, sigma: Floats) -> float:
    """Sum of the prices of the cuts in a mask."""
    price = 0.0
    for c in range(len(sigma)):
        if cuts >> c & 1:
            price += sigma[c]
    return price


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


@kernel
def _looks(
    time: Floats,
    value: Floats,
    masks: Ints,
    links: Ints,
    first: Ints,
    top: Floats,
    sigma: Floats,
    exact: bool,
    t: float,
    v: float,
    mask: int,
    cuts: int,
    node: int,
    bucket: int,
) -> int:
    """Number of labels looked at, negative if one of them replaces the new one."""
    looks = 1
    for b in range(bucket + 1):
        if top[node, b] < v:
            continue
        label = first[node, b]
        while label >= 0:
            looks += 1
            if value[label] >= v and time[label] <= t:
                if not exact:
                    return -looks
                if masks[label, 0] & ~mask == 0:
                    ahead = masks[label, 1] & ~cuts
                    if ahead == 0 or value[label] - priced(ahead, sigma) >= v:
                        return -looks
            label = links[label, NEXT]
    return looks


@kernel
def _replace(
    time: Floats,
    value: Floats,
    masks: Ints,
    links: Ints,
    first: Ints,
    top: Floats,
    sigma: Floats,
    exact: bool,
    t: float,
    v: float,
    mask: int,
    cuts: int,
    node: int,
    bucket: int,
) -> int:
    """Take out of their buckets the labels that a new one replaces; return how many it saw."""
    looks = 0
    for b in range(bucket, first.shape[1]):
        last, label = -1, first[node, b]
        highest = -np.inf
        while label >= 0:
            looks += 1
            after = links[label, NEXT]
            worse = value[label] <= v and time[label] >= t
            if worse and exact:
                worse = mask & ~masks[label, 0] == 0
                if worse:
                    ahead = cuts & ~masks[label, 1]
                    worse = ahead == 0 or v - priced(ahead, sigma) >= value[label]
            if worse:
                links[label, KEPT] = 0
                if last < 0:
                    first[node, b] = after
                else:
                    links[last, NEXT] = after
            else:
                highest = max(highest, value[label])
                last = label
            label = after
        top[node, b] = highest
    return looks
