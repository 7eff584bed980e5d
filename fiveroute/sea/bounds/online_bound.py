"""What no online policy can do better: a bound by taxed luck and prices of nodes.

A policy decides at nodes. It may know all that the whole fleet has met so far, but not the luck of
legs that nobody has sailed. Let it visit no node twice, never wait, and head for home where it is
late. What leg (i, j) takes, left at time t, is then independent of all that is known at t, so that
for any functions W the sum over the legs sailed of

    D = W_j(t + f_ij) - E W_j(t + f_ij)

has mean zero. With a price c of a late return no policy can expect more than

    E[data - c late] <= E[max over all plans of data - c late - sum of D],

where the maximum knows the luck of the run, and D taxes what it gains by that (L. Rogers 2002, doi
10.1111/1467-9965.02010; D. Brown, J. Smith, P. Sun 2010, doi 10.1287/opre.1090.0796). If a
share a of M AUVs may be late, E[data] <= c a M + this mean.

W is V of `fiveroute.sea.bounds.online_value`: what an AUV can expect that pays pi_i for a visit to
node i, so that g_i = rho_i - pi_i. For the leg home it is -c where that ends late, and who knows
his luck pays for the risk like everybody. As no node is visited twice, any prices pi >= 0 give

    E[data - c late] <= sum_i pi_i + M V_0

without any luck (weakly coupled dynamic programmes: D. Adelman, A. Mersereau 2008, doi
10.1287/opre.1070.0445). The prices are those for which this is about least. The maximum of a run is
bounded in the same way, with prices of its own: sum_i pi_i + M times the most that one AUV gets on
an ng-route. With the prices of V that is the bound above again; others only lower it.

All roundings are on the safe side. Only the mean over the runs is estimated.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from fiveroute.errors import InputError
from fiveroute.limits import Limits
from fiveroute.models.highs import Outcome, Program
from fiveroute.routes import Route
from fiveroute.sea.bounds.online_value import (
    Chart,
    chart,
    expectations,
    look_ahead,
    look_behind,
    usage,
)
from fiveroute.sea.luck import Luck
from fiveroute.sea.world import World
from fiveroute.tiers.actuation import overruns

__all__ = ["OnlineBound", "Pilot", "node_prices", "online_bound"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

Look = Callable[[Floats], tuple[float, Floats, Floats]]
"""Most that an AUV is worth at some prices; worths without prices, and visits, of some routes."""

_STEPS, _MEMORY = 200, 3  # for the search for prices
_ROUNDS = 80
_CLOSE = 5e-4  # share of all data within which prices are sought
_FIRST_PRICE = 0.7  # of a node, as a share of its data
_FIRST_BOX, _WIDER, _NARROWER = 0.25, 1.2, 0.6  # of the prices, as shares of a mean node's data
_MARGIN = 1.0  # of legs that are taxed to the full, in data of a mean node


@dataclass(frozen=True, slots=True)
class OnlineBound:
    """A bound on what any policy can expect.

    Parameters
    ----------
    price
        c, as a share of all data.
    fleet_size
        Number M of AUVs.
    expected
        Bound on the mean of completion - c late, without any luck.
    runs
        The same with the luck of each run: their mean is an unbiased estimate of a bound.
    """

    price: float
    fleet_size: int
    expected: float
    runs: tuple[float, ...]

    def completion(self, late: float) -> float:
        """Bound on the mean completion rate if no more than a share of AUVs is late."""
        return float(np.mean(self.runs)) + self.price * late * self.fleet_size


def online_bound(
    world: World,
    *,
    price: float = 0.3,
    runs: int = 5,
    first_run: int = 0,
    seed: int = 0,
    steps: int = 1200,
    memory: int = 5,
) -> OnlineBound:
    """Bound what any policy collects.

    Parameters
    ----------
    world
        A mission with equal budgets whose legs follow a law.
    price
        c, as a share of all data. Any is valid; which is best depends on how many may be late.
    runs, first_run, seed
        The luck, as in `fiveroute.sea.simulation.simulate_fleet`.
    steps
        Steps of time: with more, the bound is lower, and takes longer in proportion to the square.
    memory
        Nodes near to each that a route remembers: likewise, twice the time and room with each. The
        tax takes 8 (n + 2)^2 steps 2^memory bytes.

    Raises
    ------
    InputError
        If budgets differ, a vehicle sails the legs, or a leg may take less than a step.
    """
    _check(world, steps)
    fine = price * world.problem.total_profit
    pilot = Pilot(world, chart(world, steps, memory), fine, node_prices(world, fine))
    lucks = (Luck(world.law, seed, run) for run in range(first_run, first_run + runs))
    return OnlineBound(
        price,
        world.problem.fleet_size,
        world.completion(pilot.expected),
        tuple(world.completion(pilot.most(luck)) for luck in lucks),
    )


def node_prices(world: World, fine: float) -> Floats:
    """Prices of all vertices for which sum_i pi_i + M V_0 is about least."""
    profit = world.problem.profit
    sea = chart(world, _STEPS, _MEMORY, to_nearest=True)
    value, choice = sea.new_values()

    def look(prices: Floats) -> tuple[float, Floats, Floats]:
        look_ahead(sea, profit - prices, fine, value, choice)
        visits, late = usage(sea, choice)
        return value[0, -1, 0], np.array([visits @ profit - fine * late]), visits[None]

    return _least(look, _FIRST_PRICE * profit, world)[1]


class Pilot:
    """An AUV that pays for nodes, for being late, and for what it knows of its luck.

    Parameters
    ----------
    world
        The mission.
    sea
        Its chart.
    fine
        c, in data.
    prices
        pi of every vertex, shape (n + 2,).
    """

    def __init__(self, world: World, sea: Chart, fine: float, prices: Floats) -> None:
        self.world, self.sea, self.fine, self.prices = world, sea, fine, prices
        problem = world.problem
        self.value, _ = sea.new_values()
        self.best, self.choice = sea.new_values()
        gain = problem.profit - prices
        look_ahead(sea, gain, fine, self.value, self.choice)
        margin = _MARGIN * float(problem.profit.mean())
        self.tax = expectations(sea, gain, fine, self.value, margin)

    @property
    def expected(self) -> float:
        """Bound on the mean of data - c late, without any luck."""
        return float(self.prices.sum() + self.world.problem.fleet_size * self.value[0, -1, 0])

    def most(self, luck: Luck) -> float:
        """Bound on the taxed data of all plans in a run."""
        return _least(partial(self._look, self.legs(luck)), self.prices, self.world)[0]

    def legs(self, luck: Luck) -> Ints:
        """Steps that every leg takes, rounded down."""
        problem = self.world.problem
        step = float(problem.allowed[0]) / (self.sea.late.shape[1] - 1)
        legs: Ints = np.maximum((luck.matrix() + problem.service) / step, 1.0).astype(np.int64)
        return legs

    def _look(self, legs: Ints, prices: Floats) -> tuple[float, Floats, Floats]:
        problem = self.world.problem
        look_behind(
            self.sea, legs, problem.profit - prices, self.fine, self.value, self.tax,
            self.best, self.choice,
        )  # fmt: skip
        firsts = {int(self.choice[0, -1, 0]), *range(1, problem.n + 1)}
        routes = [self._route(legs, first) for first in sorted(firsts)]
        visits = np.zeros((len(routes), problem.n + 2))
        for row, route in zip(visits, routes, strict=True):
            np.add.at(row, list(route), 1.0)
        worths = np.array([self.taxed(legs, route) for route in routes])
        return float(self.best[0, -1, 0]), worths, visits

    def _route(self, legs: Ints, first: int) -> Route:
        """The best ng-route by way of a first vertex; it ends where time does."""
        i, k, s, j = 0, self.sea.late.shape[1] - 1, 0, first
        route = []
        while j != self.world.problem.destination:
            route.append(j)
            k, s, i = k - int(legs[i, j]), int(self.sea.carry[i, j, s]), j
            if k < 0:
                break
            j = int(self.choice[i, k, s])
        return tuple(route)

    def taxed(self, legs: Ints, route: Route) -> float:
        """Data of a route less its fine and its tax, at the steps that its legs take."""
        i, k, s, worth = 0, self.sea.late.shape[1] - 1, 0, 0.0
        for j in route:
            then, s = k - legs[i, j], self.sea.carry[i, j, s]
            worth += float(self.world.problem.profit[j] + self.tax[i, j, k, s])
            if then < 0:
                return worth  # V is -c there: the fine is paid back as tax
            worth -= float(self.value[j, then, s])
            i, k = j, then
        return worth - self.fine * float(self.sea.late[i, k])


def _least(look: Look, prices: Floats, world: World) -> tuple[float, Floats]:
    """Lower sum_i pi_i + M best(pi), any value of which is a bound; return it and the prices.

    best is the maximum over all routes of worth less prices of visits; the known routes model it,
    and prices move within a box about the best so far.
    """
    problem = world.problem
    width = _FIRST_BOX * float(problem.profit.mean())
    program = Program(Limits().start())
    program.add_columns(np.ones(len(prices)), 0.0, np.inf)
    program.add_columns([problem.fleet_size], -np.inf, np.inf)
    bound, centre = np.inf, prices
    for _ in range(_ROUNDS):
        best, worths, visits = look(prices)
        value = float(prices.sum() + problem.fleet_size * best)
        width *= _WIDER if value < bound else _NARROWER
        if value < bound:
            bound, centre = value, prices
        rows = csr_array(np.column_stack([visits, np.ones(len(visits))]))
        program.add_rows(rows, worths, np.inf)
        for i in range(1, problem.n + 1):
            low = max(centre[i] - width, 0.0)
            program.highs.changeColBounds(i, low, centre[i] + width)
        if program.solve() is not Outcome.OPTIMAL:
            break
        if bound - program.objective < _CLOSE * problem.total_profit:
            break
        prices = np.maximum(program.values[:-1], 0.0)
    return bound, centre


def _check(world: World, steps: int) -> None:
    problem = world.problem
    if world.model is not None:
        raise InputError("is known only for legs that follow (12)", field="model")
    if not problem.has_equal_budgets:
        raise InputError("must be equal", field="budgets", value=problem.budgets.tolist())
    step = float(problem.allowed[0]) / steps
    for j in range(1, problem.n + 1):
        longer = overruns(world.law, j, np.array([step - problem.service[j]]))[:-1, 0]
        if np.delete(longer, j).min() < 1.0 - 1e-12:
            raise InputError(
                "a leg may take less than a step; take more", field="steps", value=steps
            )
