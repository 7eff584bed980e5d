"""``fiveroute studio``: the page of a plan, live."""

from __future__ import annotations

import signal
from pathlib import Path

import click

from fiveroute.cli import options
from fiveroute.cli.notes import note

__all__ = ["command"]


@click.command("studio")
@click.argument("file", metavar="[PLAN|INSTANCE]", type=options.FILE, required=False)
@click.option(
    "--port",
    type=options.Whole(0, 65535),
    default=0,
    show_default="a free one",
    metavar="P",
    help="Port on 127.0.0.1; no other address is ever listened on.",
)
@click.option("--no-browser", is_flag=True, help="Print the address only.")
@click.option(
    "--folder",
    type=options.FOLDER,
    help="Project folder, the only one that is written to; without it that of the file.",
)
def command(file: Path | None, port: int, no_browser: bool, folder: Path | None) -> None:
    """Edit a mission in the browser and plan it anew; without a file begin with an empty sea.

    The address holds a secret that lets nobody else in. Ctrl-C ends it.
    """
    import webbrowser

    from fiveroute.cli.running import announce_compilation
    from fiveroute.studio.server import Studio
    from fiveroute.studio.session import Session

    session = Session.opened(file, folder)
    with Studio(session, port) as studio:
        announce_compilation()
        click.echo(studio.url)
        note("Ctrl-C ends the studio")
        if not no_browser:
            webbrowser.open(studio.url)
        # A shell that starts a command in the background has it ignore Ctrl-C.
        signal.signal(signal.SIGINT, signal.default_int_handler)
        try:
            studio.serve_forever()
        except KeyboardInterrupt:
            session.close()
            lost = "" if session.is_saved else "; the last edits were not saved"
            note(f"the studio is closed{lost}")
