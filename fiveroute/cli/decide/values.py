"""Values to try, as people list them: ``1,2,3``, or ``FROM:TO:STEP`` with both ends included."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import click

__all__ = ["values"]

_MOST_STEPS = 1000.0


def values(name: str, *, default: str, what: str) -> Callable[..., Any]:
    """An option that takes a list of numbers.

    Parameters
    ----------
    name
        The option, such as ``--sizes``.
    default
        The list without it.
    what
        What the numbers are.
    """
    return click.option(
        name, type=_NUMBERS, default=default, show_default=True, metavar="LIST", help=what
    )


class _Numbers(click.ParamType[tuple[float, ...]]):
    name = "numbers"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[float, ...]:
        if isinstance(value, tuple):
            return value
        try:
            numbers = _steps(value) if ":" in value else tuple(map(float, value.split(",")))
        except ValueError:
            numbers = ()
        if not numbers or not all(map(math.isfinite, numbers)):
            self.fail(f"{value!r} is no list of numbers such as 1,2,3 or 0:24:6", param, ctx)
        return numbers


_NUMBERS = _Numbers()


def _steps(text: str) -> tuple[float, ...]:
    """``FROM:TO:STEP``, without the crumbs of binary fractions; none where that makes no list."""
    first, last, step = map(float, text.split(":"))
    if not (step > 0.0 and last >= first and (last - first) / step <= _MOST_STEPS):
        return ()
    count = int((last - first) / step + 1e-9) + 1
    return tuple(float(f"{first + k * step:.12g}") for k in range(count))
