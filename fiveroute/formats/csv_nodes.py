"""Nodes from a table: a spreadsheet saved as CSV, with commas, semicolons or tabs.

The first line names the columns, in any order and in the usual spellings: ``id``; ``lon`` and
``lat`` in degrees, or ``x`` and ``y`` in metres; and where there are any ``data``,
``service_time`` in seconds, ``depth`` in metres, positive down, and ``kind``. A row without data
counts 1. Rows whose kind is ``bend`` are no nodes. Other columns are left alone.
"""

from __future__ import annotations

import csv
import io

from fiveroute.errors import InputError
from fiveroute.formats.chart_fields import fields_of, parsed_number, site_of
from fiveroute.formats.survey import Site, Survey

__all__ = ["read"]

_FORMULAS = ("'=", "'+", "'-", "'@", "'\t", "'\r", "''")  # an apostrophe keeps these text


def read(text: str) -> Survey:
    """Read nodes.

    Raises
    ------
    InputError
        If the text is no such table; it names the line.
    """
    head = text.lstrip("\r\n").partition("\n")[0]
    delimiter = max(",;\t", key=head.count)
    rows = csv.reader(
        io.StringIO(text, newline=""), delimiter=delimiter, skipinitialspace=True, strict=True
    )
    columns: dict[str, int] = {}
    geographic = True
    sites: list[Site] = []
    try:
        for row in rows:
            if not any(cell.strip() for cell in row):
                continue
            if not columns:
                columns, geographic = _columns(row, rows.line_num)
                width = len(row)
                continue
            if len(row) != width:
                raise InputError(
                    f"has {len(row)} cells, not {width}; quote cells with a {delimiter!r} in them",
                    line=rows.line_num,
                )
            values = {field: _plain(row[column]) for field, column in columns.items()}
            if values.get("kind", "").strip().lower() != "bend":
                sites.append(_site(values, geographic, rows.line_num))
    except csv.Error as error:
        raise InputError(f"is no table: {error}; correct the line", line=rows.line_num) from None
    return Survey(geographic, tuple(sites))


def _columns(head: list[str], line: int) -> tuple[dict[str, int], bool]:
    """The columns of our fields, and whether there are longitudes and latitudes."""
    try:
        found = fields_of(name for name in head if name.strip())
    except InputError as error:
        raise InputError(error.rule, value=error.value, field="column", line=line) from None
    for pair, geographic in ((("lon", "lat"), True), (("x", "y"), False)):
        if all(field in found for field in pair):
            return {field: head.index(name) for field, name in found.items()}, geographic
    raise InputError(
        "must name the columns lon and lat, or x and y; add such a line at the top",
        value=head,
        line=line,
    )


def _site(values: dict[str, str], geographic: bool, line: int) -> Site:
    first, second = ("lon", "lat") if geographic else ("x", "y")
    spot = parsed_number(values[first], first, line), parsed_number(values[second], second, line)
    return site_of(values, spot, geographic=geographic, line=line)


def _plain(cell: str) -> str:
    """The text of a cell, without the apostrophe that keeps a spreadsheet from running it."""
    return cell[1:] if cell.startswith(_FORMULAS) else cell
