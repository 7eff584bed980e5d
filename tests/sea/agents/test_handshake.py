"""A node changes hands, step by step, and what becomes of it when a step is lost."""

import math
from collections.abc import Callable

import numpy as np
import pytest

from fiveroute.routes import Plan
from fiveroute.sea.agents.agent import Agent
from fiveroute.sea.agents.channel import Channel
from fiveroute.sea.agents.holdings import Pledge
from fiveroute.sea.agents.messages import (
    Accept,
    Award,
    Bid,
    Call,
    Confirm,
    Decline,
    Inquiry,
    Message,
    Reply,
    Report,
    Void,
)
from fiveroute.sea.agents.teammates import SILENCE
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.sea.luck import Luck
from fiveroute.sea.planners.five_tier import FiveTier
from fiveroute.sea.run import Run
from fiveroute.sea.world import World

NONE: frozenset[int] = frozenset()


class Fleet:
    """Three agents at the start, with much time; AUV 0 keeps node 5."""

    def __init__(self, world: World) -> None:
        problem = world.problem.with_budgets([60_000.0] * 3)
        self.run = Run(problem, Luck(world.law, 1, 0), (math.inf,) * 3)
        self.crew = FiveTier(
            self.run,
            Outlook.of(problem, world.law, 1.645),
            Plan.of([[1], [2], [3]]),
            channel=Channel(),
            points=world.points,
            rng=np.random.default_rng(0),
        )
        for agent in self.agents:
            agent.holdings.kept.clear()
            own = {0: {1, 5}, 1: {2}, 2: {3}}
            agent.teammates.estates.update({m: frozenset(nodes) for m, nodes in own.items()})
        self.agents[0].holdings.kept.add(5)

    @property
    def agents(self) -> list[Agent]:
        return self.crew.agents

    def said(self, auv: int, kind: type[Message]) -> list[Message]:
        """What an AUV has said, oldest first; nothing leaves the queues here."""
        return [m for m in self.crew.radio._waiting[auv] if isinstance(m, kind)]

    def auction(self) -> Award:
        """AUV 0 calls, AUV 1 bids all it can, AUV 2 nothing; the award of the node."""
        keeper = self.agents[0]
        keeper.auctioneer.open(0.0)
        (call,) = self.said(0, Call)
        assert isinstance(call, Call)
        keeper.hear(1.0, Bid(2, 0, call.auction, (0.0,)))
        keeper.hear(2.0, Bid(1, 0, call.auction, (1e3,)))
        (award,) = self.said(0, Award)
        assert isinstance(award, Award)
        return award


@pytest.fixture
def fleet(world: World) -> Fleet:
    return Fleet(world)


def test_a_node_changes_hands_in_three_steps(fleet: Fleet) -> None:
    keeper, winner = fleet.agents[0].holdings, fleet.agents[1].holdings
    award = fleet.auction()
    assert 5 in keeper.mine
    fleet.agents[1].hear(3.0, award)
    assert 5 in winner.route
    assert 5 not in winner.mine
    (accept,) = fleet.said(1, Accept)
    fleet.agents[0].hear(4.0, accept)
    assert 5 not in keeper.mine
    (confirm,) = fleet.said(0, Confirm)
    fleet.agents[1].hear(5.0, confirm)
    assert 5 in winner.mine
    fleet.agents[0].hear(6.0, Report(1, None, winner.mine, NONE, NONE, False, False))
    assert not keeper.ceded


def test_a_lost_award_leaves_the_node_with_its_keeper(fleet: Fleet) -> None:
    award = fleet.auction()
    keeper = fleet.agents[0]
    keeper.auctioneer._expire(5, award.transfer, 500.0)
    assert 5 in keeper.holdings.kept
    assert len(fleet.said(0, Call)) == 2  # it is offered again


def test_an_acceptance_that_comes_too_late_is_void(fleet: Fleet) -> None:
    award = fleet.auction()
    fleet.agents[1].hear(3.0, award)
    (accept,) = fleet.said(1, Accept)
    fleet.agents[0].auctioneer._expire(5, award.transfer, 500.0)
    fleet.agents[0].hear(501.0, accept)
    (void,) = fleet.said(0, Void)
    fleet.agents[1].hear(502.0, void)
    assert 5 in fleet.agents[0].holdings.mine
    assert 5 not in fleet.agents[1].holdings.route


def test_a_lost_confirmation_is_repeated(fleet: Fleet) -> None:
    award = fleet.auction()
    fleet.agents[1].hear(3.0, award)
    (accept,) = fleet.said(1, Accept)
    fleet.agents[0].hear(4.0, accept)
    fleet.agents[0].hear(90.0, accept)
    fleet.agents[0].auctioneer.remind(900.0)
    assert len(fleet.said(0, Confirm)) == 3
    assert fleet.agents[0].holdings.ceded == {5: Pledge(award.transfer, 1)}


def test_who_has_given_up_declines_for_good(fleet: Fleet) -> None:
    """The confirmation comes after the winner has given up: back to the keeper, never twice."""
    award = fleet.auction()
    winner = fleet.agents[1]
    winner.hear(3.0, award)
    (accept,) = fleet.said(1, Accept)
    fleet.agents[0].hear(4.0, accept)
    (confirm,) = fleet.said(0, Confirm)
    winner.holdings.route.remove(5)
    winner.bidder.release(400.0, 5)
    winner.hear(401.0, confirm)
    assert 5 not in winner.holdings.concerns
    declines = fleet.said(1, Decline)
    assert len(declines) == 2
    for decline in declines:
        fleet.agents[0].hear(402.0, decline)
    assert 5 in fleet.agents[0].holdings.kept


def test_an_award_beyond_its_time_is_declined(fleet: Fleet) -> None:
    award = fleet.auction()
    fleet.agents[1].ship.vessel.budget = 10.0
    fleet.agents[1].hear(3.0, award)
    assert fleet.said(1, Accept) == []
    (decline,) = fleet.said(1, Decline)
    fleet.agents[0].hear(4.0, decline)
    assert 5 in fleet.agents[0].holdings.kept


def hear_all(fleet: Fleet, t: float, auv: int, *others: int) -> None:
    for other in others:
        fleet.agents[auv].hear(t, Report(other, None, NONE, NONE, NONE, False, False))


def test_the_heir_asks_before_it_takes_over(fleet: Fleet) -> None:
    """AUV 1 is silent; AUV 2 comes next, hears that node 5 is AUV 0's, and keeps the rest."""
    heir, late = fleet.agents[2], SILENCE + 100.0
    heir.teammates.estates[1] = frozenset({2, 5})
    hear_all(fleet, late, 2, 0)
    assert heir.teammates.suspects(1, late)
    heir.teammates.look_round(late)
    (inquiry,) = fleet.said(2, Inquiry)
    assert 2 not in heir.holdings.kept
    fleet.agents[0].hear(late + 1.0, inquiry)
    (reply,) = fleet.said(0, Reply)
    heir.hear(late + 2.0, reply)
    assert heir.holdings.kept == {2}
    assert fleet.crew.takeovers == 1


def test_only_the_next_in_order_is_the_heir(fleet: Fleet) -> None:
    late = SILENCE + 100.0
    hear_all(fleet, late, 0, 2)
    fleet.agents[0].teammates.look_round(late)
    assert fleet.said(0, Inquiry) == []


@pytest.mark.parametrize(
    "sign",
    [
        lambda: Report(1, None, frozenset({2}), NONE, NONE, False, False),
        lambda: Report(1, None, NONE, NONE, frozenset({2}), False, False),
    ],
)
def test_the_heir_yields_to_who_is_heard_again(fleet: Fleet, sign: Callable[[], Message]) -> None:
    heir, late = fleet.agents[2], SILENCE + 100.0
    hear_all(fleet, late, 2, 0)
    heir.teammates.look_round(late)
    heir.hear(late + 1.0, Reply(0, 2, 1, NONE))
    assert heir.holdings.kept == {2}
    assert fleet.crew.false_takeovers == 1
    heir.hear(late + 2.0, sign())
    assert not heir.teammates.suspects(1, late + 2.0)
    assert heir.holdings.kept == set()


def test_who_is_asked_for_speaks_up(fleet: Fleet) -> None:
    fleet.agents[1].hear(5000.0, Inquiry(2, None, 1, frozenset({2})))
    (report,) = fleet.said(1, Report)
    assert isinstance(report, Report)
    assert 2 in report.mine
