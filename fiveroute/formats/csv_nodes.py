"""Nodes from a table: a spreadsheet saved as CSV, with commas, semicolons or tabs.

The first line names the columns, in any order and in the usual spellings: ``id``; ``lon`` and
``lat`` in degrees (`fiveroute.formats.degrees`), or ``x`` and ``y`` in metres; and where there are
any ``data``, ``service_time`` in seconds, ``depth`` in metres, positive down, and ``kind``. A row
without data counts 1. Rows whose kind is ``bend`` are no nodes. Other columns are left alone, and
so are lines above the names that begin with ``#``, or with Excel's ``sep=``.

Where columns are separated by something else, decimals may follow a comma, as half of the world's
spreadsheets write them. Nothing is guessed: a table whose numbers have points has no decimal
commas, and 1,234 alone could be a thousand.
"""

from __future__ import annotations

import csv
import io
import itertools
import re

from fiveroute.errors import InputError
from fiveroute.formats.chart_fields import fields_of, parsed_number, site_of
from fiveroute.formats.degrees import parsed_degrees
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
    body = "".join(itertools.dropwhile(_is_above, text.splitlines(keepends=True)))
    above = text.count("\n", 0, len(text) - len(body))
    delimiter = max(",;\t", key=body.partition("\n")[0].count)
    rows = csv.reader(
        io.StringIO(body, newline=""), delimiter=delimiter, skipinitialspace=True, strict=True
    )
    try:
        table = [(above + rows.line_num, row) for row in rows if any(map(str.strip, row))]
    except csv.Error as error:
        raise InputError(
            f"is no table: {error}; correct the line", line=above + rows.line_num
        ) from None
    if not table:
        raise InputError("is a table without a line that names its columns; add one at the top")
    line, head = table[0]
    columns, geographic = _columns(head, line)
    for line, row in table[1:]:
        if len(row) != len(head):
            raise InputError(
                f"has {len(row)} cells, not {len(head)}; quote cells with a {delimiter!r} in them",
                line=line,
            )
    found = [
        (line, {field: _plain(row[column]) for field, column in columns.items()})
        for line, row in table[1:]
    ]
    if delimiter != "," and _has_decimal_commas([values for _, values in found]):
        for _, values in found:
            values.update({field: values[field].replace(",", ".") for field in _numbers(values)})
    return Survey(
        geographic,
        tuple(
            _site(values, geographic, line)
            for line, values in found
            if values.get("kind", "").strip().lower() != "bend"
        ),
    )


def _is_above(line: str) -> bool:
    """Whether a line stands above the names of the columns."""
    return not line.strip() or line.lstrip().lower().startswith(("#", "sep="))


def _numbers(values: dict[str, str]) -> list[str]:
    return [field for field in values if field not in ("id", "kind")]


def _has_decimal_commas(rows: list[dict[str, str]]) -> bool:
    """Whether the commas in numbers can be nothing but the beginning of decimals."""
    cells = [(field, row[field].strip()) for row in rows for field in _numbers(row)]
    return not any("." in cell for _, cell in cells) and any(
        (field in ("lon", "lat") and "," in cell) or re.fullmatch(r"[+-]?\d+,(\d\d?|\d{4,})", cell)
        for field, cell in cells
    )


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
    if geographic:
        lon, lat = values["lon"], values["lat"]
        spot = parsed_degrees(lon, "lon", line), parsed_degrees(lat, "lat", line)
    else:
        spot = parsed_number(values["x"], "x", line), parsed_number(values["y"], "y", line)
    return site_of(values, spot, geographic=geographic, line=line)


def _plain(cell: str) -> str:
    """The text of a cell, without the apostrophe that keeps a spreadsheet from running it."""
    return cell[1:] if cell.startswith(_FORMULAS) else cell
