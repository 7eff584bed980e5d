"""Gap of the giant route to known optimal tours: a row a TSPLIB file, then the mean.

    python benchmarks/giant_route.py FOLDER OPTIMA [--names a,b] [--time-limit S] [--seed N]

OPTIMA has a line ``name : length`` for every file. Time is processor time, so that a busy
machine does not change the figures; the limit is wall-clock time.
"""

import argparse
import re
import statistics
import time
from pathlib import Path

from fiveroute.formats import read_instance
from fiveroute.limits import Limits
from fiveroute.tiers.preplanning import find_giant_route

NAMES = "eil51,berlin52,st70,kroA100,lin105,ch150,a280,pcb442,rat783,pr1002"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("optima", type=Path)
    parser.add_argument("--names", default=NAMES)
    parser.add_argument("--time-limit", type=float, default=10.0)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    lines = re.findall(r"^(\S+)\s*:\s*(\d+)", options.optima.read_text(), re.MULTILINE)
    optima = {name: float(length) for name, length in lines}
    gaps = []
    for name in options.names.split(","):
        problem = read_instance(options.folder / f"{name}.tsp").problem()
        started = time.process_time()
        result = find_giant_route(problem, Limits(options.time_limit), seed=options.seed)
        seconds = time.process_time() - started
        gaps.append(result.duration / optima[name] - 1.0)
        bound = 0.0 if result.bound is None else 1.0 - result.bound / optima[name]
        print(
            f"{name:12s} {result.duration:10.0f}  gap {gaps[-1]:8.4%}"
            f"  bound {bound:7.3%} below  {seconds:6.1f} s"
        )
    print(f"mean gap {statistics.fmean(gaps):.4%}, worst {max(gaps):.4%}")


if __name__ == "__main__":
    main()
