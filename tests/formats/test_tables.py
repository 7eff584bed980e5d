from pathlib import Path
from typing import Any

import pytest

from fiveroute.errors import InputError
from fiveroute.formats.tables import require_table, write_rows

ROWS: list[dict[str, Any]] = [{"name": "a, b", "value": 1.5}, {"name": "c", "value": None}]


def test_csv_has_a_line_a_row(tmp_path: Path) -> None:
    write_rows(ROWS, tmp_path / "t.csv")
    assert (tmp_path / "t.csv").read_text() == 'name,value\n"a, b",1.5\nc,\n'


def test_markdown_leaves_what_is_unknown_empty(tmp_path: Path) -> None:
    write_rows(ROWS, tmp_path / "t.md")
    assert (tmp_path / "t.md").read_text().splitlines()[-1] == "| c |  |"


def test_parquet_keeps_what_is_unknown(tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    write_rows(ROWS, tmp_path / "t.parquet")
    assert parquet.read_table(tmp_path / "t.parquet").to_pylist() == ROWS


def test_nothing_is_overwritten_unasked(tmp_path: Path) -> None:
    for name in ("t.csv", "t.md", "t.parquet"):
        (tmp_path / name).write_text("kept")
        with pytest.raises(InputError, match="--force"):
            write_rows(ROWS, tmp_path / name)


def test_a_table_of_another_kind_is_refused() -> None:
    with pytest.raises(InputError, match=r"ends in \.parquet, \.csv or \.md"):
        require_table(Path("runs.xlsx"))
