"""How fiveroute compiles its inner loops.

Kernels are compiled once and kept on disk. numba notices when the file of a kernel changes,
but not when another kernel that it calls does; so they are kept in a folder named after
the source of all kernels, and the folders of other sources are cleared away.
`on_compilation` tells a caller when something is compiled, so that the first run can say
why it takes longer.
"""

from __future__ import annotations

import hashlib
import os
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any, TypeVar, cast

import numba
from numba.core import event

__all__ = ["kernel", "on_compilation"]

F = TypeVar("F", bound=Callable[..., Any])

_PACKAGE = Path(__file__).parent

_CONFIG: Any = numba.config


def kernel(function: F) -> F:
    """Compile to machine code on first use, without Python objects, cached on disk."""
    with _cached_in(_cache_folder()):
        return cast(F, numba.njit(cache=True, error_model="numpy")(function))


@cache
def _cache_folder() -> str:
    """Folder for the kernels of this source; numba's own choice if it cannot be written."""
    digest = hashlib.sha256()
    for part in (_PACKAGE, _PACKAGE / "models", _PACKAGE / "heuristics"):
        for path in sorted(part.rglob("*.py")):
            source = path.read_bytes()
            if b"@kernel" in source:
                digest.update(source)
    kept = _PACKAGE / "__pycache__"
    folder = kept / f"kernels-{digest.hexdigest()[:16]}"
    try:
        if not folder.is_dir():
            for stale in set(kept.glob("kernels-*")) - {folder}:
                shutil.rmtree(stale, ignore_errors=True)
            folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        return str(_CONFIG.CACHE_DIR)
    return str(folder if os.access(folder, os.W_OK) else _CONFIG.CACHE_DIR)


@contextmanager
def _cached_in(folder: str) -> Iterator[None]:
    """Let numba keep what is decorated meanwhile in `folder`; it asks when decorating."""
    before = _CONFIG.CACHE_DIR
    _CONFIG.CACHE_DIR = folder
    try:
        yield
    finally:
        _CONFIG.CACHE_DIR = before


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
