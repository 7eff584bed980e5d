"""Seeds: every purpose has random numbers of its own, and so has every run and decision."""

import itertools

from fiveroute.sea.seeds import Purpose, decision_seed, generator


def test_no_two_purposes_or_runs_share_their_numbers() -> None:
    draws = [
        generator(purpose, 7, run).random()
        for purpose, run in itertools.product(Purpose, (None, 0, 1))
    ]
    assert len(set(draws)) == len(draws)


def test_a_purpose_has_the_same_numbers_again() -> None:
    once, again = (generator(Purpose.OCEAN, 7, 3).random(5).tolist() for _ in range(2))
    assert once == again


def test_decisions_of_a_mission_have_seeds_of_their_own() -> None:
    decisions = itertools.product(range(50), range(8), range(200))
    seeds = [decision_seed(*decision) for decision in decisions]
    assert len(set(seeds)) == len(seeds)
