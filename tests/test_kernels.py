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
