"""Tier 5, the coordination tier: discarding, picking up, and the auction of Algorithm 2.

At every node an AUV compares what it has before it with the time it has left, (24). If the time
does not suffice, it discards nodes of least phi (25), which become idle. Idle nodes are worth
psi (26), (27) to the AUVs that could still insert them, and an auction in rounds, (28) and (29),
shares them out: in each round every AUV wins one node at most; the winners insert what they won,
all psi are computed anew, and the next round follows, until nobody bids.

Where the pseudocode of Algorithm 2 and the text disagree, the text is followed: nodes have
prices, common to all AUVs; an opening bid is above the price, so that a node wanted by one AUV
only is awarded; an insertion must leave time for the whole remaining route; several nodes go in a
round, as in the paper's heat maps; and there is an end when no psi is positive.

Here the fleet is of one mind: everybody knows everything. The same tier, for AUVs that know only
what reached them, is in `fiveroute.sea.planners.five_tier`.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from fiveroute.sea.agents.auction import assign_by_auction
from fiveroute.sea.courses.course import Course
from fiveroute.sea.courses.discarding import discard
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.sea.courses.picking import offers

__all__ = ["Award", "assign_idle_nodes", "coordinate"]


@dataclass(frozen=True, slots=True)
class Award:
    """A node won.

    Parameters
    ----------
    auv
        The winner.
    node
        What it won.
    """

    auv: int
    node: int


def assign_idle_nodes(
    view: Outlook, courses: Sequence[Course], idle: Collection[int], epsilon: float | None = None
) -> tuple[tuple[Course, ...], tuple[Award, ...]]:
    """Algorithm 2: share the idle nodes out by auction, in rounds.

    Parameters
    ----------
    view
        What the AUVs expect.
    courses
        What every AUV has before it, its own clock included.
    idle
        The idle nodes.
    epsilon
        Least rise of a price; None takes a thousandth of the greatest psi.

    Returns
    -------
    courses
        The courses with what was won.
    awards
        Who won what, round by round.
    """
    fleet, left = list(courses), np.array(sorted(idle), dtype=np.int64)
    awards: list[Award] = []
    while len(left) and fleet:
        bids = [offers(view, course, left) for course in fleet]
        won = assign_by_auction(np.array([psi for psi, _ in bids]), epsilon)
        if (won < 0).all():
            break
        for m, j in enumerate(won.tolist()):
            if j >= 0:
                awards.append(Award(m, int(left[j])))
                fleet[m] = fleet[m].with_node(awards[-1].node, int(bids[m][1][j]))
        left = np.delete(left, won[won >= 0])
    return tuple(fleet), tuple(awards)


def coordinate(
    view: Outlook, courses: Sequence[Course], auv: int, idle: Collection[int]
) -> tuple[tuple[Course, ...], tuple[int, ...], tuple[Award, ...]]:
    """What the fleet does when one of the AUVs has reached a node.

    Returns
    -------
    courses
        The new courses.
    discarded
        What this AUV discarded, (24) and (25).
    awards
        What the auction gave to whom.
    """
    fleet = list(courses)
    fleet[auv], discarded = discard(view, fleet[auv])
    after, awards = assign_idle_nodes(view, fleet, {*idle, *discarded})
    return after, discarded, awards
