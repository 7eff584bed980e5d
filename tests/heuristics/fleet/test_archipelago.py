import numpy as np

from fiveroute.heuristics.fleet.archipelago import Archipelago
from fiveroute.heuristics.fleet.crew import crew
from fiveroute.heuristics.fleet.network import build_network
from fiveroute.heuristics.fleet.schedule import FIRST
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan


def test_a_new_round_starts_from_combinations_and_loses_nothing() -> None:
    rng = np.random.default_rng(5)
    points = rng.uniform(0.0, 100.0, (42, 2))
    travel = np.linalg.norm(points[:, None] - points[None, :], axis=2)
    profit = np.pad(rng.random(40), 1)
    network = build_network(TeamOrienteering(travel, np.zeros(42), profit, [150.0] * 2), 20)
    islands = Archipelago.around(Plan.empty(2), network, 0.01, rng)
    with crew(2) as for_each:
        for part in np.linspace(0.0, FIRST, 30, endpoint=False):
            islands.run(200, part, for_each)
        before, known = islands.objective, len(islands.pool)
        assert before > 0.0
        assert known > 2
        islands.run(200, FIRST, for_each)
    assert islands.round == 1
    assert islands.objective >= before
