"""Pass an interrupt on to a solver that does not look for it by itself."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

__all__ = ["on_interrupt"]

_POLL = 0.05  # s


@contextmanager
def on_interrupt(interrupt: threading.Event, stop: Callable[[], None]) -> Iterator[None]:
    """While inside, call `stop` from another thread whenever `interrupt` is found set.

    It is called again and again until the block is left, because a solver that has not
    quite begun forgets the first call.
    """
    left = threading.Event()

    def watch() -> None:
        while not left.wait(_POLL):
            if interrupt.is_set():
                stop()

    watcher = threading.Thread(target=watch, name="fiveroute-interrupt", daemon=True)
    watcher.start()
    try:
        yield
    finally:
        left.set()
        watcher.join()
