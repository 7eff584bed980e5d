"""Names come from strangers; none of them ever becomes the name of a file, but for letters."""

import json
import zipfile
from dataclasses import replace
from pathlib import Path, PurePosixPath

import pytest

from fiveroute.errors import InputError
from fiveroute.formats import PlanFile
from fiveroute.instance import Fleet, Instance, Node, Point
from fiveroute.result import Result
from fiveroute.routes import Plan
from fiveroute.vehicle_files import VEHICLE_FORMATS, Choices, export_plan
from fiveroute.vehicle_files.writing import write_folder

HOSTILE = (
    *("../../x", "/etc/passwd", "a\0b", "..", ".", "CON", "nul.txt", "C:\\x", "\\\\host\\share"),
    *("~/x", "$(touch x)", "`touch x`", "| touch x", "a\nb", "\u202egnp.exe", "x" * 500, "'; --"),
)
SEA = Instance(
    name="../../../name",
    nodes=tuple(Node(name, 100.0 * k, 50.0, 1.0) for k, name in enumerate(HOSTILE, start=1)),
    start=Point(0.0, 0.0),
    destination=Point(2000.0, 0.0),
    fleet=Fleet(2, 1.5, 9000.0, depth=10.0),
    crs="+proj=aeqd +lat_0=63 +lon_0=10",
)


@pytest.fixture
def plan() -> PlanFile:
    half = len(HOSTILE) // 2
    routes = Plan.of([range(1, half + 1), range(half + 1, len(HOSTILE) + 1)])
    problem = SEA.problem()
    result = Result.judged(problem, routes, method="../method", seconds=0.1)
    return PlanFile.of(SEA, problem, result)


def written(folder: Path) -> set[str]:
    return {str(path.relative_to(folder)) for path in folder.rglob("*")}


@pytest.mark.parametrize("name", VEHICLE_FORMATS)
def test_an_export_stays_where_it_is_told(name: str, plan: PlanFile, tmp_path: Path) -> None:
    deep = tmp_path / "a" / "b" / "c"
    deep.mkdir(parents=True)
    chosen = VEHICLE_FORMATS[name]
    is_file = chosen.holds in ("fleet", "archive")
    output = deep / (f"out{chosen.suffixes[0]}" if is_file else "out")
    export_plan(plan, deep / "plan.json", name, output)
    outside = {path for path in written(tmp_path) if not path.startswith("a/b/c/out")}
    assert outside == {"a", "a/b", "a/b/c"}
    if chosen.holds == "archive":
        names = [PurePosixPath(member) for member in zipfile.ZipFile(output).namelist()]
        assert all(not member.is_absolute() and ".." not in member.parts for member in names)


@pytest.mark.parametrize("name", HOSTILE)
def test_a_vehicle_is_called_by_letters(name: str, plan: PlanFile, tmp_path: Path) -> None:
    choices = Choices(names=(name, "other"))
    with pytest.raises(InputError, match=r"must be a name of its own, of letters"):
        export_plan(plan, tmp_path / "plan.json", "qgc", tmp_path / "out", choices)
    assert not written(tmp_path)


def test_a_folder_does_not_follow_links(tmp_path: Path) -> None:
    treasure = tmp_path / "treasure"
    treasure.mkdir()
    (treasure / "kept.plan").write_text("kept")
    (tmp_path / "out").symlink_to(treasure)
    with pytest.raises(InputError, match="exists and is no folder"):
        write_folder(tmp_path / "out", {"a.plan": "new"}, (".plan",), force=True)
    (tmp_path / "out").unlink()
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "a.plan").symlink_to(treasure / "kept.plan")
    with pytest.raises(InputError, match="holds other things"):
        write_folder(tmp_path / "out", {"a.plan": "new"}, (".plan",), force=True)
    assert (treasure / "kept.plan").read_text() == "kept"


def test_a_folder_takes_the_place_of_another_in_one_step(tmp_path: Path) -> None:
    folder = tmp_path / "out"
    for text in ("old", "new"):
        write_folder(folder, {"a.plan": text, "sub/b.plan": text}, (".plan",), force=True)
        assert {path.read_text() for path in folder.rglob("*.plan")} == {text}
    assert [path.name for path in tmp_path.iterdir()] == ["out"]


@pytest.mark.parametrize("folder", [".", "..", "/"])
def test_a_folder_without_a_name_of_its_own_is_left_alone(
    folder: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InputError, match="cannot take the place of this folder"):
        write_folder(Path(folder), {"a.plan": "new"}, (".plan",), force=True)


def test_ids_that_are_names_of_files_are_read_and_written_as_they_are(plan: PlanFile) -> None:
    assert [node.id for node in plan.instance.nodes] == list(HOSTILE)
    again = json.loads(json.dumps([node.id for node in replace(SEA, name="x").nodes]))
    assert again == list(HOSTILE)
