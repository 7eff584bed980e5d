from fiveroute.kernels import kernel, on_compilation


@kernel
def _twice(x: float) -> float:
    return 2.0 * x


def test_a_kernel_computes_what_its_source_says() -> None:
    assert _twice(1.5) == 3.0


def test_compilation_is_announced_once() -> None:
    told = []
    on_compilation(lambda: told.append(True))

    def fresh(x: float) -> float:
        return x + 1.0

    for _ in range(2):
        import numba

        numba.njit(fresh)(1.0)
    assert told == [True]
