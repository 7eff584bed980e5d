"""From files to a look at them: a page, a picture, a film."""

from __future__ import annotations

import tempfile
import webbrowser
from collections.abc import Sequence
from os import PathLike
from pathlib import Path

from fiveroute.errors import InputError
from fiveroute.formats.files import require_writable, write_text_atomically
from fiveroute.view.scene import Scene, scene_of

__all__ = ["load_scenes", "require_look", "show_look", "write_look"]

_PICTURES = (".pdf", ".png", ".svg")
_LOOKS = (".gif", ".html", *_PICTURES)


def load_scenes(
    plans: Sequence[Path],
    logs: Sequence[Path] = (),
    instance: Path | None = None,
    tracks: Sequence[Path] = (),
) -> list[Scene]:
    """Read one plan or two and what was logged of them.

    Parameters
    ----------
    plans
        Plan files, one or two.
    logs
        Event logs; the k-th belongs to the k-th plan, and two logs of one plan are two scenes.
    instance
        Instance that the plans must be for.
    tracks
        Files of the tracks sailed in the runs; the k-th belongs to the k-th log.

    Raises
    ------
    InputError
        If a file is wrong, or there are too many.
    """
    from fiveroute.formats import read_instance
    from fiveroute.formats.plan_file import read_plan
    from fiveroute.view.event_log import read_events
    from fiveroute.view.track_log import with_tracks

    if not 1 <= len(plans) <= 2 or len(logs) > 2:
        raise InputError("two plans and two logs can be compared, no more")
    if len(tracks) > len(logs):
        raise InputError("tracks are played with the log of their runs; add it", field="events")
    mission = None if instance is None else read_instance(instance)
    files = [*plans, plans[-1]][: max(len(plans), len(logs))]
    scenes = []
    for k, path in enumerate(files):
        plan = read_plan(path, mission)
        runs = read_events(logs[k], plan) if k < len(logs) else ()
        if k < len(tracks):
            runs = with_tracks(runs, tracks[k], len(plan.routes))
        folder = path.parent if instance is None else instance.parent
        named = [path.stem, *([logs[k].stem] if len(plans) == 1 and len(logs) == 2 else [])]
        title = ", ".join(named) if len(files) == 2 else plan.instance.name
        scenes.append(scene_of(plan, folder, runs=runs, title=title))
    return scenes


def require_look(path: Path) -> None:
    """Refuse a file whose suffix is none that can be written."""
    if path.suffix.lower() not in _LOOKS:
        raise InputError(
            f"ends in none of {', '.join(_LOOKS)}; choose one", field="output", value=path.name
        )


def write_look(
    scenes: Sequence[Scene], path: Path, *, run: int | None = None, force: bool = False
) -> None:
    """Write a page, a picture or a film, whole or not at all; the suffix tells which.

    Parameters
    ----------
    scenes
        One scene or two.
    path
        The file.
    run
        Number of the run in a picture or film; None shows the plans, or the first run in a film.
        A page holds all runs.
    force
        Overwrite an existing file.
    """
    require_look(path)
    require_writable(path, force)
    suffix = path.suffix.lower()
    if suffix == ".html":
        if run is not None:
            raise InputError(
                "is for a picture or a film; choose the run on the page", field="run", value=run
            )
        from fiveroute.view.page import page_of

        write_text_atomically(path, page_of(scenes), force)
        return
    from fiveroute.plots.files import write_film, write_picture

    (write_film if suffix == ".gif" else write_picture)(scenes, path, run=run)


def show_look(
    scenes: Sequence[Scene],
    path: str | PathLike[str] | None,
    *,
    run: int | None = None,
    force: bool = False,
) -> Path:
    """Write a look and return its file; without one, a page of its own is opened in the browser.

    Parameters
    ----------
    scenes, run, force
        See `write_look`.
    path
        The file, or None.
    """
    if path is not None:
        write_look(scenes, Path(path), run=run, force=force)
        return Path(path)
    page = Path(tempfile.mkdtemp(prefix="fiveroute-")) / "plan.html"
    write_look(scenes, page, run=run)
    webbrowser.open(page.as_uri())
    return page
