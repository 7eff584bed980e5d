"""The instances that come with fiveroute, each from its recipe.

``small/`` can be solved to proven optimality in a minute each, ``paper/`` holds the twenty
scenarios of the paper's experiments, ``large/`` shows what heuristics are for. The files
in ``instances/`` are these instances, byte for byte.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from fiveroute.formats import write_instance
from fiveroute.generate import paper_scenario, scenario
from fiveroute.instance import Instance, Service

__all__ = ["in_uniform_current", "shipped_instances", "with_unequal_endurance", "write_shipped"]

PAPER_SEEDS = range(1, 21)


def shipped_instances() -> dict[str, Instance]:
    """All instances by their paths below ``instances/``."""
    folders = {"small": _small(), "paper": _paper(), "large": _large()}
    return {
        f"{folder}/{instance.name}.json": instance
        for folder, instances in folders.items()
        for instance in instances
    }


def write_shipped(folder: Path) -> None:
    """Write all instances anew; `folder` is that of the project, ``instances/``."""
    for name, instance in shipped_instances().items():
        write_instance(instance, folder / name, force=True)


def with_unequal_endurance(instance: Instance) -> Instance:
    """The same for a fleet of different AUVs: the first lasts 20 % longer, the last shorter."""
    size, endurance = instance.fleet_size, instance.fleet.endurance
    assert size is not None
    assert isinstance(endurance, float)
    shares = np.linspace(1.2, 0.8, size)
    each = tuple(60.0 * round(endurance * share / 60.0) for share in shares.tolist())
    return replace(instance, fleet=replace(instance.fleet, endurance=each))


def in_uniform_current(instance: Instance, u: float, v: float) -> Instance:
    """The same with explicit, asymmetric leg times in a uniform current.

    On a straight leg in direction e the AUV heads off against the current c, so that its
    speed over ground is c.e + sqrt(s^2 - (c x e)^2) with s its speed through the water.

    Parameters
    ----------
    instance
        The instance, without an ocean of its own.
    u, v
        Current in metres per second, east and north, slower than the AUVs.
    """
    points = instance.points
    legs = points[None, :, :] - points[:, None, :]
    length = np.hypot(legs[..., 0], legs[..., 1])
    east, north = np.moveaxis(legs / np.where(length > 0.0, length, 1.0)[..., None], -1, 0)
    along, across = u * east + v * north, u * north - v * east
    times = np.round(length / (along + np.sqrt(instance.fleet.speed**2 - across**2)), 3)
    rows = tuple(map(tuple, times.tolist()))
    return replace(instance, metric="explicit", travel_times=rows)


def _small() -> Iterator[Instance]:
    instant = Service()
    yield _named("small-06-m1-uniform", scenario("uniform", 6, 1, 1))
    yield _named("small-06-m2-closed", scenario("uniform", 6, 2, 2, closed=True))
    yield _named("small-07-m2-ring", scenario("ring", 7, 3, 2))
    yield _named("small-08-m2-clustered", scenario("clustered", 8, 38, 2, share=0.6))
    asymmetric = scenario("uniform", 8, 5, 2)
    yield _named("small-08-m2-asymmetric", in_uniform_current(asymmetric, 0.3, 0.1))
    yield _named("small-08-m3-budgets", with_unequal_endurance(scenario("uniform", 8, 6, 3)))
    yield _named("small-09-m2-instant", scenario("uniform", 9, 7, 2, service=instant, share=0.7))
    yield _named("small-10-m1-uniform", scenario("uniform", 10, 8, 1))
    yield _named("small-10-m3-ring", scenario("ring", 10, 9, 3))
    yield _named("small-12-m2-closed", scenario("uniform", 12, 10, 2, closed=True, share=0.7))
    asymmetric = scenario("clustered", 12, 29, 3)
    yield _named("small-12-m3-asymmetric", in_uniform_current(asymmetric, -0.2, 0.4))
    yield _named("small-14-m3-clustered", scenario("clustered", 14, 12, 3))
    yield _named("small-15-m3-instant", scenario("uniform", 15, 13, 3, service=instant))
    yield _named("small-15-m4-budgets", with_unequal_endurance(scenario("ring", 15, 14, 4)))
    yield _named("small-16-m3-clustered", scenario("clustered", 16, 35, 3, share=0.6))
    yield _named("small-20-m3-uniform", scenario("uniform", 20, 23, 3, share=0.55))
    yield _named("small-20-m4-ring", scenario("ring", 20, 26, 4, share=0.7))


def _paper() -> Iterator[Instance]:
    for seed in PAPER_SEEDS:
        yield paper_scenario(seed)


def _large() -> Iterator[Instance]:
    yield _named("large-0200-m4-uniform", scenario("uniform", 200, 1, 4))
    yield _named("large-1000-m8-clustered", scenario("clustered", 1000, 2, 8))
    yield _named("large-5000-m20-uniform", scenario("uniform", 5000, 3, 20))


def _named(name: str, instance: Instance) -> Instance:
    return replace(instance, name=name)
