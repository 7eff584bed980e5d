"""The five-tiered planner: AUVs that coordinate over the acoustic channel.

Every AUV is an agent of its own. Before departure they all know the plan, and by it which AUV
keeps which of the nodes that the plan leaves out: the one whose route they lie nearest to.
"""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from fiveroute.heuristics.pick_up import insertions
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan
from fiveroute.sea.agents.agent import Agent
from fiveroute.sea.agents.channel import Channel, Radio
from fiveroute.sea.agents.holdings import Holdings
from fiveroute.sea.agents.messages import Message, longest_frame
from fiveroute.sea.agents.teammates import SILENCE
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.sea.courses.recourse import with_recourse
from fiveroute.sea.run import Run

__all__ = ["FiveTier", "ShortSighted", "first_keepers"]


class FiveTier:
    """Steers the fleet of one run.

    Parameters
    ----------
    run
        The run.
    view
        What the AUVs expect.
    plan
        What they set out with.
    channel
        What they talk over.
    points
        Positions of all vertices in metres, shape (n + 2, 2).
    rng
        Draws losses and delays.
    silence
        Seconds after which a silent AUV is suspected; infinite where none ever fails.
    """

    looks_ahead: ClassVar[bool] = True
    """Whether nodes are options to its AUVs; otherwise they sail the best course by expectation."""

    def __init__(
        self,
        run: Run,
        view: Outlook,
        plan: Plan,
        *,
        channel: Channel,
        points: NDArray[np.float64],
        rng: np.random.Generator,
        silence: float = SILENCE,
    ) -> None:
        self._run = run
        self.radio = Radio(run, channel, points, rng, self._hear, longest_frame(run.problem.n))
        self.takeovers = self.false_takeovers = 0
        keepers = first_keepers(run.problem, plan)
        books = [
            Holdings(list(route), {node for node, keeper in keepers.items() if keeper == auv})
            for auv, route in enumerate(plan.routes)
        ]
        view = with_recourse(view) if self.looks_ahead else view
        estates = {auv: book.mine for auv, book in enumerate(books)}
        self.agents = [
            Agent(auv, run, self.radio, view, book, estates, silence, self._note_takeover)
            for auv, book in enumerate(books)
        ]

    def steer(self, auv: int, t: float) -> int:
        """The next vertex of an AUV."""
        return self.agents[auv].steer(t)

    def come_home(self, auv: int, t: float) -> None:
        """An AUV has reached the destination."""
        self.agents[auv].come_home(t)

    def _hear(self, t: float, auv: int, message: Message) -> None:
        self.agents[auv].hear(t, message)

    def _note_takeover(self, silent: int, node: int) -> None:
        """Count a takeover if its belief is false: the node is not abandoned."""
        holders = [
            agent
            for agent, vessel in zip(self.agents, self._run.vessels, strict=True)
            if (vessel.is_alive and node in agent.holdings.mine) or node in agent.holdings.done
        ]
        self.takeovers += 1
        self.false_takeovers += len(holders) > 1


class ShortSighted(FiveTier):
    """The same without looking ahead; the difference is what that is worth."""

    looks_ahead = False


def first_keepers(problem: TeamOrienteering, plan: Plan) -> dict[int, int]:
    """Which AUV keeps each node that the plan leaves out: the one with the least detour."""
    idle = np.array(plan.idle(problem), dtype=np.int64)
    extra = np.array([insertions(problem, route, idle)[1] for route in plan.routes])
    return dict(zip(idle.tolist(), extra.argmin(axis=0).tolist(), strict=True)) if len(idle) else {}
