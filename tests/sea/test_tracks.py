"""Tracks: they begin and end where and when the log says, and never outrun the AUV."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fiveroute.generate import generate
from fiveroute.paths.voyage import Voyage
from fiveroute.routes import Plan
from fiveroute.sea.run_result import RunResult
from fiveroute.sea.sailed_luck import VehicleModel
from fiveroute.sea.simulation import simulate_fleet
from fiveroute.sea.tracks import EVERY, tracks_of
from fiveroute.sea.world import World

SEED = 4


@pytest.fixture(scope="module", params=["abstraction", "vehicle"])
def sailed(request: pytest.FixtureRequest, world: World) -> World:
    if request.param == "abstraction":
        return world
    model = VehicleModel.of(Voyage.straight(generate(nodes=24, seed=3)))
    return replace(world, model=model)


def one_run(sailed: World, plan: Plan, failures: float = 0.0) -> RunResult:
    return simulate_fleet(sailed, plan, runs=1, seed=SEED, failures=failures).runs[0]


def test_a_track_is_where_the_log_says(sailed: World, plan: Plan) -> None:
    run = one_run(sailed, plan)
    for auv, track in enumerate(tracks_of(sailed, None, run, SEED)):
        assert (np.diff(track[:, 0]) >= 0.0).all()
        assert track[0] == pytest.approx([0.0, *sailed.points[0]])
        assert track[-1, 0] == pytest.approx(run.arrivals[auv])
        assert np.hypot(*(track[-1, 1:] - sailed.points[-1])) <= 20.0
        for event in run.events:
            if event.auv == auv and event.node is not None and event.kind == "collect":
                there = [np.interp(event.t, track[:, 0], track[:, k]) for k in (1, 2)]
                assert np.hypot(*(np.array(there) - sailed.points[event.node])) <= 21.0


def test_a_vehicle_is_seen_every_few_seconds(sailed: World, plan: Plan) -> None:
    run = one_run(sailed, plan)
    (track, *_) = tracks_of(sailed, None, run, SEED)
    if sailed.model is None:
        assert len(track) == 2 * len(run.legs[0]), "(12) knows no more than the path's ends"
        return
    steps = np.diff(track[:, 0])
    assert np.median(steps) == EVERY
    moved = np.hypot(*np.diff(track[:, 1:], axis=0).T)
    assert (moved[steps > 1.0] < 2.0 * steps[steps > 1.0]).all()  # 1 m/s and the current


def test_the_track_of_who_fails_ends_there(sailed: World, plan: Plan) -> None:
    run = one_run(sailed, plan, failures=1.0)
    failed = {event.auv: event.t for event in run.events if event.kind == "fail"}
    assert failed
    for auv, track in enumerate(tracks_of(sailed, None, run, SEED)):
        assert track[-1, 0] <= failed.get(auv, run.arrivals[auv]) + 1e-9
