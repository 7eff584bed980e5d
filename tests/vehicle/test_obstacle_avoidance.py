"""Obstacles that the plan did not know: passed without contact, or the voyage says it could not.

All clearances are computed anew from the sailed track.
"""

import math
from collections import Counter
from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.ocean.barriers import Barriers, clearance, leg_clearance, no_barriers
from fiveroute.ocean.current_grid import CurrentGrid
from fiveroute.vehicle.dynamics import Vehicle
from fiveroute.vehicle.obstacle_avoidance import Avoidance
from fiveroute.vehicle.sailed_track import Outcome, SailedTrack
from fiveroute.vehicle.tracking import sail_track

Floats = NDArray[np.float64]
Water = Callable[[float, float], CurrentGrid]
LEG = np.array([[0.0, 0.0], [1000.0, 0.0]])
SLOW = Vehicle(1.0)
POCKET = np.array(  # open to the west, 150 m wide and 100 m deep
    [(400, -75), (500, -75), (500, 75), (400, 75), (400, 67), (492, 67), (492, -67), (400, -67)]
)


def discs(*circles: tuple[float, float, float]) -> Barriers:
    return no_barriers()._replace(circles=np.array(circles, dtype=np.float64).reshape(-1, 3))


def polygons(*shapes: Floats) -> Barriers:
    return no_barriers()._replace(
        corners=np.concatenate(shapes).astype(np.float64), first=np.cumsum([0, *map(len, shapes)])
    )


def proven_clearance(barriers: Barriers, sailed: SailedTrack) -> float:
    track = sailed.positions
    return min(leg_clearance(barriers, *a, *b) for a, b in pairwise(track))


def random_discs(rng: np.random.Generator) -> Barriers:
    """Discs, few or many, that leave 40 m of water around both ends."""
    number = int(rng.integers(1, 25))
    circles = rng.uniform((-200.0, -400.0, 5.0), (1200.0, 400.0, 80.0), (number, 3))
    distance = np.hypot(*(circles[:, None, :2] - LEG[None]).transpose(2, 0, 1)) - circles[:, 2:]
    return discs(*circles[(distance > 40.0).all(axis=1)])


def spiked(rng: np.random.Generator) -> Barriers:
    """Stars with points and pockets, which may overlap."""
    shapes = []
    for _ in range(rng.integers(1, 8)):
        angle = np.sort(rng.uniform(0.0, 2.0 * math.pi, rng.integers(3, 12)))
        radius = rng.uniform(10.0, 120.0, len(angle))[:, None]
        centre = rng.uniform((100.0, -150.0), (900.0, 150.0))
        shapes.append(centre + radius * np.column_stack([np.cos(angle), np.sin(angle)]))
    return polygons(*shapes)


@pytest.mark.parametrize("offset", [-40.0, 0.0, 3.0, 55.0])
@pytest.mark.parametrize("across", [0.0, 0.5])
def test_one_obstacle_is_passed_and_the_leg_taken_up_again(
    offset: float, across: float, water: Water
) -> None:
    rock = discs((500.0, offset, 60.0))
    sailed = sail_track(water(0.0, across), LEG, SLOW, barriers=rock)
    assert sailed.outcome is Outcome.ARRIVED
    assert sailed.manoeuvres >= 1
    assert 0.0 < sailed.manoeuvring < 500.0
    assert sailed.least_clearance == pytest.approx(proven_clearance(rock, sailed), abs=1e-9)
    assert sailed.least_clearance > 5.0
    assert np.abs(sailed.cross_track[-100:]).max() < 0.2


def test_an_obstacle_beside_the_leg_is_no_reason_to_turn(water: Water) -> None:
    sailed = sail_track(water(0.0, 0.0), LEG, SLOW, barriers=discs((500.0, 75.0, 60.0)))
    assert sailed.manoeuvres == 0
    assert np.abs(sailed.cross_track).max() < 1e-6


def test_a_pocket_is_left_again(water: Water) -> None:
    pocket = polygons(POCKET)
    sailed = sail_track(water(0.0, 0.0), LEG, SLOW, barriers=pocket)
    assert sailed.outcome is Outcome.ARRIVED
    assert proven_clearance(pocket, sailed) > 2.0


def test_an_island_of_a_land_mask_is_passed(water: Water) -> None:
    x, y = np.meshgrid(np.arange(0.0, 1001.0, 50.0), np.arange(-500.0, 501.0, 50.0))
    island = no_barriers()._replace(
        land=np.hypot(x - 500.0, y - 30.0) - 150.0, land_south=-500.0, land_step=50.0
    )
    sailed = sail_track(water(0.0, 0.3), LEG, SLOW, barriers=island)
    assert sailed.outcome is Outcome.ARRIVED
    assert proven_clearance(island, sailed) > 3.0


def test_many_random_discs_are_passed_without_contact(water: Water) -> None:
    outcomes: Counter[Outcome] = Counter()
    for seed in range(120):
        rng = np.random.default_rng(seed)
        waters = random_discs(rng)
        towards, pace = rng.uniform(0.0, 2.0 * math.pi), rng.uniform(0.0, 0.5)
        grid = water(pace * math.cos(towards), pace * math.sin(towards))
        sailed = sail_track(grid, LEG, SLOW, barriers=waters)
        outcomes[sailed.outcome] += 1
        assert proven_clearance(waters, sailed) > 0.0
    assert outcomes[Outcome.ARRIVED] >= 117
    assert outcomes[Outcome.ARRIVED] + outcomes[Outcome.BLOCKED] == 120


def test_who_arrives_past_spikes_and_pockets_has_touched_none(water: Water) -> None:
    arrived = collided = total = 0
    for seed in range(80):
        rng = np.random.default_rng(seed)
        waters = spiked(rng)
        if min(clearance(waters, x, y) for x, y in LEG) < 40.0:
            continue
        sailed = sail_track(water(0.1, 0.2), LEG, SLOW, barriers=waters)
        touched = proven_clearance(waters, sailed) < 0.0
        assert touched == (sailed.outcome is Outcome.COLLIDED)
        total, arrived = total + 1, arrived + (sailed.outcome is Outcome.ARRIVED)
        collided += touched
    assert arrived > 0.85 * total
    assert collided < 0.02 * total


def test_a_ring_around_the_end_is_reported(water: Water) -> None:
    angle = np.linspace(0.0, 2.0 * math.pi, 30, endpoint=False)
    ring = discs(*((1000 + 150 * math.cos(a), 150 * math.sin(a), 20.0) for a in angle))
    sailed = sail_track(water(0.0, 0.0), LEG, SLOW, barriers=ring)
    assert sailed.outcome is Outcome.BLOCKED
    assert proven_clearance(ring, sailed) > 0.0


def test_without_a_sonar_worth_the_name_it_collides_and_says_so(water: Water) -> None:
    blind = Avoidance(standoff=0.0)
    wall = polygons(np.array([(500, -900), (510, -900), (510, 900), (500, 900)]))
    sailed = sail_track(water(0.5, 0.0), LEG, SLOW, barriers=wall, avoidance=blind)
    assert sailed.outcome in {Outcome.COLLIDED, Outcome.BLOCKED}
    assert sail_track(water(0.0, 0.0), LEG, SLOW, barriers=discs((0, 0, 9))).outcome is (
        Outcome.COLLIDED
    )


def test_a_margin_is_kept_besides(water: Water) -> None:
    rock = discs((500.0, 0.0, 60.0))
    near = sail_track(water(0.0, 0.0), LEG, SLOW, barriers=rock)
    far = sail_track(water(0.0, 0.0), LEG, SLOW, barriers=rock._replace(margin=15.0))
    assert far.least_clearance > 5.0  # beyond the margin
    assert proven_clearance(rock, far) > near.least_clearance + 10.0


def test_bad_numbers_are_named() -> None:
    with pytest.raises(InputError, match="standoff"):
        Avoidance(standoff=-1.0)
    with pytest.raises(InputError, match="calm"):
        Avoidance(calm=math.inf)
