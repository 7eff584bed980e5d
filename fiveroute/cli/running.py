"""Long runs on the command line: progress on a terminal, and a Ctrl-C that keeps the best.

The work runs in a second thread. The main thread only waits, so that it can take the
interrupt signal at any moment, however deep in a solver the work is, and pass it on as
`Limits.interrupt`. A second Ctrl-C ends the process at once.
"""

from __future__ import annotations

import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Generic, TypeVar

from fiveroute.cli.notes import note
from fiveroute.limits import Limits, Progress, ProgressCallback
from fiveroute.result import optimality_gap

__all__ = ["Outcome", "announce_compilation", "run"]

T = TypeVar("T")

_POLL = 0.05  # s; how soon a finished run is noticed


class Outcome(Generic[T]):
    """What a run returned, and whether it was interrupted."""

    __slots__ = ("interrupted", "value")

    def __init__(self, value: T, interrupted: bool) -> None:
        self.value = value
        self.interrupted = interrupted


def run(work: Callable[[Limits, ProgressCallback | None], T], limits: Limits) -> Outcome[T]:
    """Do `work`, showing progress on a terminal; Ctrl-C asks it for the best so far."""
    announce_compilation()
    with _interruptible(limits), _progress() as report:
        value = _in_thread(lambda: work(limits, report))
    return Outcome(value, limits.interrupt.is_set())


def announce_compilation() -> None:
    """Say on standard error when kernels have to be compiled: it happens once."""
    from fiveroute.kernels import on_compilation

    on_compilation(
        lambda: note("compiling its kernels; this happens once and takes a minute or so")
    )


@contextmanager
def _interruptible(limits: Limits) -> Iterator[None]:
    def ask_to_stop(_signal: int, _frame: FrameType | None) -> None:
        if limits.interrupt.is_set():
            raise KeyboardInterrupt
        limits.interrupt.set()

    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, ask_to_stop)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def _in_thread(work: Callable[[], T]) -> T:
    values: list[T] = []
    errors: list[BaseException] = []

    def target() -> None:
        try:
            values.append(work())
        except BaseException as error:
            errors.append(error)

    thread = threading.Thread(target=target, daemon=True)
    thread.start()
    while thread.is_alive():
        thread.join(_POLL)
    if errors:
        raise errors[0]
    return values[0]


@contextmanager
def _progress() -> Iterator[ProgressCallback | None]:
    """A spinner with objective, bound and gap on standard error, if that is a terminal."""
    if not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import Progress as Bar
    from rich.progress import SpinnerColumn, TextColumn, TimeElapsedColumn

    columns = SpinnerColumn(), TimeElapsedColumn(), TextColumn("{task.description}", markup=False)
    with Bar(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("starting", total=None)
        yield lambda progress: bar.update(task, description=_describe(progress))


def _describe(progress: Progress) -> str:
    parts = [progress.message] if progress.message else []
    if progress.objective is not None:
        parts.append(f"best {progress.objective:.6g}")
    if progress.bound is not None:
        parts.append(f"bound {progress.bound:.6g}")
    gap = optimality_gap(progress.objective, progress.bound)
    if gap is not None:
        parts.append(f"gap {100 * gap:.2f} %")
    return "  ".join(parts)
