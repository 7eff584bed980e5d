"""Tier 3: the time-optimal path between two points by differential evolution.

The path solves (23) under (21): the fastest spline from start to goal that keeps clear of all
barriers, turns no tighter than the AUV can, and nowhere asks for more than the AUV can make good
against the current.

1. Evolution looks for the right way around, with few control points. It begins with the straight
   line, arcs to both sides, detours on either side of every barrier that the line meets,
   and tracks that the caller guesses.
2. A quasi-Newton descent takes the best path to the optimum; then every span is halved, which
   leaves the curve as it is, and the descent goes on with twice the freedom.
3. The path becomes a dense track; what is told of it, its duration and clearance, is taken
   anew along that track.

Where no path keeps the rules there is none to hand back, and the status says what stood in its way.
Evolution proves nothing, though: a way through a maze, or past a wall thinner than the guards'
spacing, may need a guess.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fiveroute.errors import InputError
from fiveroute.limits import Clock, Limits
from fiveroute.ocean.barriers import clearance
from fiveroute.paths.differential_evolution import (
    Population,
    Variant,
    control_of,
    evolved_population,
)
from fiveroute.paths.first_paths import first_controls, joined
from fiveroute.paths.path import Path, track_path
from fiveroute.paths.path_cost import PathProblem, path_cost, path_problem
from fiveroute.paths.polish import merit, polish
from fiveroute.paths.spline import (
    fit_control,
    halving,
    regular_table,
    spline_curvature,
    spline_points,
)
from fiveroute.paths.waters import Waters

__all__ = ["THOROUGH", "DifferentialEvolution", "evolve_path"]

Floats = NDArray[np.float64]

_GUARDS = 128  # points a span where clearance is taken in the descent
_WAYPOINTS = 512  # points of a path that are handed back
_WEIGHT = 0.02  # of the violation in the merit of a path
_SAFER = 2.0, 5.0  # factors of buffer and weight, again until the track keeps the rules,
_HEAVIEST = 10.0  # or the weight is this,
_HOPELESS = 0.1  # or the violation has such a share in the merit
_PROMISING = 1.02  # times the best duration that a path may take to be descended from
_ROUNDING = 1e-12  # share of a duration that does not tell two paths apart
_APART = 0.08  # distance of two paths that count as different ways, as a share of the line
_OUTLINE = 3  # points a span where that distance is taken


@dataclass(frozen=True, slots=True)
class DifferentialEvolution:
    """How hard to look for a path.

    Parameters
    ----------
    variant
        The scheme of evolution.
    population
        Paths that it begins with.
    evaluations
        Paths that it looks at; 0 takes the best of the first ones.
    spans
        Spans of the spline that evolves, with one more free control point than that; None
        takes them by the line's length in cells of the current's grid.
    halvings
        How often the spans are halved for the descent.
    first_steps
        Most steps down that the first paths take before they evolve.
    steps
        Most steps of the descent between two halvings.
    descents
        Most paths that are descended from.
    """

    variant: Variant = "l-shade"
    population: int = 20
    evaluations: int = 400
    spans: int | None = None
    halvings: int = 2
    first_steps: int = 4
    steps: int = 30
    descents: int = 2

    def __post_init__(self) -> None:
        if self.variant not in get_args(Variant):
            rule = f"the variant is one of {', '.join(get_args(Variant))}"
            raise InputError(rule, field="variant", value=self.variant)
        least = {"population": 4, "evaluations": 0, "halvings": 0, "descents": 1}
        for name, bound in least.items():
            if getattr(self, name) < bound:
                rule = f"this must be at least {bound}"
                raise InputError(rule, field=name, value=getattr(self, name))
        if self.spans is not None and self.spans < 1:
            raise InputError("a spline has at least one span", field="spans", value=self.spans)


THOROUGH = DifferentialEvolution(
    population=60, evaluations=4000, first_steps=20, halvings=3, descents=6
)
"""For a single path: a second or less."""


def evolve_path(
    waters: Waters,
    start: ArrayLike,
    goal: ArrayLike,
    *,
    begin: float = 0.0,
    guesses: Sequence[Floats] = (),
    options: DifferentialEvolution | None = None,
    rng: np.random.Generator | int = 0,
    clock: Clock | None = None,
) -> Path:
    """Find the fastest path between two points.

    Parameters
    ----------
    waters
        Ocean and vehicle.
    start, goal
        Positions in metres, shape (2,).
    begin
        Time of departure in seconds.
    guesses
        Tracks from start to goal to begin with besides others, each of shape (k, 2).
    options
        How hard to look.
    rng
        Source of randomness, or its seed: the same seed gives the same path.
    clock
        When to stop with the best path so far.

    Raises
    ------
    InputError
        If start or goal lies in a barrier.
    """
    options, clock = options or DifferentialEvolution(), clock or Limits().start()
    ends = _end(waters, start, "start"), _end(waters, goal, "goal")
    straight = track_path(waters, np.stack(ends), begin)
    if np.array_equal(*ends):
        return straight
    tracks = [joined(np.asarray(guess, dtype=np.float64), *ends) for guess in guesses]
    problem = path_problem(waters, *ends, begin=begin, spans=options.spans)
    first = first_controls(problem, tracks, _WEIGHT, options.first_steps)
    population = evolved_population(
        problem,
        first,
        variant=options.variant,
        size=options.population,
        evaluations=options.evaluations,
        rng=np.random.default_rng(rng),
        clock=clock,
    )
    found = _descents(waters, problem, _ranked(problem, population, first), options, clock)
    for track in tracks:
        control = fit_control(track, 2**options.halvings * (len(problem.straight) - 3))
        found.append(_descended(waters, problem, control, options, clock))
        found.append(track_path(waters, track, begin))
    best = min(found, key=lambda path: path.duration)
    return straight if straight.duration <= (1.0 + _ROUNDING) * best.duration < math.inf else best


def _ranked(problem: PathProblem, population: Population, first: Sequence[Floats]) -> list[Floats]:
    """The path that evolved, then the first ones in the order of their merit."""
    best = control_of(problem, population.genes[population.best])
    return [best, *sorted(first, key=lambda control: merit(problem, control, _WEIGHT))]


def _descents(
    waters: Waters,
    problem: PathProblem,
    ranked: Sequence[Floats],
    options: DifferentialEvolution,
    clock: Clock,
) -> list[Path]:
    """Descend from the best paths that go different ways, from all while none keeps the rules."""
    paths: list[Path] = []
    seen: list[Floats] = []
    fastest = math.inf
    apart = _APART * float(np.hypot(*(problem.straight[-1] - problem.straight[0])))
    for control in ranked:
        if len(seen) >= options.descents:
            break
        if merit(problem, control, _WEIGHT) > _PROMISING * fastest:
            break
        outline = _outline(control)
        if any(np.hypot(*(outline - other).T).max() < apart for other in seen):
            continue
        path = _descended(waters, problem, control, options, clock)
        paths.append(path)
        if path.is_found:
            seen.append(outline)
            fastest = min(fastest, path.duration)
    return paths


def _outline(control: Floats) -> Floats:
    """A few points along a path."""
    return spline_points(regular_table(len(control) - 3, _OUTLINE), control)


def _descended(
    waters: Waters,
    problem: PathProblem,
    control: Floats,
    options: DifferentialEvolution,
    clock: Clock,
) -> Path:
    """Steps 2 and 3: the optimum near a path, on ever more spans, as a dense track."""
    control, found = control.copy(), _dense(waters, problem, control)
    finest = 2**options.halvings * (len(problem.straight) - 3)
    while True:
        problem = _finer(waters, problem, len(control) - 3)
        if not clock.expired:
            polish(problem, control, _WEIGHT, options.steps)
        if len(control) - 3 >= finest:
            break
        control = halving(len(control) - 3) @ control
    path, weight = _dense(waters, problem, control), _WEIGHT
    while not path.is_found and weight < _HEAVIEST and not clock.expired:
        time, violation = path_cost(problem, control)
        if _WEIGHT * violation > _HOPELESS * time:
            break
        problem = problem._replace(buffer=_SAFER[0] * problem.buffer)
        weight *= _SAFER[1]
        polish(problem, control, weight, options.steps)
        path = _dense(waters, problem, control)
    return min([path, found], key=lambda path: path.duration)


def _finer(waters: Waters, problem: PathProblem, spans: int) -> PathProblem:
    """The same problem on so many spans, with denser guards."""
    start, goal = problem.straight[0], problem.straight[-1]
    finer = path_problem(waters, start, goal, begin=problem.begin, spans=spans)
    return finer._replace(guards=regular_table(spans, _GUARDS))


def _dense(waters: Waters, problem: PathProblem, control: Floats) -> Path:
    """The dense track of a spline, and what is true of it."""
    spans = len(control) - 3
    track = spline_points(regular_table(spans, max(_WAYPOINTS // spans, 1)), control)
    track[0], track[-1] = control[0], control[-1]
    curvature = float(np.abs(spline_curvature(problem.guards, control)).max())
    return track_path(waters, track, problem.begin, curvature)


def _end(waters: Waters, position: ArrayLike, name: str) -> Floats:
    """An end of the path, if it is a place in open water."""
    place = np.array(position, dtype=np.float64)
    if place.shape != (2,) or not np.isfinite(place).all():
        raise InputError("an end of a path is two finite numbers", field=name, value=position)
    spare = clearance(waters.barriers, place[0], place[1])
    if not spare > 0.0:
        rule = f"it lies {-spare:.1f} m inside a barrier or its margin; move it into open water"
        raise InputError(rule, field=name, value=place.tolist())
    return place
