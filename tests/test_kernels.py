import time
from pathlib import Path
from typing import Any

import numba
import pytest

from fiveroute import kernels
from fiveroute.kernels import kernel, on_compilation
from fiveroute.limits import Limits


@kernel
def _twice(x: float) -> float:
    return 2.0 * x


def _never_kept_on_disk(x: float) -> float:
    return x + 1.0


def test_a_kernel_computes_what_its_source_says() -> None:
    assert _twice(1.5) == 3.0


def test_compilation_is_announced_once() -> None:
    told = []
    on_compilation(lambda: told.append(True))
    for _ in range(2):
        compiled: Any = numba.njit(_never_kept_on_disk)
        assert compiled(1.0) == 2.0
    assert told == [True]


def test_clocks_stand_still_while_a_kernel_is_compiled() -> None:
    compiled: Any = numba.njit(_never_kept_on_disk)
    clock, begun = Limits().start(), time.perf_counter()
    compiled(1.0)
    elapsed = time.perf_counter() - begun
    assert 0.0 < clock.seconds < elapsed


def test_kernels_are_kept_in_a_folder_of_their_source() -> None:
    """What numba would otherwise miss: a change in a kernel that another one calls."""
    dispatcher: Any = _twice
    _twice(2.0)
    assert "kernels-" in str(dispatcher.stats.cache_path)


def test_the_source_of_a_kernel_is_all_that_its_module_imports() -> None:
    used = kernels._imported({"fiveroute.heuristics.variation"})
    assert {"fiveroute.heuristics.route_kernels", "fiveroute.randomness"} <= used
    assert "fiveroute.models.tree_kernels" not in used
    assert all(kernels._source(module) for module in used)


def test_kernels_of_a_former_source_are_cleared_away(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    package = tmp_path / "fiveroute"
    (package / "ocean").mkdir(parents=True)
    module, constant = package / "ocean" / "a.py", package / "b.py"
    module.write_text("from fiveroute.b import C\n")
    monkeypatch.setattr(kernels, "_PACKAGE", package)
    folders = []
    for text in ("C = 1", "C = 2", "C = 2"):
        constant.write_text(text)
        for cached in (kernels._cache_folder, kernels._imports, kernels._source):
            cached.cache_clear()
        folders.append(Path(kernels._cache_folder("fiveroute.ocean.a")))
    assert folders[0] != folders[1] == folders[2]
    assert [folder.exists() for folder in folders] == [False, True, True]
    for cached in (kernels._cache_folder, kernels._imports, kernels._source):
        cached.cache_clear()


def test_numba_keeps_its_own_choice_for_others() -> None:
    config: Any = numba.config
    assert "kernels-" not in str(config.CACHE_DIR)
