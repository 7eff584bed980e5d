"""Tasks shared out: every answer once, wherever it comes from."""

from contextlib import closing

import pytest

from fiveroute.errors import InputError
from fiveroute.sharing import share_out


def square(number: int) -> int:
    if number == 13:
        raise InputError("brings bad luck", value=number)
    return number * number


@pytest.mark.parametrize("workers", [1, 2])
def test_every_task_is_answered_once(workers: int) -> None:
    tasks = [(number,) for number in range(9)]
    assert sorted(share_out(square, tasks, workers=workers)) == [n * n for n in range(9)]
    assert list(share_out(square, [], workers=workers)) == []


@pytest.mark.parametrize("workers", [1, 2])
def test_errors_come_through(workers: int) -> None:
    with pytest.raises(InputError, match="13: brings bad luck"):
        list(share_out(square, [(13,)], workers=workers))


def test_here_nothing_is_done_before_it_is_asked_for() -> None:
    asked: list[int] = []
    with closing(share_out(asked.append, [(1,), (2,), (3,)])) as answers:
        next(answers)
    assert asked == [1]


def test_what_nobody_waits_for_is_given_up_in_silence() -> None:
    with closing(share_out(square, [(number,) for number in range(50)], workers=2)) as answers:
        assert next(answers) in {number * number for number in range(50)}
