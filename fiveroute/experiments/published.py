"""What the paper publishes of its Section IV, and what a faithful repetition may give.

The paper does not state start, destination and the distribution of the data; we took the
ones that fit its figures best (docs/formulation.md). The intervals are two standard errors
of a mean over 20 scenarios about the figures expected with them, plus the slack of the
solvers.
"""

from __future__ import annotations

from dataclasses import dataclass

__all__ = [
    "COORDINATED",
    "COORDINATION_GAIN",
    "EQUAL_FLEET_ADVANTAGE",
    "FEWER_AUVS",
    "FIXED_FLEET",
    "FLEETS",
    "MEAN_FLEET_SIZE",
    "SAME_FLEET",
    "WINS",
    "Published",
]


@dataclass(frozen=True, slots=True)
class Published:
    """A published mean and the interval in which ours should lie.

    Parameters
    ----------
    mean
        The paper's figure; None where it gives none.
    low, high
        Interval for a faithful repetition.
    """

    mean: float | None
    low: float
    high: float

    def accepts(self, value: float) -> bool:
        """Whether a mean of ours is in the interval."""
        return self.low <= value <= self.high


SAME_FLEET = {
    "giant-route": Published(0.947, 0.93, 0.965),
    "voronoi": Published(0.866, 0.80, 0.89),
    "k-means": Published(0.916, 0.90, 0.945),
    "ahc": Published(0.894, 0.86, 0.93),
}
"""Mean completion rates with M as estimated from the giant route, Fig. 7."""

FIXED_FLEET = {
    "giant-route": Published(0.947, 0.93, 0.965),
    "voronoi": Published(None, 0.0, 1.0),
    "k-means": Published(0.956, 0.94, 0.97),
    "ahc": Published(0.950, 0.92, 0.96),
}
"""Mean completion rates with M = 4 for all but the giant-route method, Fig. 8."""

MEAN_FLEET_SIZE = Published(3.70, 3.5, 3.95)
"""Mean number of AUVs of the giant-route method."""

COORDINATED = {3: 0.957, 4: 1.0}
"""By number of AUVs: completion rate of the one run shown with coordination, Figs. 9 and 10."""

COORDINATION_GAIN = {3: 0.076}
"""By how much it is above the same run without, Fig. 9."""

WINS = {"five-tier": 15, "ftcmp": 2, "rmmp": 3}
"""Scenarios of 20 in which each planner is best, Fig. 12."""

FLEETS = {3: 6, 4: 14}
"""Scenarios of 20 with so many AUVs, Fig. 13."""

FEWER_AUVS = 0.075
"""By how much the mean fleet is below four AUVs, Fig. 14."""

EQUAL_FLEET_ADVANTAGE = 0.062
"""By how much the five-tiered planner is above the mean of the others at equal M, Fig. 15."""
