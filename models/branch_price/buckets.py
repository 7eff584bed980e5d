"""Labels kept by node and span of time, side by side in memory.

Nearly all time of a pricing goes into one question: does a label at the same node replace this
one? Labels of a node are therefore kept in buckets by their time, and those of a bucket in blocks
that hold what the question is about in rows, so that whole blocks are compared at once. Only the
first block of a bucket may have gaps, at its end: what leaves a bucket is replaced by its last.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel

__all__ = ["Buckets", "enter", "is_replaced", "new_buckets", "priced", "replace", "with_room"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_BLOCK = 16
_TIME, _VALUE = 0, 1
_MASK, _CUTS, _LABEL = 0, 1, 2
_NEXT, _COUNT = 0, 1
_USED, _FREE = 0, 1


class Buckets(NamedTuple):
    """Labels of every node and span of time.

    Parameters
    ----------
    first
        First block of every bucket, -1 where it is empty, shape (size, buckets).
    top, low
        Bounds on the values in every bucket, shape (size, buckets).
    merit
        Times and values, shape (blocks, 2, labels a block).
    memory
        Remembered nodes, states of the cuts and numbers of the labels, shape
        (blocks, 3, labels a block).
    chain
        Next block of the bucket and number of labels, shape (blocks, 2).
    state
        Number of blocks that were ever used, and the first that is free again or -1.
    """

    first: Ints
    top: Floats
    low: Floats
    merit: Floats
    memory: Ints
    chain: Ints
    state: Ints


def new_buckets(size: int, count: int) -> Buckets:
    """Empty buckets, `count` for each of `size` nodes."""
    blocks = 4 * size
    return Buckets(
        np.full((size, count), -1, dtype=np.int64),
        np.full((size, count), -np.inf),
        np.full((size, count), np.inf),
        np.empty((blocks, 2, _BLOCK)),
        np.empty((blocks, 3, _BLOCK), dtype=np.int64),
        np.empty((blocks, 2), dtype=np.int64),
        np.array([0, -1], dtype=np.int64),
    )


def with_room(buckets: Buckets, count: int) -> Buckets:
    """The same buckets with room for `count` more blocks at least."""
    if buckets.state[_USED] + count <= len(buckets.chain):
        return buckets
    more = max(count, len(buckets.chain))
    grown = (
        np.concatenate([old, np.empty((more, *old.shape[1:]), old.dtype)])
        for old in (buckets.merit, buckets.memory, buckets.chain)
    )
    merit, memory, chain = grown
    return buckets._replace(merit=merit, memory=memory, chain=chain)


@kernel
def priced(cuts: int, sigma: Floats) -> float:
    """Sum of the prices of the cuts in a mask."""
    price = 0.0
    for c in range(len(sigma)):
        if cuts >> c & 1:
            price += sigma[c]
    return price


@kernel
def enter(
    buckets: Buckets, node: int, bucket: int, t: float, v: float, mask: int, cuts: int, label: int
) -> None:
    """Put a label into its bucket; there must be room for another block."""
    first, chain, state = buckets.first, buckets.chain, buckets.state
    block = first[node, bucket]
    if block < 0 or chain[block, _COUNT] == _BLOCK:
        if state[_FREE] >= 0:
            new = state[_FREE]
            state[_FREE] = chain[new, _NEXT]
        else:
            new = state[_USED]
            state[_USED] += 1
        chain[new, _NEXT], chain[new, _COUNT] = block, 0
        block = first[node, bucket] = new
    k = chain[block, _COUNT]
    chain[block, _COUNT] += 1
    merit, memory = buckets.merit, buckets.memory
    merit[block, _TIME, k], merit[block, _VALUE, k] = t, v
    memory[block, _MASK, k], memory[block, _CUTS, k], memory[block, _LABEL, k] = mask, cuts, label
    buckets.top[node, bucket] = max(buckets.top[node, bucket], v)
    buckets.low[node, bucket] = min(buckets.low[node, bucket], v)


@kernel
def is_replaced(
    buckets: Buckets,
    sigma: Floats,
    exact: bool,
    t: float,
    v: float,
    mask: int,
    cuts: int,
    node: int,
    bucket: int,
) -> int:
    """Number of blocks looked at, negative if a label there replaces one of these merits.

    A quick search does not care what a label remembers.
    """
    merit, memory, chain = buckets.merit, buckets.memory, buckets.chain
    other = ~mask if exact else 0
    looks = 1
    for b in range(bucket, -1, -1):
        if buckets.top[node, b] < v:
            continue
        block = buckets.first[node, b]
        while block >= 0:
            looks += 1
            found = False
            for k in range(chain[block, _COUNT]):
                found |= (
                    (merit[block, _VALUE, k] >= v)
                    & (merit[block, _TIME, k] <= t)
                    & (memory[block, _MASK, k] & other == 0)
                )
            if found and (not exact or len(sigma) == 0):
                return -looks
            if found:
                for k in range(chain[block, _COUNT]):
                    worth = merit[block, _VALUE, k]
                    if worth < v or merit[block, _TIME, k] > t or memory[block, _MASK, k] & other:
                        continue
                    ahead = memory[block, _CUTS, k] & ~cuts
                    if ahead == 0 or worth - priced(ahead, sigma) >= v:
                        return -looks
            block = chain[block, _NEXT]
    return looks


@kernel
def replace(
    buckets: Buckets,
    sigma: Floats,
    exact: bool,
    t: float,
    v: float,
    mask: int,
    cuts: int,
    node: int,
    bucket: int,
    kept: Ints,
) -> int:
    """Take out the labels that these merits replace; return the number of blocks looked at.

    `kept` of these labels becomes 0.
    """
    merit, memory, chain, first = buckets.merit, buckets.memory, buckets.chain, buckets.first
    care = -1 if exact else 0
    looks = 0
    for b in range(bucket, first.shape[1]):
        if buckets.low[node, b] > v:
            continue
        block = first[node, b]
        changed = False
        while block >= 0:
            looks += 1
            found = False
            for k in range(chain[block, _COUNT]):
                found |= (
                    (merit[block, _VALUE, k] <= v)
                    & (merit[block, _TIME, k] >= t)
                    & (mask & ~memory[block, _MASK, k] & care == 0)
                )
            after = chain[block, _NEXT]
            if found:
                k = 0
                while k < chain[block, _COUNT]:
                    worth = merit[block, _VALUE, k]
                    worse = worth <= v and merit[block, _TIME, k] >= t
                    if worse and exact:
                        worse = mask & ~memory[block, _MASK, k] == 0
                        if worse:
                            ahead = cuts & ~memory[block, _CUTS, k]
                            worse = ahead == 0 or v - priced(ahead, sigma) >= worth
                    if worse:
                        changed = True
                        kept[memory[block, _LABEL, k]] = 0
                        _take_out(buckets, node, b, block, k)
                    else:
                        k += 1
            block = after
        if changed:
            _measure(buckets, node, b)
    return looks


@kernel
def _take_out(buckets: Buckets, node: int, bucket: int, block: int, k: int) -> None:
    """Fill the place of a label with the last one of the first block."""
    first, chain, state = buckets.first, buckets.chain, buckets.state
    head = first[node, bucket]
    last = chain[head, _COUNT] - 1
    for row in range(2):
        buckets.merit[block, row, k] = buckets.merit[head, row, last]
    for row in range(3):
        buckets.memory[block, row, k] = buckets.memory[head, row, last]
    chain[head, _COUNT] = last
    if last == 0:
        first[node, bucket] = chain[head, _NEXT]
        chain[head, _NEXT] = state[_FREE]
        state[_FREE] = head


@kernel
def _measure(buckets: Buckets, node: int, bucket: int) -> None:
    """Find the highest and the lowest value of a bucket."""
    top, low = -np.inf, np.inf
    block = buckets.first[node, bucket]
    while block >= 0:
        for k in range(buckets.chain[block, _COUNT]):
            top = max(top, buckets.merit[block, _VALUE, k])
            low = min(low, buckets.merit[block, _VALUE, k])
        block = buckets.chain[block, _NEXT]
    buckets.top[node, bucket], buckets.low[node, bucket] = top, low
