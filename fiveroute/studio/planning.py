"""Planning in a thread of its own: what it has found so far, and how to stop it."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass as validated

from fiveroute.errors import FiverouteError
from fiveroute.fleet_planning import plan
from fiveroute.formats.plan_file import PlanFile
from fiveroute.instance import Instance
from fiveroute.limits import Clock, Limits, Progress
from fiveroute.result import optimality_gap

__all__ = ["Job", "Wish"]

_LONGEST = 86_400.0
_MOST_POINTS = 400


@validated(
    frozen=True,
    slots=True,
    config=ConfigDict(extra="forbid", strict=True, allow_inf_nan=False),
)
class Wish:
    """How to plan.

    Parameters
    ----------
    seconds
        Time limit.
    straight_lines
        Whether to ignore the ocean.
    bound
        Where the upper bound comes from, see `fiveroute.fleet_planning.plan`.
    seed
        Seed of the random numbers.
    """

    seconds: Annotated[float, Field(gt=0.0, le=_LONGEST)] = 30.0
    straight_lines: bool = False
    bound: Literal["none", "quick", "exact"] = "quick"
    seed: Annotated[int, Field(ge=0)] = 0


@dataclass(slots=True, eq=False)
class Job:
    """One search for a plan.

    Parameters
    ----------
    instance
        The mission.
    folder
        Folder that its file of currents is relative to.
    wish
        How to plan.
    on_end
        Called with the job when it is over, in its thread.
    """

    instance: Instance
    folder: Path
    wish: Wish
    on_end: Callable[[Job], None]
    state: Literal["running", "done", "stopped", "failed"] = "running"
    message: str = "starting"
    error: str = ""
    filed: PlanFile | None = None
    seconds: float = 0.0
    objective: float | None = None
    bound: float | None = None
    points: list[tuple[float, float | None, float | None]] = field(default_factory=list)
    limits: Limits = field(default_factory=Limits)
    clock: Clock = field(default_factory=lambda: Limits().start())
    thread: threading.Thread | None = None

    def start(self, after: Job | None = None) -> None:
        """Begin, once another job is over."""
        self.limits = Limits(self.wish.seconds)
        self.clock = self.limits.start()
        self.bound = self.instance.total_data
        self.thread = threading.Thread(target=self._run, args=(after,), daemon=True)
        self.thread.start()

    def stop(self) -> None:
        """Ask for the best plan so far."""
        self.limits.interrupt.set()

    def join(self, seconds: float | None = None) -> None:
        """Wait until it is over."""
        if self.thread is not None:
            self.thread.join(seconds)

    def told(self) -> dict[str, Any]:
        """What the page shows of it."""
        return {
            "state": self.state,
            "message": self.message,
            "error": self.error,
            "seconds": self.clock.seconds if self.state == "running" else self.seconds,
            "limit": self.wish.seconds,
            "objective": self.objective,
            "bound": self.bound,
            "gap": optimality_gap(self.objective, self.bound),
            "points": list(self.points),
        }

    def _run(self, after: Job | None) -> None:
        if after is not None:
            after.join()
        try:
            self.filed = self._planned()
            self.state = "stopped" if self.limits.interrupt.is_set() else "done"
        except FiverouteError as error:
            self.state, self.error = "failed", str(error)
        except Exception as error:  # the page must hear of it; the server lives on
            self.state = "failed"
            self.error = f"planning failed ({type(error).__name__}: {error}); please report it"
        self.on_end(self)

    def _planned(self) -> PlanFile:
        wish = self.wish
        answer = plan(
            self.instance,
            bound=wish.bound,
            straight_lines=wish.straight_lines,
            limits=self.limits,
            seed=wish.seed,
            progress=self._hear,
            folder=self.folder,
        )
        if answer.bound is None:  # what was told on the way may hold for a part of the legs only
            self.bound = None
        self._note(answer.objective, answer.bound)
        return answer.filed()

    def _hear(self, progress: Progress) -> None:
        self.message = progress.message or self.message
        self._note(progress.objective, progress.bound)

    def _note(self, objective: float | None, bound: float | None) -> None:
        """Keep the best plan and the least bound."""
        before = self.objective, self.bound
        self.seconds = self.clock.seconds
        if objective is not None:
            self.objective = max(objective, self.objective or 0.0)
        if bound is not None:
            self.bound = bound if self.bound is None else min(bound, self.bound)
        if (self.objective, self.bound) != before and len(self.points) < _MOST_POINTS:
            self.points.append((self.seconds, self.objective, self.bound))
