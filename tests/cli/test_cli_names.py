"""Names come from files of strangers: they are shown as they are, and a terminal obeys none."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from fiveroute.cli.notes import note

MARKUP = "[/b] [red]:fire:"
CONTROLS = "a\x1b]0;b\x07\r\nc\u202e"


@pytest.mark.parametrize(
    ("command", "more"), [("plan", ("--bound", "none")), ("decide", ()), ("giant-route", ())]
)
def test_names_are_no_markup(
    call: Any, edited: Callable[..., Path], command: str, more: tuple[str, ...]
) -> None:
    file = edited(name=MARKUP, nodes__0__id="[/i]$x_{$", nodes__1__id=CONTROLS)
    words = (command, "fleet-size") if command == "decide" else (command,)
    choices = ("--sizes", "1", "--bound", "none") if command == "decide" else more
    answer = call(*words, file, "--straight-lines", *choices)
    assert answer.code == 0, answer.err
    if command != "giant-route":
        assert MARKUP in answer.out
    if command != "decide":
        assert "[/i]$x_{$" in answer.out
        assert "a ]0;b   c " in answer.out
    assert (answer.out + answer.err).replace("\n", "").isprintable()


def test_notes_are_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    note(CONTROLS)
    assert capsys.readouterr().err == "fiveroute: a ]0;b   c \n"
