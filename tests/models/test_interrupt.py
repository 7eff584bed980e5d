"""Passing an interrupt on."""

import threading

from fiveroute.models.interrupt import on_interrupt


def test_stop_is_called_until_the_block_is_left() -> None:
    interrupt, twice = threading.Event(), threading.Event()
    calls: list[None] = []

    def stop() -> None:
        calls.append(None)
        if len(calls) >= 2:
            twice.set()

    with on_interrupt(interrupt, stop):
        interrupt.set()
        assert twice.wait(10.0)


def test_nothing_happens_without_an_interrupt() -> None:
    calls: list[None] = []
    with on_interrupt(threading.Event(), lambda: calls.append(None)):
        pass
    assert calls == []
    assert not any(thread.name == "fiveroute-interrupt" for thread in threading.enumerate())
