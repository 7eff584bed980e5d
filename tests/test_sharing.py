"""Tasks shared out: every answer once, wherever it comes from."""

import asyncio
import socket
from collections.abc import Iterator
from contextlib import closing

import pytest

from fiveroute.errors import InputError
from fiveroute.sharing import require_scheduler, share_out


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
    numbers = range(20, 70)
    with closing(share_out(square, [(number,) for number in numbers], workers=2)) as answers:
        assert next(answers) in {number * number for number in numbers}


@pytest.fixture
def mute() -> Iterator[str]:
    """Address of somebody who takes the call and says nothing."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        yield f"tcp://127.0.0.1:{server.getsockname()[1]}"


@pytest.fixture
def patience(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("distributed")
    monkeypatch.setattr("fiveroute.sharing._PATIENCE", 0.3)


@pytest.mark.usefixtures("patience")
@pytest.mark.parametrize(
    "address", ["tcp://127.0.0.1:1", "127.0.0.1", "", "http://127.0.0.1:1", "tls://127.0.0.1:1"]
)
def test_nobody_is_there(address: str, capfd: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(InputError, match="no Dask scheduler answers there"):
        require_scheduler(address)
    with pytest.raises(InputError, match="no Dask scheduler answers there"):
        list(share_out(abs, [(1,)], scheduler=address))
    assert capfd.readouterr().err == "", "no complaint of a client that found nobody"


@pytest.mark.usefixtures("patience")
def test_somebody_else_is_there(mute: str) -> None:
    with pytest.raises(InputError, match=r"not in 0\.3 s"):
        require_scheduler(mute)


@pytest.mark.usefixtures("patience")
def test_a_notebook_has_a_loop_that_runs() -> None:
    async def cell() -> None:
        require_scheduler("tcp://127.0.0.1:1")

    loop = asyncio.new_event_loop()
    with pytest.raises(InputError, match="no Dask scheduler"):
        loop.run_until_complete(cell())
    loop.close()
