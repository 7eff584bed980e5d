"""Distributed coordination: what must hold however bad the channel, and whoever fails."""

import math
from collections import Counter
from dataclasses import dataclass

import numpy as np
import pytest

from fiveroute.generate import generate
from fiveroute.routes import Plan
from fiveroute.sea.agents.channel import Bursts, Channel
from fiveroute.sea.agents.teammates import BEAT, SILENCE
from fiveroute.sea.courses.course import in_hand
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.sea.events import Frame, Kind
from fiveroute.sea.luck import Luck
from fiveroute.sea.planners.five_tier import FiveTier, first_keepers
from fiveroute.sea.run import Run
from fiveroute.sea.simulation import failure_times, simulate_fleet
from fiveroute.sea.world import World


@dataclass(slots=True)
class WatchedRun(Run):
    """A run in which somebody who sees all checks the agents at every event."""

    crew: FiveTier | None = None
    may_fail: bool = False

    def note(
        self,
        t: float,
        auv: int,
        kind: Kind,
        node: int | None = None,
        frame: Frame | None = None,
    ) -> None:
        """Write an event into the log, and look at everybody's book."""
        super(WatchedRun, self).note(t, auv, kind, node, frame)
        if self.crew is None:
            return
        if not self.may_fail:
            assert_one_right_a_node(self.crew)
        if kind == "pick_up":
            ship, vessel = self.crew.agents[auv].ship, self.vessels[auv]
            is_overdue = t > vessel.left + ship.view.legs[vessel.at, vessel.target]
            assert is_overdue or in_hand(ship.view, ship.course(t)) >= 0.0


def assert_one_right_a_node(crew: FiveTier) -> None:
    """Nobody has what somebody else has, or has collected."""
    rights = Counter(n for agent in crew.agents for n in agent.holdings.mine)
    rights.update(n for agent in crew.agents for n in agent.holdings.done)
    assert not rights or max(rights.values()) == 1


def faulty_mission(seed: int, failures: float) -> tuple[WatchedRun, FiveTier]:
    """A random small mission over a random bad channel, sailed to its end."""
    rng = np.random.default_rng(seed)
    n, fleet = int(rng.integers(1, 20)), int(rng.integers(1, 6))
    world = World.of(generate(nodes=n, seed=seed, fleet_size=fleet))
    problem = world.problem.with_budgets(rng.uniform(5000.0, 20_000.0, size=fleet))
    order = (rng.permutation(n) + 1).tolist()
    cuts = sorted(rng.integers(0, n // 2 + 1, size=fleet).tolist())
    plan = Plan.of(order[a:b] for a, b in zip([0, *cuts[:-1]], cuts, strict=True))
    channel = Channel(
        reach=float(rng.choice([math.inf, 3000.0])),
        bit_rate=float(rng.choice([80.0, 640.0])),
        loss=float(rng.random() * 0.8),
        bursts=Bursts() if rng.random() < 0.3 else None,
        jitter=float(rng.choice([0.0, 60.0, 300.0])),
    )
    view = Outlook.of(problem, world.law, float(rng.choice([0.0, 1.645])))
    fails = failure_times(problem.budgets, failures, seed, 0)
    run = WatchedRun(problem, Luck(world.law, seed, 0), fails)
    crew = FiveTier(
        run,
        view,
        plan,
        channel=channel,
        points=world.points,
        rng=rng,
        silence=SILENCE if failures else math.inf,
    )
    run.crew, run.may_fail = crew, failures > 0.0
    run.sail(crew)
    return run, crew


def collections(run: Run) -> Counter[int]:
    return Counter(e.node for e in run.log if e.kind == "collect" and e.node is not None)


def test_whatever_gets_lost_nothing_is_collected_twice() -> None:
    transfers = 0
    for seed in range(250):
        run, crew = faulty_mission(seed, 0.0)
        counts = collections(run)
        assert not counts or max(counts.values()) == 1
        assert Counter(e.kind for e in run.log)["arrive"] == len(crew.agents)
        assert crew.false_takeovers == 0
        transfers += sum(agent.auctioneer.transfers for agent in crew.agents)
    assert transfers > 100


def test_whoever_fails_a_double_collection_follows_a_false_belief() -> None:
    taken_over = 0
    for seed in range(250):
        run, crew = faulty_mission(seed, 0.4)
        doubles = sum(count - 1 for count in collections(run).values())
        assert doubles <= crew.false_takeovers
        kinds = Counter(e.kind for e in run.log)
        assert kinds["arrive"] + kinds["fail"] == len(crew.agents)
        taken_over += crew.takeovers
    assert taken_over > 30


def test_over_a_perfect_channel_every_node_stays_with_somebody() -> None:
    for seed in range(50):
        world = World.of(generate(nodes=12, seed=seed, fleet_size=3))
        problem = world.problem.with_budgets([9000.0] * 3)
        plan = Plan.of([range(1, 5), range(5, 9), ()])
        view = Outlook.of(problem, world.law, 1.645)
        run = Run(problem, Luck(world.law, seed, 0), (math.inf,) * 3)
        rng = np.random.default_rng(0)
        crew = FiveTier(run, view, plan, channel=Channel(), points=world.points, rng=rng)
        run.sail(crew)
        assert_one_right_a_node(crew)
        known = frozenset[int]().union(*(a.holdings.mine | a.holdings.done for a in crew.agents))
        assert known == frozenset(range(1, 13))
        assert not any(a.holdings.ceded or a.holdings.pledged for a in crew.agents)


def test_a_failed_teammate_is_replaced(world: World) -> None:
    """AUV 0 fails at once; what it had is suspected, taken over, and partly collected."""
    instance = generate(nodes=24, seed=3)
    problem = instance.problem(2).with_budgets([30_000.0, 30_000.0])
    plan = Plan.of([range(1, 13), range(13, 19)])
    view = Outlook.of(problem, world.law, 1.645)
    run = Run(problem, Luck(world.law, 1, 0), (10.0, math.inf))
    rng = np.random.default_rng(0)
    crew = FiveTier(run, view, plan, channel=Channel(), points=world.points, rng=rng)
    run.sail(crew)
    assert crew.takeovers > 0
    assert crew.false_takeovers == 0
    inherited = set(range(1, 13)) & collections(run).keys()
    assert inherited
    assert all(e.t > SILENCE for e in run.log if e.kind == "collect" and e.node in inherited)


def test_an_auction_takes_few_messages() -> None:
    """One keeper, five idle nodes, three bidders: all is settled in at most twenty each."""
    for seed in range(20):
        world = World.of(generate(nodes=9, seed=seed, fleet_size=4))
        plan = Plan.of([[6], [7], [8], [9]])
        view = Outlook.of(world.problem, world.law, 1.645)
        run = Run(world.problem, Luck(world.law, seed, 0), (math.inf,) * 4)
        rng = np.random.default_rng(0)
        crew = FiveTier(run, view, plan, channel=Channel(), points=world.points, rng=rng)
        for agent in crew.agents:
            agent.holdings.kept.clear()
        crew.agents[0].holdings.kept.update(range(1, 6))
        run.sail(crew)
        messages = Counter(e.auv for e in run.log if e.kind == "send" and e.t < BEAT)
        assert max(messages.values()) <= 20
        assert_one_right_a_node(crew)


def test_coordination_collects_more_than_none(world: World, plan: Plan) -> None:
    alone, together, deaf = (
        simulate_fleet(world, plan, planner=planner, runs=60, loss=loss)
        for planner, loss in (("no-coordination", 0.0), ("five-tier", 0.0), ("five-tier", 1.0))
    )
    assert together.completions.mean() > alone.completions.mean() + 0.01
    assert deaf.messages[1] == 0
    assert together.messages[1] > 0


@pytest.mark.parametrize("idle", [0, 5])
def test_first_keepers_share_out_what_the_plan_leaves(world: World, idle: int) -> None:
    plan = Plan.of([range(1 + idle, 12), range(12, 25)])
    keepers = first_keepers(world.problem, plan)
    assert sorted(keepers) == list(range(1, 1 + idle))
    assert set(keepers.values()) <= {0, 1}
