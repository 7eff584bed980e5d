"""Threads for islands: kernels do not hold Python's lock."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager

from fiveroute.heuristics.fleet.island import Island

__all__ = ["ForEach", "crew"]

ForEach = Callable[[Callable[[Island], None], Iterable[Island]], None]
"""Calls a function with every island, at the same time or one after the other."""


@contextmanager
def crew(workers: int) -> Iterator[ForEach]:
    """Some threads for the islands; kernels do not hold Python's lock."""

    def in_turn(work: Callable[[Island], None], islands: Iterable[Island]) -> None:
        for island in islands:
            work(island)

    if workers == 1:
        yield in_turn
        return
    with ThreadPoolExecutor(workers) as threads:

        def at_once(work: Callable[[Island], None], islands: Iterable[Island]) -> None:
            list(threads.map(work, islands))

        yield at_once
