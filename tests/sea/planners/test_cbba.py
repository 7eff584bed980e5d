"""CBBA at sea: agreement over a perfect channel, and honest counting over a bad one."""

import math
from collections import Counter
from itertools import pairwise

import numpy as np

from fiveroute.generate import generate
from fiveroute.routes import Plan
from fiveroute.sea.agents.channel import Channel
from fiveroute.sea.agents.consensus import COLLECTED
from fiveroute.sea.agents.teammates import SILENCE
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.sea.events import arrivals_of
from fiveroute.sea.luck import Luck
from fiveroute.sea.planners.cbba import Cbba
from fiveroute.sea.run import Run
from fiveroute.sea.simulation import failure_times, simulate_fleet
from fiveroute.sea.world import World


def random_mission(
    seed: int, loss: float = 0.0, failures: float = 0.0, bit_rate: float = math.inf
) -> tuple[Run, Cbba]:
    """A random small mission, sailed to its end."""
    rng = np.random.default_rng(seed)
    n, fleet = int(rng.integers(4, 20)), int(rng.integers(1, 6))
    world = World.of(generate(nodes=n, seed=seed, fleet_size=fleet))
    problem = world.problem.with_budgets(rng.uniform(5000.0, 20_000.0, size=fleet))
    order = (rng.permutation(n) + 1).tolist()
    cuts = sorted(rng.integers(0, n // 2 + 1, size=fleet).tolist())
    plan = Plan.of(order[a:b] for a, b in zip([0, *cuts[:-1]], cuts, strict=True))
    run = Run(problem, Luck(world.law, seed, 0), failure_times(problem.budgets, failures, seed, 0))
    crew = Cbba(
        run,
        Outlook.of(problem, world.law, 1.645),
        plan,
        channel=Channel(loss=loss, bit_rate=bit_rate),
        points=world.points,
        rng=rng,
        silence=SILENCE if failures else math.inf,
    )
    run.sail(crew)
    return run, crew


def collections(run: Run) -> Counter[int]:
    return Counter(e.node for e in run.log if e.kind == "collect" and e.node is not None)


def test_nobody_speaks_before_all_have_heard_what_was_said() -> None:
    """A turn is long enough for all that an AUV believes, at 80 bits a second."""
    for seed in range(30):
        run, _ = random_mission(seed, bit_rate=80.0)
        said = sorted((e.t, e.frame.number) for e in run.log if e.kind == "send" and e.frame)
        heard = arrivals_of(run.log)
        for (_, number), (then, _) in pairwise(said):
            assert max(heard.get(number, {}).values(), default=0.0) <= then + 1e-6


def test_over_a_perfect_channel_nothing_is_collected_twice_and_all_agree() -> None:
    picked = 0
    for seed in range(120):
        run, crew = random_mission(seed)
        counts = collections(run)
        assert max(counts.values(), default=1) == 1
        assert Counter(e.kind for e in run.log)["arrive"] == len(crew.agents)
        assert len({tuple(agent.beliefs.winners) for agent in crew.agents}) == 1
        believed = crew.agents[0].beliefs.bids
        assert {node for node, bid in enumerate(believed) if bid == COLLECTED} == counts.keys()
        picked += sum(e.kind == "pick_up" for e in run.log)
    assert picked > 100


def test_over_a_bad_channel_the_fleet_still_comes_home() -> None:
    doubles = 0
    for seed in range(80):
        run, crew = random_mission(seed, loss=0.7)
        assert Counter(e.kind for e in run.log)["arrive"] == len(crew.agents)
        doubles += sum(count - 1 for count in collections(run).values())
    assert doubles < 40


def test_a_failed_teammate_is_replaced(world: World) -> None:
    problem = world.problem.with_budgets([30_000.0, 30_000.0])
    plan = Plan.of([range(1, 13), range(13, 19)])
    run = Run(problem, Luck(world.law, 1, 0), (10.0, math.inf))
    crew = Cbba(
        run,
        Outlook.of(problem, world.law, 1.645),
        plan,
        channel=Channel(),
        points=world.points,
        rng=np.random.default_rng(0),
    )
    run.sail(crew)
    inherited = set(range(1, 13)) & collections(run).keys()
    assert inherited
    assert crew.false_takeovers == 0
    assert all(e.t > SILENCE for e in run.log if e.kind == "collect" and e.node in inherited)


def test_whoever_fails_the_others_finish() -> None:
    for seed in range(80):
        run, crew = random_mission(seed, loss=0.3, failures=0.4)
        kinds = Counter(e.kind for e in run.log)
        assert kinds["arrive"] + kinds["fail"] == len(crew.agents)


def test_consensus_collects_more_than_none(world: World, plan: Plan) -> None:
    alone, together, deaf = (
        simulate_fleet(world, plan, planner=planner, runs=60, loss=loss)
        for planner, loss in (("no-coordination", 0.0), ("cbba", 0.0), ("cbba", 1.0))
    )
    assert together.completions.mean() > alone.completions.mean() + 0.01
    assert together.double_visits == 0
    assert deaf.messages[1] == 0
