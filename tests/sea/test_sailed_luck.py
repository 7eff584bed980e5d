"""Luck that is sailed: the same ocean for all, tracks that prove it, a law that expects it."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest

from fiveroute.generate import generate
from fiveroute.instance import Uncertainty
from fiveroute.limits import Limits
from fiveroute.ocean.current_grid import CurrentGrid
from fiveroute.paths.leg_table import LegTable
from fiveroute.paths.voyage import Voyage
from fiveroute.routes import Plan
from fiveroute.sea.sailed_luck import SailedLuck, VehicleModel
from fiveroute.sea.simulation import simulate_fleet
from fiveroute.sea.world import World
from fiveroute.vehicle.sailed_track import Outcome, least_clearance
from fiveroute.vehicle.tracking import sail_track
from fiveroute.vehicle.true_ocean import Forecast


@pytest.fixture(scope="module")
def model() -> VehicleModel:
    return VehicleModel.of(Voyage.straight(generate(nodes=24, seed=3)))


@pytest.fixture(scope="module")
def sailed(world: World, model: VehicleModel) -> World:
    return world.sailed_by(model)


def test_a_leg_is_the_vehicles_track_among_all_obstacles(model: VehicleModel) -> None:
    luck = SailedLuck(model, 1, 0)
    legs = [(0, 5), (5, 9), (9, 25)]
    tracks = [
        sail_track(luck.ocean.grid, model.track(i, j), model.vehicle, barriers=luck.ocean.barriers)
        for i, j in legs
    ]
    assert [luck.leg(i, j).time for i, j in legs] == [track.duration for track in tracks]
    assert [len(luck.leg(i, j).moments) for i, j in legs] == [track.manoeuvres for track in tracks]
    assert all(luck.leg(i, j).arrives for i, j in legs)
    assert luck.least_clearance == pytest.approx(
        min(least_clearance(luck.ocean.barriers, track.positions) for track in tracks)
    )


def test_it_is_a_pure_function_of_seed_run_and_leg(model: VehicleModel) -> None:
    one, two = SailedLuck(model, 1, 4), SailedLuck(model, 1, 4)
    two.leg(9, 5, 300.0)
    assert one.leg(5, 9, 0.0) == two.leg(5, 9, 7000.0)
    assert one.leg(5, 9) != SailedLuck(model, 2, 4).leg(5, 9)
    assert one.leg(5, 9) != SailedLuck(model, 1, 5).leg(5, 9)


def test_moments_are_within_the_leg_and_in_order(model: VehicleModel) -> None:
    luck = SailedLuck(model, 3, 0)
    legs = [luck.leg(i, i + 1) for i in range(10)]
    assert sum(len(leg.moments) for leg in legs) > 3
    for leg in legs:
        assert list(leg.moments) == sorted(leg.moments)
        assert all(0.0 < moment < leg.time for moment in leg.moments)


def test_in_a_varying_current_it_matters_when_a_leg_begins(model: VehicleModel) -> None:
    still = model.forecast.grid
    turning = np.repeat(still.uv, 2, axis=0)
    turning[1, ..., 0] = 0.3
    swung = CurrentGrid(turning, still.west, still.south, still.step, 0.0, 18_000.0)
    tidal = replace(model, forecast=replace(model.forecast, grid=swung, uncertainty=Uncertainty()))
    luck = SailedLuck(tidal, 0, 0)
    assert luck.leg(0, 25, 15_000.0).time < 0.9 * luck.leg(0, 25, 0.0).time  # eastward


def test_who_strays_from_the_track_looks_at_all_obstacles() -> None:
    """A cross current that the vehicle cannot hold against sweeps it into a disc far away."""
    stops = np.array([[0.0, 0.0], [4000.0, 0.0], [6000.0, 0.0]])
    calm = Forecast.of(None, None, stops, 1.0, Uncertainty())
    swept = calm.grid._replace(uv=calm.grid.uv + np.array([0.0, 1.5]))
    model = VehicleModel(replace(calm, grid=swept), VehicleModel.of(_straight()).vehicle)
    ocean = model.ocean(0, 0)
    rock = np.array([[-500.0, 900.0, 250.0]])
    ocean = ocean._replace(barriers=ocean.barriers._replace(circles=rock))
    assert model.sail(ocean, 0, 1).outcome in (Outcome.COLLIDED, Outcome.BLOCKED)


def _straight() -> Voyage:
    return Voyage.straight(generate(nodes=1, seed=1))


def test_a_leg_without_a_path_leads_nowhere(model: VehicleModel) -> None:
    empty = replace(model, legs=LegTable.of(26, {}))
    assert not SailedLuck(empty, 0, 0).leg(0, 1).arrives


def test_the_law_expects_what_the_vehicle_does(sailed: World, model: VehicleModel) -> None:
    law, planned = sailed.law, sailed.problem.travel
    assert 0.2 < law.drift < 0.4, "of legs that are late together, above the stated 0.2"
    assert 1.0 < law.planned[0, 5] / planned[0, 5] < 1.15
    lucks = [SailedLuck(model, 77, run) for run in range(12)]
    legs = [(k, k + 1) for k in range(1, 8)]
    took = sum(luck.leg(*leg).time for luck in lucks for leg in legs)
    mean = sum(law.planned[leg] + law.encounters[leg] * law.manoeuvre_time for leg in legs)
    assert took / len(lucks) == pytest.approx(mean, rel=0.12)


def test_a_fit_ends_when_asked(world: World, model: VehicleModel) -> None:
    fit = model.fit(world.problem.travel, walks=1, limits=Limits(time=0.0))
    assert 2 <= fit.legs <= 5 * 4


def test_a_fit_of_a_round_trip(world: World, model: VehicleModel) -> None:
    planned = world.problem.travel.copy()
    planned[0, -1] = 0.0
    planned[5, -1] = math.inf
    fit = model.fit(planned, limits=Limits(time=0.0))
    assert math.isfinite(fit.drift.value)
    assert math.isfinite(fit.delay.value)


def test_a_leg_home_is_late_as_rarely_as_expected(sailed: World, model: VehicleModel) -> None:
    """The probability that it takes longer than it did is spread evenly from 0 to 1."""
    view, lucks = sailed.outlook(1.645), [SailedLuck(model, 99, run) for run in range(30)]
    times = view.step * np.arange(view.late.shape[1])
    later = [
        float(np.interp(luck.leg(node, 25).time, times, view.late[node]))
        for luck in lucks
        for node in (3, 8, 12, 17)
    ]
    assert np.mean(later) == pytest.approx(0.5, abs=0.1)
    assert np.mean(np.array(later) < 0.1) == pytest.approx(0.1, abs=0.07)


@pytest.mark.parametrize("planner", ["five-tier", "no-coordination", "rmmp"])
def test_every_planner_sails_the_same_legs(planner: str, sailed: World, plan: Plan) -> None:
    result = simulate_fleet(sailed, plan, planner=planner, runs=2, seed=9)
    assert result.collisions == 0
    assert result.min_clearance is not None
    assert result.min_clearance > 0.0
    for run in result.runs:
        luck = sailed.luck(9, run.run)
        for auv, legs in enumerate(run.legs):
            for (i, j, begin), (_, _, then) in itertools.pairwise(legs):
                service = sailed.problem.service[j]
                assert then == pytest.approx(begin + luck.leg(i, j).time + service)
            i, j, begin = legs[-1]
            assert run.arrivals[auv] == pytest.approx(begin + luck.leg(i, j).time)
        noted = sum(event.kind == "manoeuvre" for event in run.events)
        assert noted == sum(len(luck.leg(i, j).moments) for legs in run.legs for i, j, _ in legs)


def test_who_is_swept_away_is_lost(world: World, model: VehicleModel, plan: Plan) -> None:
    grid = model.forecast.grid
    stream = grid._replace(uv=grid.uv + np.array([-1.5, 0.0]))
    swept = replace(model, forecast=replace(model.forecast, grid=stream, uncertainty=Uncertainty()))
    result = simulate_fleet(replace(world, model=swept), plan, runs=1)
    assert result.lost == world.problem.fleet_size
    assert result.collisions == 0
    assert result.runs[0].arrivals == (math.inf, math.inf)
    assert [event.kind for event in result.runs[0].events].count("fail") == result.lost


def test_no_clairvoyant_where_a_vehicle_sails(sailed: World, plan: Plan) -> None:
    assert simulate_fleet(sailed, plan, runs=1, gap=True).online_gap is None
