"""What all questions of ``decide`` share: options, limits, and how a sweep is handed out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

import click

from fiveroute.cli import options

if TYPE_CHECKING:
    from fiveroute.decide.sweep import Sweep
    from fiveroute.instance import Instance
    from fiveroute.limits import Limits, ProgressCallback

__all__ = ["Work", "at_sea", "bound", "question"]


class Work(Protocol):
    """What makes the table of a question."""

    def __call__(self, *, limits: Limits, progress: ProgressCallback | None) -> Sweep:
        """Work the table out as far as the limits allow."""


bound = click.option(
    "--bound",
    type=click.Choice(["none", "quick", "exact"]),
    default="quick",
    show_default=True,
    help="Where the upper bounds come from.",
)

_SHARED = (
    options.seed,
    options.time_limit,
    options.picture("the table"),
    options.output("File for the table: .csv, .md or .parquet."),
    options.force,
    options.json_output,
)


def question(name: str, *own: Callable[..., Any]) -> Callable[[Callable[..., Work]], click.Command]:
    """Make a command of a function from its options to the work that answers it.

    Parameters
    ----------
    name
        Name of the command.
    own
        Arguments and options, beside the instance, the seed and those of all answers.
    """

    def command_of(ask: Callable[..., Work]) -> click.Command:
        def answer(
            ctx: click.Context,
            /,
            time_limit: float,
            output: Path | None,
            picture: Path | None,
            force: bool,
            as_json: bool,
            **asked: Any,
        ) -> None:
            _Answer(output, picture, force, as_json).give(ctx, ask(**asked), time_limit)

        command: Callable[..., Any] = click.pass_context(answer)
        for option in reversed((options.instance, *own, *_SHARED)):
            command = option(command)
        return click.command(name, help=ask.__doc__)(command)

    return command_of


def at_sea(
    sweep: Callable[..., Sweep],
    mission: Instance,
    file: Path,
    *,
    straight_lines: bool,
    seed: int,
) -> Work:
    """Plan the legs of a mission first, and sweep over its voyage in the time that is left.

    Parameters
    ----------
    sweep
        Takes the voyage, and ``limits``, ``seed`` and ``progress``.
    mission, file
        The instance, and the file that it comes from.
    straight_lines
        Whether to ignore the ocean.
    seed
        Seed of the random numbers.
    """
    from fiveroute.cli.sailing import sail

    def work(*, limits: Limits, progress: ProgressCallback | None) -> Sweep:
        clock = limits.start()
        voyage = sail(
            mission, file, limits, straight_lines=straight_lines, seed=seed, progress=progress
        )
        return sweep(voyage, limits=clock.rest(), seed=seed, progress=progress)

    return work


@dataclass(frozen=True, slots=True)
class _Answer:
    """Where a table goes.

    Parameters
    ----------
    output, picture
        Files for the table and for the picture, or None.
    force
        Whether they may be overwritten.
    as_json
        Whether the table is printed as JSON.
    """

    output: Path | None
    picture: Path | None
    force: bool
    as_json: bool

    def give(self, ctx: click.Context, work: Work, time_limit: float) -> None:
        """Work the table out, write and draw it where that is asked for, and print it."""
        from fiveroute.cli.decide.table import note_left_out
        from fiveroute.cli.running import run
        from fiveroute.limits import Limits

        self._check()
        outcome = run(
            lambda limits, progress: work(limits=limits, progress=progress), Limits(time_limit)
        )
        self._write(outcome.value)
        self._print(outcome.value)
        note_left_out(outcome.value, interrupted=outcome.interrupted)
        ctx.exit(130 if outcome.interrupted else 0)

    def _check(self) -> None:
        """Refuse files that could not be written, before any time is spent."""
        from fiveroute.cli.files import require_outputs, require_picture
        from fiveroute.formats.tables import require_table

        require_outputs(self.output, self.picture, force=self.force)
        require_picture(self.picture)
        if self.output is not None:
            require_table(self.output)

    def _write(self, sweep: Sweep) -> None:
        if self.output is not None:
            from fiveroute.formats.tables import write_rows

            write_rows(sweep.rows, self.output, self.force)
        if self.picture is not None:
            from fiveroute.decide.picture import sweep_figure
            from fiveroute.plots.saving import save_figure

            save_figure(sweep_figure(sweep), self.picture)

    def _print(self, sweep: Sweep) -> None:
        from fiveroute.cli.answers import print_json
        from fiveroute.cli.decide.table import print_sweep, sweep_answer

        if self.as_json:
            print_json(sweep_answer(sweep))
        else:
            print_sweep(sweep)
