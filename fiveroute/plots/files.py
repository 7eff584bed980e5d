"""Pictures and films as files."""

from __future__ import annotations

import io
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.animation import FuncAnimation, PillowWriter
from matplotlib.artist import Artist
from matplotlib.figure import Figure

from fiveroute.errors import InputError
from fiveroute.plots.mission import draw_fleet, plot_mission, plot_plan, run_legs
from fiveroute.plots.saving import boxes_for_unknown_signs, save, save_figure
from fiveroute.plots.sea import plot_sea
from fiveroute.view.event_log import RunLog
from fiveroute.view.scene import Scene
from fiveroute.words import printable

__all__ = ["write_film", "write_picture"]

_FRAMES_A_SECOND = 9
_FILM_DPI, _SHADES = 72, 8


def write_picture(scenes: Sequence[Scene], path: Path, *, run: int | None = None) -> None:
    """Draw scenes side by side to a PNG, PDF or SVG file, whole or not at all.

    Parameters
    ----------
    scenes
        One scene or two.
    path
        The file.
    run
        Number of the run that is drawn; None draws the plans.
    """
    figure = _figure(scenes)
    for scene, ax in zip(scenes, figure.subplots(1, len(scenes), squeeze=False)[0], strict=True):
        if run is None:
            plot_plan(scene, ax)
        else:
            plot_mission(scene, _run_of(scene, run), ax=ax)
    _add_legend(figure)
    save_figure(figure, path)


def write_film(
    scenes: Sequence[Scene], path: Path, *, run: int | None = None, frames: int = 72
) -> None:
    """Draw a mission as a film to a GIF file, whole or not at all.

    Parameters
    ----------
    scenes
        One scene or two.
    path
        The file.
    run
        Number of the run; None takes the first one, or the plan where there is none.
    frames
        Number of pictures.
    """
    figure = _figure(scenes)
    figure.set_dpi(_FILM_DPI)
    axes = figure.subplots(1, len(scenes), squeeze=False)[0]
    logs = [_first_run(scene) if run is None else _run_of(scene, run) for scene in scenes]
    legs = [run_legs(scene, log) for scene, log in zip(scenes, logs, strict=True)]
    end = max((leg.done for fleet in legs for own in fleet for leg in own), default=0.0)
    for scene, ax in zip(scenes, axes, strict=True):
        plot_sea(scene, ax, shades=_SHADES)
        ax.set_title(printable(scene.title), alpha=0.0)  # keeps its place free
    _freeze(figure)
    still = {ax: set(ax.get_children()) for ax in axes}

    def draw(frame: int) -> list[Artist]:
        for scene, log, fleet, ax in zip(scenes, logs, legs, axes, strict=True):
            for artist in set(ax.get_children()) - still[ax]:
                artist.remove()
            sailed = None if log is None else log.tracks
            draw_fleet(ax, scene, fleet, end * frame / max(frames - 1, 1), sailed)
            ax.set_title(f"{printable(scene.title)}: {ax.get_title()}", alpha=1.0, y=1.0)
        return []

    film = FuncAnimation(figure, draw, frames=frames)
    writer = PillowWriter(fps=_FRAMES_A_SECOND)
    with boxes_for_unknown_signs():
        save(path, lambda draft: film.save(draft, writer=writer, dpi=_FILM_DPI))


def _freeze(figure: Figure) -> None:
    """Put what has been drawn so far into one image, so that frames need not draw it again."""
    stream = io.BytesIO()
    with boxes_for_unknown_signs():
        figure.savefig(stream, format="rgba", dpi=_FILM_DPI)
    figure.set_layout_engine("none")
    width = int(figure.get_size_inches()[0] * _FILM_DPI)
    image = np.frombuffer(stream.getvalue(), dtype=np.uint8).reshape(-1, width, 4)
    for ax in figure.axes:
        for artist in ax.get_children():
            artist.set_visible(artist is ax.title)
    figure.figimage(image, zorder=-1)


def _first_run(scene: Scene) -> RunLog | None:
    return scene.runs[0] if scene.runs else None


def _run_of(scene: Scene, number: int) -> RunLog:
    for run in scene.runs:
        if run.run == number:
            return run
    known = ", ".join(str(run.run) for run in scene.runs) or "none; pass --events"
    raise InputError(f"is no run of the log; known are {known}", field="run", value=number)


def _figure(scenes: Sequence[Scene]) -> Figure:
    return Figure(figsize=(8.0 * len(scenes), 6.8), layout="constrained")


def _add_legend(figure: Figure) -> None:
    """One legend for all maps: that of the largest fleet."""
    known = [ax.get_legend_handles_labels() for ax in figure.axes]
    figure.legend(*max(known, key=lambda one: len(one[0])), loc="outside lower center", ncols=8)
