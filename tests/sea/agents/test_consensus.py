"""What one AUV's beliefs do to another's, rule by rule of the table."""

import pytest

from fiveroute.sea.agents.consensus import COLLECTED, HELD, NOBODY, Beliefs, View, longest_view

ME, SENDER, THIRD, FOURTH = 1, 0, 2, 3
OLD, NEW = 10.0, 20.0


def heard(
    mine: tuple[int, float],
    theirs: tuple[int, float],
    *,
    news_of_third: float = OLD,
    news_of_fourth: float = OLD,
) -> tuple[int, float]:
    """What is believed of node 1 after a message; the receiver's own news are all from `OLD`."""
    beliefs = Beliefs(ME, [NOBODY, mine[0], NOBODY], [0.0, mine[1], 0.0], [OLD] * 4)
    stamps = (NEW, OLD, news_of_third, news_of_fourth)
    view = View(SENDER, None, (NOBODY, theirs[0], NOBODY), (0.0, theirs[1], 0.0), stamps)
    has_changed = beliefs.hear(view)
    now = beliefs.winners[1], beliefs.bids[1]
    assert has_changed == (now != mine)
    assert beliefs.stamps == [NEW, OLD, max(OLD, news_of_third), max(OLD, news_of_fourth)]
    return now


IDLE = (NOBODY, 0.0)


@pytest.mark.parametrize(
    ("mine", "theirs", "after"),
    [
        ((ME, 1.0), (SENDER, 2.0), (SENDER, 2.0)),
        ((ME, 2.0), (SENDER, 1.0), (ME, 2.0)),
        ((ME, 2.0), (SENDER, 2.0), (SENDER, 2.0)),  # of equal bids the lower number
        ((SENDER, 3.0), (SENDER, 1.0), (SENDER, 1.0)),
        ((THIRD, 1.0), (SENDER, 2.0), (SENDER, 2.0)),
        ((THIRD, 2.0), (SENDER, 1.0), (THIRD, 2.0)),
        (IDLE, (SENDER, 1.0), (SENDER, 1.0)),
        ((ME, 1.0), (ME, 3.0), (ME, 1.0)),
        ((SENDER, 1.0), (ME, 3.0), IDLE),
        ((THIRD, 1.0), (ME, 3.0), (THIRD, 1.0)),
        (IDLE, (ME, 3.0), IDLE),
        ((ME, 1.0), (THIRD, 2.0), (ME, 1.0)),
        ((SENDER, 1.0), (THIRD, 2.0), IDLE),
        ((THIRD, 1.0), (THIRD, 2.0), (THIRD, 1.0)),
        ((FOURTH, 1.0), (THIRD, 2.0), (FOURTH, 1.0)),
        (IDLE, (THIRD, 2.0), IDLE),
        ((ME, 1.0), IDLE, (ME, 1.0)),
        ((SENDER, 1.0), IDLE, IDLE),
        ((THIRD, 1.0), IDLE, (THIRD, 1.0)),
        ((ME, HELD), (SENDER, COLLECTED), (SENDER, COLLECTED)),
        ((THIRD, COLLECTED), (SENDER, HELD), (THIRD, COLLECTED)),
    ],
)
def test_without_news_of_others(
    mine: tuple[int, float], theirs: tuple[int, float], after: tuple[int, float]
) -> None:
    assert heard(mine, theirs) == after


@pytest.mark.parametrize(
    ("mine", "theirs", "after"),
    [
        ((THIRD, 2.0), (SENDER, 1.0), (SENDER, 1.0)),
        ((THIRD, 1.0), (ME, 3.0), IDLE),
        ((ME, 1.0), (THIRD, 2.0), (THIRD, 2.0)),
        ((ME, 2.0), (THIRD, 1.0), (ME, 2.0)),
        ((SENDER, 1.0), (THIRD, 2.0), (THIRD, 2.0)),
        ((THIRD, 1.0), (THIRD, 2.0), (THIRD, 2.0)),
        ((FOURTH, 1.0), (THIRD, 2.0), (THIRD, 2.0)),
        ((FOURTH, 2.0), (THIRD, 1.0), (FOURTH, 2.0)),
        (IDLE, (THIRD, 2.0), (THIRD, 2.0)),
        ((THIRD, 1.0), IDLE, IDLE),
    ],
)
def test_with_news_of_the_third(
    mine: tuple[int, float], theirs: tuple[int, float], after: tuple[int, float]
) -> None:
    assert heard(mine, theirs, news_of_third=NEW) == after


def test_with_news_of_both_the_newer_story_is_taken() -> None:
    mine, theirs = (FOURTH, 2.0), (THIRD, 1.0)
    assert heard(mine, theirs, news_of_third=NEW, news_of_fourth=NEW) == theirs
    assert heard(mine, theirs, news_of_third=0.0, news_of_fourth=NEW) == IDLE


def test_a_message_that_has_been_overtaken_is_ignored() -> None:
    beliefs = Beliefs(ME, [NOBODY] * 3, [0.0] * 3, [NEW, OLD])
    late = View(SENDER, None, (NOBODY, SENDER, NOBODY), (0.0, 1.0, 0.0), (OLD, OLD))
    assert not beliefs.hear(late)
    assert beliefs.winners[1] == NOBODY


def test_a_frame_states_its_bits() -> None:
    view = View(0, None, (NOBODY, 0, 1, NOBODY), (0.0, HELD, 0.5, 0.0), (1.0, 2.0))
    assert view.bits(2) == 36 + 20 + 16 + 32


def test_no_view_is_longer_than_one_of_true_bids() -> None:
    n, fleet = 7, 3
    winners, stamps = (0,) * (n + 2), (NEW,) * fleet
    lengths = [
        View(ME, None, winners, (0.0, *(bid,) * n, 0.0), stamps).bits(n)
        for bid in (0.0, 0.5, HELD, COLLECTED)
    ]
    assert max(lengths) == lengths[1] == longest_view(n, fleet)
