import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

Call = Callable[..., Any]


def test_a_plan_can_be_looked_at(call: Call, tiny: Path, tmp_path: Path) -> None:
    plan, page = tmp_path / "plan.json", tmp_path / "page.html"
    assert call("plan", tiny, "--output", plan).code == 0
    answer = call("view", plan, "--instance", tiny, "--output", page)
    assert (answer.code, answer.out) == (0, "")
    assert "Content-Security-Policy" in page.read_text(encoding="utf-8")


def test_wrong_calls_are_told(call: Call, tiny: Path, tmp_path: Path) -> None:
    plan = tmp_path / "plan.json"
    call("plan", tiny, "--output", plan)
    wrong = call("view", plan, "--output", tmp_path / "plan.bmp")
    assert wrong.code == 2
    assert "ends in none of .gif, .html" in wrong.err
    exists = call("view", plan, "--output", plan)
    assert exists.code == 2
    assert "--force" in exists.err
    instance = call("view", tiny, "--output", tmp_path / "page.html")
    assert instance.code == 2
    assert "is not the format of this file" in instance.err


def scenes_of(page: Path) -> Any:
    _, _, data = page.read_text(encoding="utf-8").partition('id="data">')
    return json.loads(data[: data.index("</script>")])["scenes"]


def test_simulated_runs_can_be_played(call: Call, tiny: Path, tmp_path: Path) -> None:
    plan, log, page = (tmp_path / name for name in ("plan.json", "log.jsonl", "page.html"))
    tracks = tmp_path / "tracks.nc"
    call("plan", tiny, "--output", plan)
    files = ("--events", log, "--tracks", tracks)
    assert call("simulate", tiny, plan, "--runs", 2, *files, "--json").code == 0
    answer = call("view", plan, *files, "--events", log, "--output", page)
    assert answer.code == 0
    sailed, straight = scenes_of(page)
    assert [run["run"] for run in sailed["runs"]] == [0, 1]
    assert [run["run"] for run in straight["runs"]] == [0, 1]
    assert all(run["tracks"] for run in sailed["runs"])
    assert not any(run["tracks"] for run in straight["runs"])
    assert (
        call("view", plan, "--events", log, "--run", 9, "--output", tmp_path / "run.png").code == 2
    )
