"""Fleet sizes, speeds, departures and reserves of small missions."""

from collections.abc import Callable
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import pytest

from fiveroute.decide.departures import begin_after, sweep_departures
from fiveroute.decide.fleet_sizes import sweep_fleet_sizes
from fiveroute.decide.picture import sweep_figure
from fiveroute.decide.reserves import sweep_reserves
from fiveroute.decide.speeds import PowerModel, sweep_speeds
from fiveroute.decide.sweep import Row
from fiveroute.errors import InputError
from fiveroute.generate import generate
from fiveroute.instance import Currents, Instance, Point
from fiveroute.limits import Limits
from fiveroute.paths.voyage import Voyage


@pytest.fixture(scope="module")
def mission() -> Instance:
    """Ten nodes, of which a short endurance leaves some out."""
    instance = generate("uniform", nodes=10, seed=3)
    fleet = replace(instance.fleet, size=None, endurance=9000.0)
    return replace(instance, fleet=fleet, ocean=type(instance.ocean)())


def column(rows: tuple[Row, ...], name: str) -> list[float]:
    values = [row[name] for row in rows]
    assert all(isinstance(value, (int, float)) for value in values)
    return [float(value) for value in values if isinstance(value, (int, float))]


def test_more_auvs_collect_no_less(mission: Instance) -> None:
    sweep = sweep_fleet_sizes(Voyage.straight(mission), [1, 2, 3], bound="exact")
    rates, bounds = column(sweep.rows, "completion_rate"), column(sweep.rows, "bound_rate")
    assert rates == sorted(rates)
    assert all(rate <= bound + 1e-9 for rate, bound in zip(rates, bounds, strict=True))
    assert sweep.because == "estimate (17)"
    sweep_figure(sweep)


def test_nothing_is_proved_where_legs_were_left_open(mission: Instance) -> None:
    voyage = replace(Voyage.straight(mission), is_complete=False)
    (row,) = sweep_fleet_sizes(voyage, [3], bound="exact").rows
    assert row["status"] == "feasible"
    assert row["bound"] is None


def test_completion_at_sea_counts_nodes_out_of_reach(mission: Instance) -> None:
    near = replace(mission, nodes=mission.nodes[:5])
    lost = tuple(node.id for node in mission.nodes[5:])
    share = sum(node.data for node in near.nodes) / sum(node.data for node in mission.nodes)
    rates = [
        sweep_reserves(voyage, [1.0], fleet_size=2, runs=2).rows[0]["completion_rate"]
        for voyage in (Voyage.straight(near), Voyage(mission, near, unreachable=lost))
    ]
    assert isinstance(rates[0], float)
    assert rates[1] == pytest.approx(share * rates[0])


def test_a_fleet_that_is_stated_one_by_one_has_its_size(mission: Instance) -> None:
    fleet = replace(mission.fleet, endurance=(9000.0, 8000.0))
    with pytest.raises(InputError, match=r"^fleet.endurance: states 2 AUVs"):
        sweep_fleet_sizes(Voyage.straight(replace(mission, fleet=fleet)), [1, 2])


def test_power_and_endurance() -> None:
    power = PowerModel(hotel=30.0, propulsion=4.0)
    assert power.power(1.5) == pytest.approx(43.5)
    assert power.endurance(1000.0, 1.5) == pytest.approx(1000.0 * 3600.0 / 43.5)
    best = (30.0 / (2.0 * 4.0)) ** (1.0 / 3.0)  # goes farthest in still water
    for speed in (0.99 * best, 1.01 * best):
        assert power.power(speed) / speed > power.power(best) / best


@pytest.mark.parametrize("wrong", [0.0, -1.0, float("nan"), float("inf")])
def test_speeds_and_batteries_must_be_positive(mission: Instance, wrong: float) -> None:
    with pytest.raises(InputError, match=r"^speeds: .*above 0"):
        sweep_speeds(mission, [1.0, wrong])
    with pytest.raises(InputError, match=r"^battery: .*above 0"):
        sweep_speeds(mission, [1.0], battery=wrong)


@pytest.mark.parametrize("wrong", [0.0, -1.0, float("nan"), float("inf")])
def test_power_must_be_positive(wrong: float) -> None:
    with pytest.raises(InputError, match="hotel"):
        PowerModel(hotel=wrong)


def test_the_battery_follows_from_the_endurance(mission: Instance) -> None:
    sweep = sweep_speeds(mission, [1.0, mission.fleet.speed], fleet_size=2, straight_lines=True)
    assert sweep.rows[1]["endurance"] == pytest.approx(9000.0)
    stated = sweep_speeds(mission, [1.0], fleet_size=2, battery=100.0, straight_lines=True)
    expected = PowerModel().endurance(100.0, 1.0)
    assert stated.rows[0]["endurance"] == pytest.approx(expected)


def test_an_unlimited_endurance_tells_of_no_battery(mission: Instance) -> None:
    endless = replace(mission, fleet=replace(mission.fleet, endurance=None, size=1))
    with pytest.raises(InputError, match="watt-hours"):
        sweep_speeds(endless, [1.0])


def test_a_reserve_costs_data_and_saves_vehicles(mission: Instance) -> None:
    uncertain = replace(mission, uncertainty=replace(mission.uncertainty, drift=0.3))
    sweep = sweep_reserves(Voyage.straight(uncertain), [0.0, 3.0], fleet_size=2, runs=40)
    late, rates = column(sweep.rows, "late_share"), column(sweep.rows, "completion_rate")
    assert late[0] > late[1]
    assert rates[0] >= rates[1]
    assert sweep.marked == (3.0 if late[1] <= 0.01 else None)
    assert "with at most 1 % late" in sweep.because
    sweep_figure(sweep)


@pytest.fixture
def forecast(mission: Instance, write: Callable[..., Path]) -> Instance:
    """The same near the origin, with a current that grows by 0.2 m/s an hour, for two hours."""
    near = tuple(replace(node, x=0.2 * node.x, y=0.2 * node.y) for node in mission.nodes[:4])
    ocean = replace(mission.ocean, currents=Currents(file=str(write("sea.nc"))))
    fleet = replace(mission.fleet, endurance=2200.0)
    pier = Point(0.0, 0.0)
    return replace(mission, nodes=near, start=pier, destination=pier, fleet=fleet, ocean=ocean)


def test_the_same_fleet_leaves_at_every_time(forecast: Instance) -> None:
    sweep = sweep_departures(forecast, [0.0, 1.0, 2.0], bound="none")
    assert [row["departure"] for row in sweep.rows] == [
        f"2020-03-01T0{hour}:00:00" for hour in (0, 1, 2)
    ]
    assert len(set(column(sweep.rows, "fleet_size"))) == 1
    rates = column(sweep.rows, "completion_rate")
    best = rates.index(max(rates))
    assert (sweep.marked, sweep.because) == (best, f"best, 2020-03-01 0{best}:00 UTC")


@pytest.mark.parametrize("beyond", [-1.0, 2.1])
def test_departures_beyond_the_forecast_are_refused_before_the_work(
    forecast: Instance, beyond: float
) -> None:
    with pytest.raises(
        InputError, match=r"^hours: .*choose hours from 2020-03-01T00:00:00 to .*T02:00:00"
    ):
        sweep_departures(forecast, [0.0, beyond], limits=Limits(0.0))


def test_a_single_time_is_no_forecast(forecast: Instance, write: Callable[..., Path]) -> None:
    write("sea.nc", hours=1)
    with pytest.raises(InputError, match=r"^ocean.currents.file: holds a single time"):
        sweep_departures(forecast, [0.0])


def test_departures_need_a_forecast(mission: Instance) -> None:
    with pytest.raises(InputError, match=r"^ocean.currents.file: needs a forecast"):
        sweep_departures(mission, [0.0])


def test_a_departure_is_stated_in_utc() -> None:
    first = datetime(2016, 1, 31, 23, 30, tzinfo=UTC)
    assert begin_after(first, 1.5) == "2016-02-01T01:00:00"
