"""All leg times of a paper scenario in strong vortices among obstacles, and their gaps.

    python benchmarks/leg_times.py instances/paper/scenario-01.json [--sample 200]

Twenty vortices of radius 500 m and circulation N(0, 1000^2) m2/s, ten round obstacles. The time
covers all directed legs between start, nodes and destination on all cores. The gap of a leg is
(duration - reference) / reference; the reference is the straightened path of a search over a
lattice of 120 cells with a stencil of 96 moves.
"""

from __future__ import annotations

import argparse
import os
import time
from dataclasses import replace
from pathlib import Path

import numpy as np

from fiveroute.formats import read_instance
from fiveroute.instance import Circle, Currents, Instance, Ocean, Vortex
from fiveroute.ocean.stated import stated_current
from fiveroute.paths.reference_path import grid_path
from fiveroute.paths.stated_waters import waters_of
from fiveroute.tiers.pathing import plan_legs


def in_strong_vortices(instance: Instance, rng: np.random.Generator) -> Instance:
    """The instance with twenty vortices and ten obstacles that no stop lies in."""
    vortices = tuple(
        Vortex(*rng.uniform(0.0, 1e4, 2).tolist(), float(rng.normal(0.0, 1000.0)), 500.0)
        for _ in range(20)
    )
    obstacles: list[Circle] = []
    while len(obstacles) < 10:
        x, y, radius = rng.uniform((500.0, 500.0, 150.0), (9500.0, 9500.0, 500.0)).tolist()
        if np.hypot(*(instance.points - (x, y)).T).min() > radius + 30.0:
            obstacles.append(Circle(x, y, radius))
    return replace(instance, ocean=Ocean(Currents(vortices), tuple(obstacles)))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("instance", type=Path)
    parser.add_argument("--sample", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    rng = np.random.default_rng(asked.seed)
    instance = in_strong_vortices(read_instance(asked.instance), rng)
    current = stated_current(instance)
    waters = waters_of(instance, current)
    plan_legs(waters, current, instance.points, only=[(0, 1)])  # compiles the kernels
    begun, used = time.perf_counter(), time.process_time()
    table = plan_legs(waters, current, instance.points)
    seconds, used = time.perf_counter() - begun, time.process_time() - used
    print(
        f"{len(table.legs)} legs in {seconds:.1f} s on {os.cpu_count()} cores ({used:.1f} s of "
        f"processor time); fastest water {waters.grid.fastest:.2f} m/s; "
        f"{len(table.tracks) / max(len(table.legs), 1):.0f} waypoints a leg"
    )
    gaps = []
    for tail, head in table.legs[rng.choice(len(table.legs), asked.sample, replace=False)]:
        reference = grid_path(waters, instance.points[tail], instance.points[head])
        gaps.append(table.times[tail, head] / reference.duration - 1.0)
    percent = 100.0 * np.array(gaps)
    print(
        f"gap to the reference of {len(gaps)} legs: mean {percent.mean():.4f} %, "
        f"median {np.median(percent):.4f} %, worst {percent.max():.4f} %"
    )


if __name__ == "__main__":
    main()
