"""Put partial routes from the start and from the destination together.

Let H be the half-way point. Every route within the horizon has a first node i that is
reached and served after H, or has none and is a label from the start alone. Its part up to i is
a label from the start, as the node before was grown; its part from i on is a label from the
destination, as from the node after i less than the horizon minus H is left (G. Righini and M.
Salani 2006, doi 10.1016/j.disopt.2006.05.007). Both parts remember i and nothing else in common.

Both halves have paid for the cuts that contain i; the one from the destination is paid back before
both states are matched, and a cut that both are half-way into takes its price.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.models.branch_price.labels import NODE

__all__ = ["join_at", "labels_at"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@kernel
def labels_at(
    value: Floats, time: Floats, links: Ints, kept: Ints, count: int, after: float
) -> Ints:
    """Kept labels with a time beyond `after`, grouped by node, the most valuable first."""
    chosen = np.empty(count, np.int64)
    size = 0
    for label in range(count):
        if kept[label] and time[label] > after:
            chosen[size] = label
            size += 1
    chosen = chosen[:size]
    chosen = chosen[np.argsort(-value[chosen], kind="mergesort")]
    return chosen[np.argsort(links[chosen, NODE], kind="mergesort")]


@kernel
def join_at(
    node: int,
    gain: float,
    own: int,
    in_cut: int,
    sigma: Floats,
    limits: Floats,
    floors: Floats,
    time: Floats,
    value: Floats,
    masks: Ints,
    heads: Ints,
    back_time: Floats,
    back_value: Floats,
    back_masks: Ints,
    tails: Ints,
    start: int,
    work: int,
    found: Floats,
    best: Floats,
    pairs: Ints,
) -> int:
    """Join the labels `heads` from `start` on with `tails`; both the most valuable first.

    Returns
    -------
    int
        Where to go on; ``len(heads)`` when done. `found`, the highest value of every class,
        and the best joins, their values `best` in ascending order and labels `pairs`, are
        changed in place.
    """
    floor = floors.min()
    done = 0
    for h in range(start, len(heads)):
        if done > work:
            return h
        head = heads[h]
        so_far = value[head] - gain
        for tail in tails:
            done += 1
            most = so_far + back_value[tail]
            if in_cut:
                for c in range(len(sigma)):
                    if in_cut >> c & 1 and not back_masks[tail, 1] >> c & 1:
                        most += sigma[c]
            elif most <= floor:
                break
            if most <= floor:
                continue
            t = time[head] + back_time[tail]
            if t > limits[-1] or masks[head, 0] & back_masks[tail, 0] != own:
                continue
            both = masks[head, 1] & (back_masks[tail, 1] ^ in_cut)
            if both:
                for c in range(len(sigma)):
                    if both >> c & 1:
                        most -= sigma[c]
            auv_class = 0
            while t > limits[auv_class]:
                auv_class += 1
            if most > floors[auv_class]:
                found[auv_class] = max(found[auv_class], most)
                if most > best[0]:
                    _keep(best, pairs, most, head, tail)
    return len(heads)


@kernel
def _keep(best: Floats, pairs: Ints, value: float, head: int, tail: int) -> None:
    """Put a join in its place among the best, the worst of them falling out."""
    k = 0
    while k + 1 < len(best) and best[k + 1] < value:
        best[k] = best[k + 1]
        pairs[k, 0], pairs[k, 1] = pairs[k + 1, 0], pairs[k + 1, 1]
        k += 1
    best[k] = value
    pairs[k, 0], pairs[k, 1] = head, tail
