from typing import Any

import numba

from fiveroute.kernels import kernel, on_compilation


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


def test_kernels_are_kept_in_a_folder_of_their_source() -> None:
    """What numba would otherwise miss: a change in a kernel that another one calls."""
    dispatcher: Any = _twice
    _twice(2.0)
    assert "kernels-" in str(dispatcher.stats.cache_path)


def test_numba_keeps_its_own_choice_for_others() -> None:
    config: Any = numba.config
    assert "kernels-" not in str(config.CACHE_DIR)
