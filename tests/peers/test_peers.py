"""Peers on our problems: their answers are feasible for us, and never above the optimum."""

import importlib.metadata
import sys
from types import SimpleNamespace

import numpy as np
import pytest

from fiveroute.errors import InputError, MissingExtraError
from fiveroute.limits import Limits
from fiveroute.models import solve
from fiveroute.peers import PEERS, ask, require_peers
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan


def problem(seed: int, nodes: int = 9) -> TeamOrienteering:
    """Asymmetric, with service times, start and destination apart, every budget another."""
    rng = np.random.default_rng(seed)
    size = nodes + 2
    points = rng.random((size, 2))
    apart = np.hypot(*(points[:, None] - points[None]).T).T
    inner = np.r_[0.0, np.ones(nodes), 0.0]
    home = apart[0, -1]
    return TeamOrienteering(
        apart * (1.0 + 0.3 * rng.random((size, size))),
        0.05 * rng.random(size) * inner,
        rng.integers(1, 60, size) * inner,
        1.3 * home + np.array([0.5, 1.0]),
    )


def installed(name: str) -> str:
    try:
        importlib.metadata.version(PEERS[name].package)
    except importlib.metadata.PackageNotFoundError:
        pytest.skip(f"{PEERS[name].package} is not installed: fiveroute[{PEERS[name].extra}]")
    return name


@pytest.mark.parametrize("peer", PEERS)
@pytest.mark.parametrize("seed", [1, 2])
def test_answers_are_feasible_and_good(peer: str, seed: int) -> None:
    task = problem(seed)
    best = solve(task, "brute-force").objective
    answer = ask(installed(peer), task, Limits(0.3), seed=1)
    assert (answer.status, answer.violations) == ("feasible", 0)
    assert answer.objective is not None
    assert best is not None
    assert 0.85 * best <= answer.objective <= best + 1e-9
    assert answer.seconds > 0.0


@pytest.mark.parametrize("peer", PEERS)
def test_no_nodes_and_no_data(peer: str) -> None:
    nothing = TeamOrienteering([[0, 1], [1, 0]], [0, 0], [0, 0], [2.0])
    assert ask(installed(peer), nothing, Limits(0.1)).objective == 0.0
    worthless = TeamOrienteering(np.ones((3, 3)), np.zeros(3), np.zeros(3), [5.0, 5.0])
    assert ask(peer, worthless, Limits(0.1)).objective == 0.0


@pytest.mark.parametrize("peer", PEERS)
def test_a_tempting_node_out_of_reach_is_left(peer: str) -> None:
    """One node has most of the data, and is one per cent too far away."""
    x = np.array([0.0, 5.05, 2.0, 0.0])
    task = TeamOrienteering(np.abs(x[:, None] - x), np.zeros(4), [0, 900, 300, 0], [10.0])
    answer = ask(installed(peer), task, Limits(0.5))
    assert (answer.status, answer.objective) == ("feasible", 300.0)


def test_infeasible_answers_are_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    wrong = SimpleNamespace(plan=lambda *_: Plan.of([[1, 1], []]))
    monkeypatch.setitem(sys.modules, PEERS["vroom"].module, wrong)
    answer = ask("vroom", problem(1), Limits(1.0))
    assert (answer.status, answer.objective) == ("rejected", None)
    assert answer.violations >= 1


def test_no_answer_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    silent = SimpleNamespace(plan=lambda *_: None)
    monkeypatch.setitem(sys.modules, PEERS["vroom"].module, silent)
    assert ask("vroom", problem(1), Limits(1.0)).status == "no_solution"


def test_a_missing_peer_names_its_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, PEERS["pyvrp"].module, None)
    with pytest.raises(MissingExtraError, match=r"needs pyvrp; install fiveroute\[peers\]"):
        require_peers(["pyvrp"], 1.0)


def test_peers_need_a_name_and_a_limit() -> None:
    with pytest.raises(InputError, match="no such peer; choose ortools, pyvrp, vroom"):
        require_peers(["lkh"], 1.0)
    with pytest.raises(InputError, match="a peer needs a time limit"):
        ask("ortools", problem(1), Limits())


def test_peers_come_after_highs_in_one_process() -> None:
    """OR-Tools works although HiGHS, with a library of the same name, is there already."""
    import fiveroute.models.highs  # noqa: F401

    assert ask("ortools", problem(3), Limits(0.2)).status == "feasible"
