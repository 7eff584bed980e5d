"""What is drawn from the seed of a simulation, and for what.

Every purpose draws from a stream of its own, of the seed, the purpose and, but for what is done
before departure, the number of the run. So no draw depends on how many others there were: whether
messages get lost, say, changes nothing about who fails.
"""

from __future__ import annotations

from enum import IntEnum

import numpy as np

__all__ = ["REHEARSALS", "TRIAL_OCEANS", "Purpose", "decision_seed", "generator"]

REHEARSALS = 1 << 40
"""Added to the seed of a simulation for the luck of rehearsals, which is not that of its runs."""

TRIAL_OCEANS = 1 << 41
"""Added to the seed of a simulation for the oceans that the law of a vehicle is fitted in."""

_BASE = 997  # a prime larger than the numbers of AUVs and, mostly, of events


class Purpose(IntEnum):
    """What random numbers are for."""

    FAILURES = 1
    CHANNEL = 2
    CLAIRVOYANT = 3
    DEPARTURE = 4
    OCEAN = 5
    WALKS = 6


def generator(purpose: Purpose, seed: int, run: int | None = None) -> np.random.Generator:
    """The random numbers for a purpose, in a run or, where none is named, before departure."""
    where = (seed,) if run is None else (seed, run)
    return np.random.default_rng((*where, purpose.value))


def decision_seed(run: int, *numbers: int) -> int:
    """Seed of a search on board in a run, by numbers that tell its decisions apart."""
    seed = run
    for number in numbers:
        seed = seed * _BASE + number
    return seed
