"""How fiveroute compiles its inner loops.

Kernels are compiled once and kept on disk. numba notices when the file of a kernel changes,
but not when a kernel or a constant that it takes from another file does; so the kernels of
a module are kept in a folder named after the source of the module and of all it imports,
and the folders of its former sources are cleared away. What is kept ends in its own digest: a
kernel that a full disk or a power failure has spoilt is compiled anew, never run.
`on_compilation` tells a caller when something is compiled, so that the first run can say why it
takes longer; the clocks of `fiveroute.limits` stand still meanwhile.
"""

from __future__ import annotations

import hashlib
import os
import re
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path
from typing import Any, TypeVar, cast

import numba
from numba.core import caching, event

from fiveroute.limits import WORKING_TIME

__all__ = ["kernel", "on_compilation", "source_digest"]

F = TypeVar("F", bound=Callable[..., Any])

_PACKAGE = Path(__file__).parent

_CONFIG: Any = numba.config
_NUMBA: Any = caching

_SEAL = 32
"""Bytes of a digest."""


def kernel(function: F) -> F:
    """Compile to machine code on first use, without Python objects or the lock, kept on disk."""
    compiled: Any = numba.njit(error_model="numpy", nogil=True)(function)
    with _cached_in(_cache_folder(function.__module__)), suppress(RuntimeError):
        compiled._cache = _KernelCache(function)  # RuntimeError: there is no folder to keep it in
    return cast(F, compiled)


class _SealedFile(_NUMBA.IndexDataCacheFile):  # type: ignore[misc]
    """Kept kernels, each with its digest at the end, which unpickling does not look at."""

    def _dump(self, obj: Any) -> bytes:
        content: bytes = super()._dump(obj)
        return content + hashlib.sha256(content).digest()

    def _load_data(self, name: str) -> Any:
        content = Path(self._data_path(name)).read_bytes()
        if hashlib.sha256(content[:-_SEAL]).digest() != content[-_SEAL:]:
            raise ValueError(f"{name} is spoilt")
        return super()._load_data(name)


class _KernelCache(_NUMBA.FunctionCache):  # type: ignore[misc]
    """numba's cache of a function, without which everything works as well, only slower."""

    def __init__(self, function: Callable[..., Any]) -> None:
        super().__init__(function)
        stamp = self._impl.locator.get_source_stamp()
        self._cache_file = _SealedFile(self._cache_path, self._impl.filename_base, stamp)

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """The compiled function, or None; a spoilt file is emptied."""
        try:
            return super().load_overload(sig, target_context)
        except Exception:  # unpickling what is spoilt may end in anything
            with suppress(OSError):
                self.flush()
            return None

    def save_overload(self, sig: Any, data: Any) -> None:
        """Keep a compiled function, if the disk lets us."""
        with suppress(Exception):
            super().save_overload(sig, data)


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


class _Halt(event.Listener):
    """Compilation costs no clock any time; the compiler's lock keeps threads apart."""

    def on_start(self, event: Any) -> None:
        WORKING_TIME.halt()

    def on_end(self, event: Any) -> None:
        WORKING_TIME.resume()


event.register("numba:compile", _Halt())  # type: ignore[no-untyped-call]
