"""``fiveroute decide``: what is decided before departure, a table and a picture each."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click
from click.core import ParameterSource

from fiveroute.cli import options

if TYPE_CHECKING:
    from fiveroute.decide.sweep import Sweep
    from fiveroute.instance import Instance
    from fiveroute.limits import Limits, ProgressCallback
    from fiveroute.paths.voyage import Voyage

__all__ = ["command"]

Command = TypeVar("Command", bound=Callable[..., Any])


class _Numbers(click.ParamType[tuple[float, ...]]):
    """Numbers as ``1,2,3`` or ``FROM:TO:STEP``, both ends included."""

    name = "numbers"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[float, ...]:
        if isinstance(value, tuple):
            return value
        try:
            numbers = self._numbers(str(value))
        except ValueError:
            numbers = ()
        if not numbers or not all(map(math.isfinite, numbers)):
            self.fail(f"{value!r} is no list of numbers such as 1,2,3 or 0:24:6", param, ctx)
        return numbers

    @staticmethod
    def _numbers(text: str) -> tuple[float, ...]:
        if ":" not in text:
            return tuple(float(part) for part in text.split(","))
        first, last, step = (float(part) for part in text.split(":"))
        if not (step > 0.0 and last >= first and (last - first) / step <= 1000.0):
            return ()
        count = int((last - first) / step + 1e-9) + 1
        return tuple(float(f"{first + k * step:.12g}") for k in range(count))


_NUMBERS = _Numbers()
_picture = options.picture("the table")
_output = options.output("File for the table: .csv, .md or .parquet.")
_bound = click.option(
    "--bound",
    type=click.Choice(["none", "quick", "exact"]),
    default="quick",
    show_default=True,
    help="Where the upper bounds come from.",
)


def _shared(command: Command) -> Command:
    """Options that every question has."""
    for option in (
        options.json_output,
        options.force,
        _output,
        _picture,
        options.time_limit,
        options.seed,
    ):
        command = option(command)
    return command


@click.group("decide")
def command() -> None:
    """Decide before departure: fleet size, departure, speed, reserve, and against an ensemble."""


@command.command("fleet-size")
@options.instance
@click.option(
    "--sizes",
    type=_NUMBERS,
    default="1:6:1",
    show_default=True,
    metavar="LIST",
    help="Numbers of AUVs.",
)
@_bound
@options.straight_lines
@_shared
@click.pass_context
def fleet_size(
    ctx: click.Context,
    /,
    instance: Path,
    sizes: tuple[float, ...],
    bound: Any,
    straight_lines: bool,
    time_limit: float,
    seed: int,
    **how: Any,
) -> None:
    """How many AUVs: what each number of them collects, and could collect at most."""
    from fiveroute.decide.fleet_sizes import sweep_fleet_sizes
    from fiveroute.errors import InputError
    from fiveroute.formats import read_instance

    if any(size < 1 or size != int(size) for size in sizes):
        raise InputError("must be whole numbers from 1 on", field="--sizes", value=list(sizes))
    mission = read_instance(instance)
    sweep = partial(sweep_fleet_sizes, sizes=[int(size) for size in sizes], bound=bound)
    work = _at_sea(sweep, mission, instance, straight_lines=straight_lines, seed=seed)
    _answer(ctx, work, time_limit, **how)


@command.command("departure")
@options.instance
@click.option(
    "--hours",
    type=_NUMBERS,
    default="0:24:3",
    show_default=True,
    metavar="LIST",
    help="Hours after the departure that the instance states, or else the file's first time.",
)
@options.fleet_size
@_bound
@_shared
@click.pass_context
def departure(
    ctx: click.Context,
    /,
    instance: Path,
    hours: tuple[float, ...],
    fleet_size: int | None,
    bound: Any,
    time_limit: float,
    seed: int,
    **how: Any,
) -> None:
    """When to leave: the mission at different times of its forecast."""
    from fiveroute.decide.departures import sweep_departures
    from fiveroute.formats import read_instance

    mission = read_instance(instance)

    def work(limits: Limits, progress: ProgressCallback | None) -> Sweep:
        return sweep_departures(
            mission,
            hours,
            fleet_size=fleet_size,
            bound=bound,
            limits=limits,
            seed=seed,
            progress=progress,
            folder=instance.parent,
        )

    _answer(ctx, work, time_limit, **how)


@command.command("speed")
@options.instance
@click.option(
    "--speeds",
    type=_NUMBERS,
    default="0.6:2.0:0.2",
    show_default=True,
    metavar="LIST",
    help="Speeds through the water in metres per second.",
)
@click.option(
    "--battery",
    type=options.Real(min=0.0, min_open=True),
    metavar="WH",
    help="Watt-hours of an AUV; without it what the endurance of the instance needs.",
)
@click.option(
    "--hotel",
    type=options.Real(min=0.0, min_open=True),
    default=30.0,
    show_default=True,
    metavar="W",
    help="Power of electronics and sensors.",
)
@click.option(
    "--propulsion",
    type=options.Real(min=0.0, min_open=True),
    default=4.05,
    show_default=True,
    metavar="W",
    help="Power of propulsion at 1 m/s; it grows as the cube of the speed.",
)
@options.fleet_size
@_bound
@options.straight_lines
@_shared
@click.pass_context
def speed(
    ctx: click.Context,
    /,
    instance: Path,
    speeds: tuple[float, ...],
    battery: float | None,
    hotel: float,
    propulsion: float,
    fleet_size: int | None,
    bound: Any,
    straight_lines: bool,
    time_limit: float,
    seed: int,
    **how: Any,
) -> None:
    """How fast: a faster AUV goes farther in an hour, and has fewer hours."""
    from fiveroute.decide.speeds import PowerModel, sweep_speeds
    from fiveroute.formats import read_instance

    mission = read_instance(instance)

    def work(limits: Limits, progress: ProgressCallback | None) -> Sweep:
        return sweep_speeds(
            mission,
            speeds,
            power=PowerModel(hotel, propulsion),
            battery=battery,
            fleet_size=fleet_size,
            bound=bound,
            straight_lines=straight_lines,
            limits=limits,
            seed=seed,
            progress=progress,
            folder=instance.parent,
        )

    _answer(ctx, work, time_limit, **how)


@command.command("reserve")
@options.instance
@click.option(
    "--reserves",
    type=_NUMBERS,
    default="0,0.5,1,1.645,2.5",
    show_default=True,
    metavar="LIST",
    help="Standard deviations of the remaining time kept in hand.",
)
@click.option(
    "--accepted-late",
    type=options.Real(0.0, 1.0),
    default=0.01,
    show_default=True,
    metavar="P",
    help="Share of AUVs that may come home late.",
)
@options.runs
@options.fleet_size
@options.workers
@options.straight_lines
@_shared
@click.pass_context
def reserve(
    ctx: click.Context,
    /,
    instance: Path,
    reserves: tuple[float, ...],
    accepted_late: float,
    runs: int,
    fleet_size: int | None,
    workers: int,
    straight_lines: bool,
    time_limit: float,
    seed: int,
    **how: Any,
) -> None:
    """How cautiously: data collected at sea against AUVs that come home late."""
    from fiveroute.decide.reserves import sweep_reserves
    from fiveroute.errors import InputError
    from fiveroute.formats import read_instance

    if min(reserves) < 0.0:
        raise InputError("must not be negative", field="--reserves", value=min(reserves))
    mission = read_instance(instance)
    sweep = partial(
        sweep_reserves,
        reserves=reserves,
        accepted_late=accepted_late,
        fleet_size=fleet_size,
        runs=runs,
        workers=workers,
    )
    work = _at_sea(sweep, mission, instance, straight_lines=straight_lines, seed=seed)
    _answer(ctx, work, time_limit, **how)


@command.command("ensemble")
@options.instance
@click.argument("members", nargs=-1, type=options.FILE)
@click.option(
    "--draw",
    type=options.Whole(min=2),
    default=30,
    show_default=True,
    metavar="K",
    help="Members to draw from the instance's vortices where no files are given.",
)
@click.option(
    "--held-out",
    type=options.Whole(min=1),
    metavar="H",
    help="Members that are not planned with, the last ones; half of them by default.",
)
@click.option(
    "--alpha",
    type=options.Real(0.0, 1.0, min_open=True),
    default=0.2,
    show_default=True,
    metavar="A",
    help="Share of the worst members that decides (CVaR); 1 is the mean.",
)
@click.option(
    "--displacement",
    type=options.Real(min=0.0),
    default=800.0,
    show_default=True,
    metavar="METRES",
    help="Standard deviation of the centres of drawn vortices.",
)
@click.option(
    "--strength",
    type=options.Real(min=0.0, max=5.0),
    default=0.5,
    show_default=True,
    metavar="S",
    help="Standard deviation of the logarithm of their strength.",
)
@options.fleet_size
@_shared
@click.pass_context
def ensemble(
    ctx: click.Context,
    /,
    instance: Path,
    members: tuple[Path, ...],
    draw: int,
    held_out: int | None,
    alpha: float,
    displacement: float,
    strength: float,
    fleet_size: int | None,
    time_limit: float,
    seed: int,
    **how: Any,
) -> None:
    """Plan against MEMBERS of an ensemble of currents, and test on members held out.

    MEMBERS are CF netCDF files that take the place of the instance's own; without them the members
    are drawn from its vortices.
    """
    _require_drawn(ctx, members)
    import numpy as np

    from fiveroute.decide.ensembles import (
        drawn_members,
        ensemble_sweep,
        filed_members,
        member_times,
        plan_against_ensemble,
    )
    from fiveroute.formats import read_instance
    from fiveroute.ocean.uncertain_ocean import VortexUncertainty

    mission = read_instance(instance)
    folder = instance.parent
    uncertainty = VortexUncertainty(displacement=displacement, strength=strength)
    rng = np.random.default_rng(seed)
    oceans = (
        filed_members(mission, members, folder)
        if members
        else drawn_members(mission, draw, uncertainty, rng, folder)
    )

    def against_members(voyage: Voyage, *, limits: Limits, **search: Any) -> Sweep:
        times = []
        for ocean in oceans:
            if limits.interrupt.is_set():  # before there is any row to give
                raise KeyboardInterrupt
            times.append(member_times(voyage, ocean))
        tested = held_out or max(len(oceans) // 2, 1)
        planned = plan_against_ensemble(
            voyage, times, tested, alpha=alpha, fleet_size=fleet_size, limits=limits, **search
        )
        return ensemble_sweep(voyage, planned)

    work = _at_sea(against_members, mission, instance, straight_lines=False, seed=seed)
    _answer(ctx, work, time_limit, **how)


def _require_drawn(ctx: click.Context, members: tuple[Path, ...]) -> None:
    """Refuse options of drawn members beside members that files hold."""
    for name in ("draw", "displacement", "strength"):
        if members and ctx.get_parameter_source(name) is not ParameterSource.DEFAULT:
            raise click.UsageError(
                f"--{name} is for members drawn from vortices; leave it or the files out"
            )


def _at_sea(
    sweep: Callable[..., Sweep],
    mission: Instance,
    file: Path,
    *,
    straight_lines: bool,
    seed: int,
) -> Callable[[Limits, ProgressCallback | None], Sweep]:
    """Plan the legs of a mission first, and sweep over its voyage in the time that is left."""
    from fiveroute.cli.sailing import sail

    def work(limits: Limits, progress: ProgressCallback | None) -> Sweep:
        clock = limits.start()
        voyage = sail(
            mission, file, limits, straight_lines=straight_lines, seed=seed, progress=progress
        )
        return sweep(voyage, limits=clock.rest(), seed=seed, progress=progress)

    return work


def _answer(
    ctx: click.Context,
    work: Callable[[Limits, ProgressCallback | None], Sweep],
    time_limit: float,
    *,
    output: Path | None,
    picture: Path | None,
    force: bool,
    as_json: bool,
) -> None:
    """Work the table out, write and draw it where that is asked for, and print it."""
    from fiveroute.cli import sweeps
    from fiveroute.cli.answers import print_json
    from fiveroute.cli.files import require_outputs, require_picture
    from fiveroute.cli.running import run
    from fiveroute.formats.tables import require_table, write_rows
    from fiveroute.limits import Limits

    require_outputs(output, picture, force=force)
    require_picture(picture)
    if output is not None:
        require_table(output)
    outcome = run(work, Limits(time_limit))
    sweep = outcome.value
    if output is not None:
        write_rows(sweep.rows, output, force)
    if picture is not None:
        from fiveroute.decide.picture import sweep_figure
        from fiveroute.plots.saving import save_figure

        save_figure(sweep_figure(sweep), picture)
    if as_json:
        print_json(sweeps.sweep_answer(sweep))
    else:
        sweeps.print_sweep(sweep)
    sweeps.note_left_out(sweep)
    ctx.exit(130 if outcome.interrupted else 0)
