"""How fiveroute compiles its inner loops.

Kernels are compiled once per machine and kept on disk. `on_compilation` tells a caller
when that happens, so that the first run can say why it takes longer.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba
from numba.core import event

__all__ = ["kernel", "on_compilation"]

F = TypeVar("F", bound=Callable[..., Any])


def kernel(function: F) -> F:
    """Compile to machine code on first use, without Python objects, cached on disk."""
    return cast(F, numba.njit(cache=True, error_model="numpy")(function))


def on_compilation(announce: Callable[[], None]) -> None:
    """Call `announce` once, when the first kernel that is not on disk gets compiled."""

    class _Once(event.Listener):
        told = False

        def on_start(self, event: Any) -> None:
            if not self.told:
                self.told = True
                announce()

        def on_end(self, event: Any) -> None:
            pass

    event.register("numba:compile", _Once())  # type: ignore[no-untyped-call]
