"""``fiveroute decide ensemble``: which plan stands up best to what the ocean may be."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from click.core import ParameterSource

from fiveroute.cli import options
from fiveroute.cli.decide.question import Work, at_sea, question
from fiveroute.cli.notes import note

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from fiveroute.decide.sweep import Sweep
    from fiveroute.limits import Limits, ProgressCallback
    from fiveroute.ocean.currents import Superposition
    from fiveroute.paths.voyage import Voyage

__all__ = ["command"]

_DRAWING = ("draw", "displacement", "strength")


@question(
    "ensemble",
    click.argument("members", nargs=-1, type=options.FILE),
    click.option(
        "--draw",
        type=options.Whole(min=2),
        default=30,
        show_default=True,
        metavar="K",
        help="Members to draw from the instance's vortices where no files are given.",
    ),
    click.option(
        "--held-out",
        type=options.Whole(min=1),
        metavar="H",
        help="Members that are not planned with, the last ones; half of them by default.",
    ),
    click.option(
        "--alpha",
        type=options.Real(0.0, 1.0, min_open=True),
        default=0.2,
        show_default=True,
        metavar="A",
        help="Share of the worst members that decides (CVaR); 1 is the mean.",
    ),
    click.option(
        "--displacement",
        type=options.METRES,
        default=800.0,
        show_default=True,
        metavar="METRES",
        help="Standard deviation of the centres of drawn vortices.",
    ),
    click.option(
        "--strength",
        type=options.Real(min=0.0, max=5.0),
        default=0.5,
        show_default=True,
        metavar="S",
        help="Standard deviation of the logarithm of their strength.",
    ),
    options.fleet_size,
)
def command(
    instance: Path,
    members: tuple[Path, ...],
    draw: int,
    held_out: int | None,
    displacement: float,
    strength: float,
    seed: int,
    **how: Any,
) -> Work:
    """Plan against MEMBERS of an ensemble of currents, and test on members held out.

    MEMBERS are CF netCDF files that take the place of the instance's own; without them the members
    are drawn from its vortices.
    """
    _require_drawn(members)
    import numpy as np

    from fiveroute.decide.ensembles import held_out_of
    from fiveroute.decide.members import drawn_members, filed_members
    from fiveroute.formats import read_instance
    from fiveroute.ocean.uncertain_ocean import VortexUncertainty

    mission, folder = read_instance(instance), instance.parent
    if members:
        oceans = filed_members(mission, members, folder)
    else:
        uncertainty = VortexUncertainty(displacement=displacement, strength=strength)
        oceans = drawn_members(mission, draw, uncertainty, np.random.default_rng(seed), folder)
    names = list(map(str, members))
    tested = held_out_of(len(oceans), held_out)
    sweep = partial(_against, oceans, names, tested, **how)
    return at_sea(sweep, mission, instance, straight_lines=False, seed=seed)


def _require_drawn(members: tuple[Path, ...]) -> None:
    """Refuse options of drawn members beside members that files hold."""
    ctx = click.get_current_context()
    for name in _DRAWING:
        if members and ctx.get_parameter_source(name) is not ParameterSource.DEFAULT:
            raise click.UsageError(
                f"--{name} is for members drawn from vortices; leave it or the files out"
            )


def _against(
    oceans: Sequence[Superposition],
    names: Sequence[str],
    tested: int,
    voyage: Voyage,
    *,
    limits: Limits,
    progress: ProgressCallback | None,
    **how: Any,
) -> Sweep:
    """The table of a voyage in an ensemble."""
    from fiveroute.decide.ensembles import ensemble_sweep, plan_against_ensemble
    from fiveroute.decide.members import member_times
    from fiveroute.limits import Progress

    clock, times = limits.start(), []
    for k, ocean in enumerate(oceans, start=1):
        if clock.interrupted:  # before there is any row to give
            raise KeyboardInterrupt
        if progress is not None:
            progress(Progress(clock.seconds, message=f"member {k} of {len(oceans)}"))
        times.append(member_times(voyage, ocean))
    _note_lost(voyage, dict(zip(names, times, strict=False)))
    planned = plan_against_ensemble(
        voyage, times, tested, limits=clock.rest(), progress=progress, **how
    )
    return ensemble_sweep(voyage, planned)


def _note_lost(voyage: Voyage, times: Mapping[str, NDArray[np.float64]]) -> None:
    """Say in which files legs cannot be sailed: land may lie elsewhere than it is planned with."""
    from fiveroute.decide.members import lost_share

    lost = {name: lost_share(voyage, table) for name, table in times.items()}
    told = ", ".join(f"{share:.0%} in {name}" for name, share in lost.items() if share)
    if told:
        note(f"planned legs that cannot be sailed (land, no data, current): {told}")
