"""Figures and films as files, each whole or not at all."""

from __future__ import annotations

import io
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from matplotlib.figure import Figure

from fiveroute.errors import InputError
from fiveroute.whole_files import written_whole

__all__ = ["boxes_for_unknown_signs", "save", "save_figure"]


def save(path: Path, write: Callable[[Path], object]) -> None:
    """Have a file written, by a function that is handed the name of a draft.

    Raises
    ------
    InputError
        If the file cannot be written.
    """
    try:
        with written_whole(path) as draft:
            write(draft)
    except OSError as error:
        raise InputError(f"cannot be written ({error.strerror})", file=path) from None


@contextmanager
def boxes_for_unknown_signs() -> Iterator[None]:
    """Draw names without a warning for every sign that the font does not have."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", r"Glyph \d+ .* missing from font")
        yield


def save_figure(figure: Figure, path: Path) -> None:
    """Write a figure; the suffix chooses the format."""
    drawn = io.BytesIO()  # a disk that is full while matplotlib writes makes it fail otherwise
    with boxes_for_unknown_signs():
        figure.savefig(drawn, format=path.suffix[1:], dpi=150)
    save(path, lambda draft: draft.write_bytes(drawn.getvalue()))
