"""Tables as files: CSV, Markdown or Parquet, as the suffix says."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from fiveroute.errors import InputError
from fiveroute.formats.files import require_writable, write_text_atomically
from fiveroute.whole_files import written_whole

__all__ = ["require_table", "write_rows"]


def require_table(path: Path) -> None:
    """Refuse a table that could not be written, before any time is spent."""
    if path.suffix not in (".parquet", ".csv", ".md"):
        raise InputError("a table ends in .parquet, .csv or .md", field="output", value=path.name)
    if path.suffix == ".parquet":
        try:
            import pyarrow.parquet  # noqa: F401
        except ImportError:
            raise InputError(
                "needs Arrow; install fiveroute[parquet], or write a .csv file",
                field="output",
                value=str(path),
            ) from None


def write_rows(rows: Sequence[Mapping[str, Any]], path: Path, force: bool = False) -> None:
    """Write a table, whole or not at all; its suffix chooses the format.

    Parameters
    ----------
    rows
        One at least, all with the same columns; None is what is unknown.
    path
        The file, .csv, .md or .parquet.
    force
        Overwrite an existing file.
    """
    if path.suffix == ".csv":
        write_text_atomically(path, _csv(rows), force)
    elif path.suffix == ".md":
        write_text_atomically(path, _markdown(rows), force)
    else:
        require_writable(path, force)
        _write_parquet(rows, path)


def _csv(rows: Sequence[Mapping[str, Any]]) -> str:
    text = io.StringIO()
    writer = csv.DictWriter(text, rows[0], lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()


def _markdown(rows: Sequence[Mapping[str, Any]]) -> str:
    header = list(rows[0])
    cells = [["" if value is None else str(value) for value in row.values()] for row in rows]
    lines = [header, ["---"] * len(header), *cells]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def _write_parquet(rows: Sequence[Mapping[str, Any]], path: Path) -> None:
    import pyarrow
    import pyarrow.parquet

    try:
        with written_whole(path) as draft:
            pyarrow.parquet.write_table(pyarrow.Table.from_pylist(list(rows)), draft)
    except OSError as error:
        told = f"cannot be written ({error.strerror or error}); check the name and the disk"
        raise InputError(told, file=path) from None
