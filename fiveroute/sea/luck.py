"""Luck: what every leg really takes in one run of a mission.

A leg has its luck whether it is sailed or not, and whoever sails it: f(t_ij) is drawn by a
counter-based generator, a function of (seed, run, i, j) alone. So all planners meet the same
ocean, run by run and arc by arc, whatever the order of their legs and the number of workers,
and their differences have less variance than their results (common random numbers).

The generator hashes the four numbers with the finaliser of SplitMix64 (Steele, Lea, Flood 2014,
doi 10.1145/2660193.2660195; counter-based generators: Salmon et al. 2011, doi
10.1145/2063384.2063405). Normal numbers are made of two uniform ones after Box and Muller,
numbers of manoeuvres by inversion of a third.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.tiers.actuation import LegLaw, actual_leg, manoeuvre_count

__all__ = ["Leg", "Luck", "leg_luck", "stream"]

_GOLDEN = np.uint64(0x9E3779B97F4A7C15)  # 2^64 over the golden ratio
_PRIME = np.uint64(0xD6E8FEB86659FD93)


class Leg(NamedTuple):
    """What a leg takes in one run.

    Parameters
    ----------
    time
        Seconds to its end; where it is not reached, until the AUV is lost.
    moments
        Seconds from its beginning to that of each manoeuvre.
    arrives
        Whether its end is reached.
    """

    time: float
    moments: tuple[float, ...] = ()
    arrives: bool = True


@dataclass(frozen=True, slots=True)
class Luck:
    """The real leg times of one run.

    Parameters
    ----------
    law
        The distribution of every leg.
    seed
        Seed of the whole simulation.
    run
        Number of the run, counted from 0.
    """

    law: LegLaw
    seed: int
    run: int

    @property
    def key(self) -> np.uint64:
        """The stream of random numbers of this run."""
        return stream(self.seed, self.run)

    def leg(self, i: int, j: int, begin: float = 0.0) -> Leg:
        """What the leg from i to j takes, whenever it begins; manoeuvres are spread evenly."""
        time, count = leg_luck(self.law, self.key, i, j)
        return Leg(time, tuple(time * (k + 1) / (count + 1) for k in range(count)))

    def matrix(self) -> NDArray[np.float64]:
        """All leg times in seconds, shape (n + 2, n + 2): what only a clairvoyant knows."""
        return _all_legs(self.law, self.key)


def stream(seed: int, run: int) -> np.uint64:
    """The stream of a run: seeds and runs that differ give unrelated streams."""
    return np.uint64(np.random.SeedSequence((seed, run)).generate_state(1, np.uint64)[0])


@kernel
def leg_luck(law: LegLaw, key: np.uint64, i: int, j: int) -> tuple[float, int]:
    """Time in seconds that a leg takes in the run of this stream, and the manoeuvres on it."""
    state = _mix(key + np.uint64(i) * _GOLDEN)
    state = _mix(state + np.uint64(j) * _PRIME)
    first = _mix(state + _GOLDEN)
    second = _mix(first + _GOLDEN)
    third = _mix(second + _GOLDEN)
    radius = math.sqrt(-2.0 * math.log(1.0 - _unit(first)))
    angle = 2.0 * math.pi * _unit(second)
    count = manoeuvre_count(law.encounters[i, j], _unit(third), radius * math.sin(angle))
    return actual_leg(law, i, j, radius * math.cos(angle), count), count


@kernel
def _mix(state: np.uint64) -> np.uint64:
    """The finaliser of SplitMix64."""
    state = (state ^ (state >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    state = (state ^ (state >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return state ^ (state >> np.uint64(31))


@kernel
def _unit(state: np.uint64) -> float:
    """A number on [0, 1) of the upper 53 bits."""
    return float(state >> np.uint64(11)) * 2.0**-53


@kernel
def _all_legs(law: LegLaw, key: np.uint64) -> NDArray[np.float64]:
    size = len(law.planned)
    legs = np.zeros((size, size))
    for i in range(size):
        for j in range(size):
            if i != j:
                legs[i, j] = leg_luck(law, key, i, j)[0]
    return legs
