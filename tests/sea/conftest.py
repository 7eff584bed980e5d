"""A small mission at sea: 24 nodes, two AUVs that cannot visit all of them."""

import numpy as np
import pytest

from fiveroute.generate import generate
from fiveroute.heuristics.fleet_search import fleet_search
from fiveroute.routes import Plan
from fiveroute.sea.world import World


@pytest.fixture(scope="session")
def world() -> World:
    return World.of(generate(nodes=24, seed=3), 2)


@pytest.fixture(scope="session")
def plan(world: World) -> Plan:
    return fleet_search(world.problem, rng=np.random.default_rng(1), iterations=4000)
