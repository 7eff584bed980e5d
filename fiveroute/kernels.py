"""How fiveroute compiles its inner loops.

Kernels are compiled once and kept on disk. numba notices when the file of a kernel changes,
but not when a kernel or a constant that it takes from another file does; so the kernels of
a module are kept in a folder named after the source of the module and of all it imports,
and the folders of its former sources are cleared away. `on_compilation` tells a caller when
something is compiled, so that the first run can say why it takes longer.
"""

from __future__ import annotations

import hashlib
import os
import re
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any, TypeVar, cast

import numba
from numba.core import event

__all__ = ["kernel", "on_compilation", "source_digest"]

F = TypeVar("F", bound=Callable[..., Any])

_PACKAGE = Path(__file__).parent

_CONFIG: Any = numba.config


def kernel(function: F) -> F:
    """Compile to machine code on first use, without Python objects or the lock, kept on disk."""
    with _cached_in(_cache_folder(function.__module__)):
        return cast(F, numba.njit(cache=True, error_model="numpy", nogil=True)(function))


@cache
def _cache_folder(module: str) -> str:
    """Folder for the kernels of a module; numba's own choice if it cannot be written."""
    kept = _PACKAGE / "__pycache__"
    folder = kept / f"kernels-{module}-{source_digest(module)[:16]}"
    try:
        if not folder.is_dir():
            for stale in set(kept.glob(f"kernels-{module}-*")) - {folder}:
                shutil.rmtree(stale, ignore_errors=True)
            folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        return str(_CONFIG.CACHE_DIR)
    return str(folder if os.access(folder, os.W_OK) else _CONFIG.CACHE_DIR)


def source_digest(module: str) -> str:
    """SHA-256 of the source of a module and of all that it imports from fiveroute."""
    digest = hashlib.sha256()
    for name in sorted(_imported({module})):
        digest.update(_source(name).encode())
    return digest.hexdigest()


def _imported(modules: set[str]) -> set[str]:
    """Modules of fiveroute, and all that these import from it, directly or not."""
    known: set[str] = set()
    while modules:
        known |= modules
        modules = {name for module in modules for name in _imports(module)} - known
    return known


@cache
def _imports(module: str) -> frozenset[str]:
    return frozenset(re.findall(r"^ *from (fiveroute\.[\w.]+) import", _source(module), re.M))


@cache
def _source(module: str) -> str:
    """Source of a module of fiveroute; nothing for any other."""
    parts = module.split(".")
    if parts[0] != _PACKAGE.name:
        return ""
    path = _PACKAGE.joinpath(*parts[1:])
    file = path / "__init__.py" if path.is_dir() else path.with_suffix(".py")
    return file.read_text(encoding="utf-8") if file.is_file() else ""


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
