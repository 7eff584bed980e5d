"""When to stop: a description that can be used again and again, and the clock it starts.

Clocks stand still while kernels are compiled, which happens once on a computer: the first answer
takes no more seconds than the second, and its time limit buys as much.
"""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace

from fiveroute.errors import InputError

__all__ = ["WORKING_TIME", "Clock", "Limits", "Progress", "ProgressCallback", "WorkingTime"]


@dataclass(frozen=True, slots=True)
class Progress:
    """A snapshot that a running method hands to its progress callback."""

    seconds: float
    objective: float | None = None
    bound: float | None = None
    message: str = ""


ProgressCallback = Callable[[Progress], None]


@dataclass(frozen=True, slots=True)
class Limits:
    """When a method must stop. One description serves many runs: each starts its own clock.

    Parameters
    ----------
    time
        Wall-clock time in seconds, without the compilation of kernels.
    gap
        Relative optimality gap (bound - objective) / objective at which to stop.
    interrupt
        Set from outside (Ctrl-C) to ask for the best answer so far.
    work
        Work at which to stop, in labels of column generation, the one method that counts its
        work. Unlike time it ends a run at the same place on every machine.
    """

    time: float = math.inf
    gap: float = 0.0
    interrupt: threading.Event = field(default_factory=threading.Event, compare=False)
    work: float = math.inf

    def __reduce__(self) -> tuple[object, ...]:
        """Without the interrupt, which another process cannot hear: the copy has its own."""
        return _uninterrupted, (self.time, self.gap, self.work)

    def __post_init__(self) -> None:
        for name in ("time", "gap", "work"):
            value = getattr(self, name)
            if not value >= 0.0:
                raise InputError("a limit must not be negative", field=name, value=value)

    @classmethod
    def of(cls, limits: Limits | float | None) -> Limits:
        """Limits as people state them: a number of seconds, or None for no limit."""
        if limits is None:
            return cls()
        return limits if isinstance(limits, Limits) else cls(float(limits))

    def start(self) -> Clock:
        """Start a fresh clock."""
        return Clock(self)

    def within(self, time: float) -> Limits:
        """The same description with at most `time` seconds."""
        return replace(self, time=min(self.time, max(time, 0.0)))


def _uninterrupted(time: float, gap: float, work: float) -> Limits:
    return Limits(time, gap, work=work)


class WorkingTime:
    """The time that all clocks of this process show; it can be halted, also within a halt."""

    __slots__ = ("_halts", "_lost")

    def __init__(self) -> None:
        self._halts = 0
        self._lost: tuple[float, float | None] = (0.0, None)  # s, and since when it halts

    def now(self) -> float:
        """Seconds since some moment, without those of the halts."""
        lost, since = self._lost  # at one stroke: other threads ask, too
        return (time.perf_counter() if since is None else since) - lost

    def halt(self) -> None:
        """Stand still."""
        self._halts += 1
        if self._halts == 1:
            self._lost = (self._lost[0], time.perf_counter())

    def resume(self) -> None:
        """Go on, after as many calls as there were of `halt`."""
        self._halts -= 1
        if self._halts == 0:
            self._lost = (time.perf_counter() - self.now(), None)


WORKING_TIME = WorkingTime()


class Clock:
    """One run's stop-watch; `expired` is cheap enough to ask in every iteration."""

    __slots__ = ("_start", "limits", "work")

    def __init__(self, limits: Limits) -> None:
        self.limits = limits
        self.work = 0.0
        self._start = WORKING_TIME.now()

    def spend(self, work: float) -> None:
        """Count work that was done."""
        self.work += work

    @property
    def seconds(self) -> float:
        """Seconds since the start."""
        return WORKING_TIME.now() - self._start

    @property
    def left(self) -> float:
        """Seconds left; infinite without a time limit, never negative."""
        return max(self.limits.time - self.seconds, 0.0)

    @property
    def work_left(self) -> float:
        """Work left; infinite without a limit, never negative."""
        return max(self.limits.work - self.work, 0.0)

    @property
    def interrupted(self) -> bool:
        """Whether somebody asked for the best answer so far."""
        return self.limits.interrupt.is_set()

    @property
    def expired(self) -> bool:
        """Whether the run must end now."""
        return self.interrupted or self.left <= 0.0 or self.work_left <= 0.0

    def rest(self) -> Limits:
        """What is left, as the description for a sub-step."""
        return replace(self.limits.within(self.left), work=self.work_left)
