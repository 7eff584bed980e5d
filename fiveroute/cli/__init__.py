"""The command line. One file a command; each is imported only when it is called."""

from __future__ import annotations

import errno
import io
import os
import sys
from importlib import import_module

import click

import fiveroute
from fiveroute.cli.notes import aside, hush, note
from fiveroute.errors import FiverouteError, nearest

__all__ = ["main"]

COMMANDS = {
    "plan": "Plan a fleet: routes for every AUV, and how far they are from optimal.",
    "solve": "Solve exactly: the best plan with a proof, or the best bound in the time given.",
    "giant-route": "One route through every node: tier 1's first step alone.",
    "gap": "Compare the planner with exact solutions or bounds, a row an instance.",
    "path": "The fastest path between two stops in the current: tier 3 alone.",
    "simulate": "Carry a plan out in the uncertain ocean, again and again.",
    "decide": "Fleet size, departure, speed, reserve: a table and a picture each.",
    "view": "A look at a plan: a page that plays it, a picture or a film.",
    "studio": "The same page live: edit a mission in the browser and plan it anew.",
    "verify": "Judge a plan: every violation, with its AUV, node and amount.",
    "generate": "Make scenarios: the paper's distribution and other layouts.",
    "convert": "Translate an instance, or a chart of nodes, from one file format to another.",
    "export": "Write a plan for vehicles and map programs: QGroundControl, Neptus, MOOS, KML, ...",
    "experiment": "Repeat the paper's experiments: tables, pictures, figures side by side.",
}

INTERRUPTED = 130


class _LazyGroup(click.Group):
    """A group that knows its commands' names and imports a command when it is called."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in COMMANDS:
            return None
        module = import_module(f"fiveroute.cli.{cmd_name.replace('-', '_')}")
        command: click.Command = module.command
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        try:
            return super().resolve_command(ctx, args)
        except click.UsageError:
            if args[0].startswith("-"):
                raise
            told = f"no such command {args[0]!r}; {nearest(args[0], COMMANDS)}"
            raise click.UsageError(told, ctx) from None

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))


@click.group(cls=_LazyGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(fiveroute.__version__, prog_name="fiveroute")
def _fiveroute() -> None:
    """Plan fleets of autonomous underwater vehicles over fixed sensor nodes."""


def main(arguments: list[str] | None = None) -> None:
    """Run the command line and exit with its code.

    0 done; 1 done and the answer is no; 2 wrong input or call, with one line on standard
    error; 3 stopped by a limit with nothing found; 130 interrupted.
    """
    _fill_closed_streams()
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):  # an id may hold what a terminal cannot show
            stream.reconfigure(errors="backslashreplace")
    try:
        code = _fiveroute.main(arguments, prog_name="fiveroute", standalone_mode=False)
        sys.stdout.flush()
    except OSError as error:
        hush(sys.stdout)
        closed = error.errno == errno.EBADF
        told = "standard output is closed" if closed else error.strerror or error
        code = _complain(f"{told}; check the disk and the terminal", 2)
    except MemoryError:
        code = _complain("the memory is too small for this; make the mission smaller", 2)
    except FiverouteError as error:
        code = _complain(str(error), 2)
    except click.exceptions.NoArgsIsHelpError as error:
        aside(error.ctx.get_help() if error.ctx else str(error))
        code = 2
    except click.ClickException as error:
        code = _complain(" ".join(error.format_message().split()), 2)
    except (KeyboardInterrupt, click.Abort):
        code = _complain("interrupted", INTERRUPTED)
    sys.exit(code if isinstance(code, int) else 0)


def _fill_closed_streams() -> None:
    """Have an answer that nobody can read end in an error.

    A closed standard stream also leaves its number to the next file that is opened, into which
    libraries would then print.
    """
    for number, mode in enumerate((os.O_RDONLY, os.O_RDONLY, os.O_WRONLY)):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, mode)
    if sys.stdout is None:
        sys.stdout = open(1, "w", closefd=False)  # noqa: SIM115


def _complain(sentence: str, code: int) -> int:
    note(sentence)
    return code
