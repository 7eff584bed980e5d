"""Rows kept as files."""

from pathlib import Path

from fiveroute.experiments.kept_rows import KeptRows, key_of


def test_a_row_comes_back_under_its_key_alone(tmp_path: Path) -> None:
    kept = KeptRows(tmp_path / "rows")
    key = key_of({"seed": 1, "time": 2.0})
    assert kept.get("a", key) is None
    kept.put("a", key, {"value": 3.5, "nothing": None})
    assert kept.get("a", key) == {"value": 3.5, "nothing": None}
    assert key == key_of({"time": 2.0, "seed": 1})
    assert kept.get("a", key_of({"seed": 2, "time": 2.0})) is None


def test_names_of_files_are_readable_and_harmless(tmp_path: Path) -> None:
    kept = KeptRows(tmp_path)
    kept.put("../p4.2/a b", "0123", {})
    assert [file.name for file in tmp_path.iterdir()] == [".._p4.2_a_b-0123.json"]


def test_a_damaged_file_is_no_row(tmp_path: Path) -> None:
    kept = KeptRows(tmp_path)
    for damaged in ('{"value": 3', "[1]", ""):
        (tmp_path / "a-0123.json").write_text(damaged)
        assert kept.get("a", "0123") is None
