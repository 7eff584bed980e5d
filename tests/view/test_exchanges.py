from fiveroute.sea.events import Event, Frame
from fiveroute.view.exchanges import Exchange, exchanges

CALL = Frame(0, 0, None, "call", 68)
BID = Frame(1, 2, 0, "bid", 52)
LATE = Frame(2, 0, None, "report", 70)

EVENTS = (
    Event(10.0, 0, "send", frame=CALL),
    Event(11.0, 2, "receive", frame=CALL),
    Event(20.0, 2, "send", frame=BID),
    Event(25.0, 3, "fail"),
    Event(30.0, 0, "send", frame=LATE),
    Event(31.0, 1, "receive", frame=LATE),
    Event(31.5, 2, "receive", frame=LATE),
    Event(40.0, 1, "send"),
)


def test_messages_reach_some_and_miss_others() -> None:
    """Those that have failed are not missed, and the sender does not hear itself."""
    assert exchanges(EVENTS, 4) == {
        0: Exchange(CALL, 10.0, {2: 11.0}, (1, 3)),
        1: Exchange(BID, 20.0, {}, (0,)),
        2: Exchange(LATE, 30.0, {1: 31.0, 2: 31.5}, ()),
    }


def test_nobody_talks_in_a_log_that_does_not_tell() -> None:
    assert exchanges((Event(1.0, 0, "send"), Event(2.0, 1, "receive")), 2) == {}
