"""Work shared out: the same tasks in this process, on all cores, or on a cluster.

Answers come as they are done, in any order. On one machine joblib shares the tasks out, on a
cluster Dask: a worker that dies takes nothing with it but time.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Generator, Sequence
from typing import Any, TypeVar

from fiveroute.errors import InputError

__all__ = ["require_scheduler", "share_out"]

T = TypeVar("T")

_PATIENCE = 10.0
"""Seconds that a scheduler may take to answer."""


def share_out(
    work: Callable[..., T],
    tasks: Sequence[tuple[Any, ...]],
    *,
    workers: int = 1,
    scheduler: str | None = None,
) -> Generator[T]:
    """Answers of ``work(*task)``, as they are done.

    Parameters
    ----------
    work
        What is to be done; it travels to the workers, with all that it holds.
    tasks
        Its arguments, task by task.
    workers
        Processes on this machine; 1 works in this one, in order.
    scheduler
        Address of a Dask scheduler, as ``tcp://host:8786``; None stays on this machine.

    Raises
    ------
    InputError
        If Dask is not installed, or no scheduler answers.
    """
    if scheduler is not None:
        return _on_cluster(work, tasks, scheduler)
    return _on_machine(work, tasks, workers)


def require_scheduler(address: str | None) -> None:
    """Refuse an address where no Dask scheduler answers, before any time is spent.

    A line is opened without a client, since one that finds nobody complains when it goes, and
    waits for ever for somebody else who says nothing.
    """
    if address is None:
        return
    import asyncio
    from concurrent.futures import ThreadPoolExecutor

    try:
        from distributed.comm.core import connect
    except ImportError:
        raise InputError(
            "needs Dask; install fiveroute[cluster]", field="scheduler", value=address
        ) from None

    async def call() -> None:
        line = await asyncio.wait_for(connect(address, timeout=_PATIENCE), _PATIENCE)
        line.abort()

    try:
        with ThreadPoolExecutor(1) as thread:  # this one may have a loop that runs, as in notebooks
            thread.submit(asyncio.run, call()).result()
    except (OSError, TypeError, ValueError) as error:  # as its transports come upon them
        why = str(error) or f"not in {_PATIENCE:g} s"
        raise InputError(
            f"no Dask scheduler answers there ({why}); start one, or correct the address",
            field="scheduler",
            value=address,
        ) from None


def _on_machine(
    work: Callable[..., T], tasks: Sequence[tuple[Any, ...]], workers: int
) -> Generator[T]:
    if workers == 1:
        yield from (work(*task) for task in tasks)
        return
    from joblib import Parallel, delayed

    pool = Parallel(n_jobs=workers, return_as="generator_unordered", batch_size=1)
    answers = pool(delayed(work)(*task) for task in tasks)
    try:
        for answer in answers:  # noqa: UP028 - `yield from` would close the pool with a warning
            yield answer
    finally:
        with warnings.catch_warnings():  # of tasks that are given up: that is meant
            warnings.simplefilter("ignore", UserWarning)
            answers.close()


def _on_cluster(
    work: Callable[..., T], tasks: Sequence[tuple[Any, ...]], address: str
) -> Generator[T]:
    require_scheduler(address)
    from distributed import Client, as_completed

    with Client(address, timeout=_PATIENCE, set_as_default=False) as client:
        futures = [client.submit(work, *task, pure=False) for task in tasks]
        for future in as_completed(futures, loop=client.loop):
            yield future.result()
