import math
import pickle
import time

import pytest

from fiveroute.errors import InputError
from fiveroute.limits import Limits, WorkingTime


def test_without_limits_a_clock_never_expires() -> None:
    clock = Limits().start()
    assert clock.left == math.inf
    assert not clock.expired


def test_no_time_at_all_expires_at_once() -> None:
    assert Limits(time=0.0).start().expired


def test_an_interrupt_expires_every_clock_of_the_description() -> None:
    limits = Limits()
    clock, part = limits.start(), limits.within(5.0).start()
    limits.interrupt.set()
    assert clock.expired
    assert part.interrupted


def test_each_start_is_fresh() -> None:
    limits = Limits(time=1000.0)
    first = limits.start()
    assert limits.start().left >= first.left


def test_within_never_extends() -> None:
    assert Limits(time=3.0).within(5.0).time == 3.0
    assert Limits(time=3.0).within(-1.0).time == 0.0
    assert Limits(time=3.0, gap=0.1).within(2.0).gap == 0.1


def test_a_copy_for_another_process_has_an_interrupt_of_its_own() -> None:
    limits = Limits(time=3.0, gap=0.1, work=5.0)
    limits.interrupt.set()
    copy = pickle.loads(pickle.dumps(limits))
    assert copy == limits
    assert not copy.interrupt.is_set()


def test_work_is_counted_and_ends_a_run() -> None:
    clock = Limits(work=10.0).start()
    clock.spend(4.0)
    assert not clock.expired
    assert clock.rest().work == 6.0
    assert clock.rest().within(1.0).work == 6.0
    clock.spend(7.0)
    assert clock.expired
    assert clock.work_left == 0.0


@pytest.mark.parametrize("bad", [{"time": -1.0}, {"gap": -0.1}, {"time": math.nan}, {"work": -1.0}])
def test_negative_limits_are_refused(bad: dict[str, float]) -> None:
    with pytest.raises(InputError, match="must not be negative"):
        Limits(**bad)  # type: ignore[arg-type]


def test_halts_do_not_count() -> None:
    working, begun = WorkingTime(), time.perf_counter()
    before = working.now()
    for _ in range(2):
        working.halt()
        working.halt()
        still = working.now()
        working.resume()
        assert working.now() == still  # the outer halt goes on
        time.sleep(0.01)
        working.resume()
    assert working.now() > still
    assert working.now() - before <= time.perf_counter() - begun - 0.02
