from pathlib import Path

import pytest

from fiveroute.errors import InputError
from fiveroute.view.looks import load_scenes, require_look, write_look


def test_two_logs_of_one_plan_are_two_scenes(plan_path: Path, log_path: Path) -> None:
    second = log_path.with_name("second.jsonl")
    second.write_text(log_path.read_text())
    scenes = load_scenes([plan_path], [log_path, second])
    assert [scene.title for scene in scenes] == ["plan, events", "plan, second"]
    assert all(len(scene.runs) == 2 for scene in scenes)


def test_two_plans_have_a_log_each_at_most(plan_path: Path, log_path: Path) -> None:
    scenes = load_scenes([plan_path, plan_path], [log_path])
    assert [len(scene.runs) for scene in scenes] == [2, 0]
    with pytest.raises(InputError, match="no more"):
        load_scenes([plan_path], [log_path] * 3)


def test_suffix_must_be_known(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="ends in none of"):
        require_look(tmp_path / "plan.doc")


def test_file_is_not_overwritten(plan_path: Path, tmp_path: Path) -> None:
    page = tmp_path / "page.html"
    scenes = load_scenes([plan_path])
    write_look(scenes, page)
    assert page.read_text(encoding="utf-8").startswith("<!doctype html>")
    with pytest.raises(InputError, match="--force"):
        write_look(scenes, page)
    write_look(scenes, page, force=True)


@pytest.mark.parametrize(("suffix", "magic"), [(".png", b"\x89PNG"), (".svg", b"<?xml")])
def test_pictures_are_written(
    plan_path: Path, log_path: Path, tmp_path: Path, suffix: str, magic: bytes
) -> None:
    picture = tmp_path / f"look{suffix}"
    write_look(load_scenes([plan_path], [log_path]), picture, run=1)
    assert picture.read_bytes().startswith(magic)
    with pytest.raises(InputError, match="run: 5: is no run of the log; known are 0, 1"):
        write_look(load_scenes([plan_path], [log_path]), picture, run=5, force=True)


def test_a_page_holds_all_runs(plan_path: Path, log_path: Path, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="run: 1: is for a picture or a film"):
        write_look(load_scenes([plan_path], [log_path]), tmp_path / "page.html", run=1)
