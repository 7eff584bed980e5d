"""Files and folders, whole or not at all, and nothing of anybody else's is lost."""

import json
import zipfile
from pathlib import Path

import pytest

from fiveroute.errors import InputError
from fiveroute.vehicle_files import VEHICLE_FORMATS, write_mission
from fiveroute.vehicle_files.mission import Mission
from fiveroute.vehicle_files.writing import write_folder

FOLDERS = [name for name, known in VEHICLE_FORMATS.items() if known.holds in ("vehicle", "part")]
FILES = [name for name in VEHICLE_FORMATS if name not in FOLDERS]


def alone(mission: Mission) -> Mission:
    from dataclasses import replace

    return replace(mission, vehicles=mission.vehicles[:1])


@pytest.mark.parametrize("name", FILES)
def test_a_fleet_in_one_file(name: str, mission: Mission, tmp_path: Path) -> None:
    path = tmp_path / "fleet.any"
    write_mission(mission, name, path)
    content = path.read_bytes()
    with pytest.raises(InputError, match="--force"):
        write_mission(mission, name, path)
    write_mission(mission, name, path, force=True)
    assert path.read_bytes() == content
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("name", FOLDERS)
def test_a_file_for_every_vehicle(name: str, mission: Mission, tmp_path: Path) -> None:
    folder = tmp_path / "fleet"
    write_mission(mission, name, folder)
    files = {path.relative_to(folder).as_posix() for path in folder.rglob("*.*")}
    assert files == set(VEHICLE_FORMATS[name].write(mission))
    with pytest.raises(InputError, match="--force"):
        write_mission(mission, name, folder)
    write_mission(alone(mission), name, folder, force=True)
    files = {path.relative_to(folder).as_posix() for path in folder.rglob("*.*")}
    assert files == set(VEHICLE_FORMATS[name].write(alone(mission)))
    assert list(tmp_path.iterdir()) == [folder]


@pytest.mark.parametrize("name", FOLDERS)
def test_an_ending_asks_for_one_file(name: str, mission: Mission, tmp_path: Path) -> None:
    path = tmp_path / f"mission{VEHICLE_FORMATS[name].suffixes[0]}"
    with pytest.raises(InputError, match="name a folder"):
        write_mission(mission, name, path)
    if VEHICLE_FORMATS[name].holds == "vehicle":
        write_mission(alone(mission), name, path)
        assert path.is_file()
    else:
        with pytest.raises(InputError, match="name a folder"):
            write_mission(alone(mission), name, path)


@pytest.mark.parametrize("name", VEHICLE_FORMATS)
def test_a_name_of_another_format_is_refused(name: str, mission: Mission, tmp_path: Path) -> None:
    other = ".gpx" if name == "kml" else ".kml"
    with pytest.raises(InputError, match=f"is a name for {other[1:]}; end it in"):
        write_mission(mission, name, tmp_path / f"fleet{other}")
    assert list(tmp_path.iterdir()) == []


def test_folders_with_other_things_are_left_alone(mission: Mission, tmp_path: Path) -> None:
    folder = tmp_path / "home"
    (folder / "deep").mkdir(parents=True)
    write_mission(mission, "qgc", folder)  # nothing but empty folders
    (folder / "letter.txt").write_text("dear")
    with pytest.raises(InputError, match=r"letter\.txt"):
        write_mission(mission, "qgc", folder, force=True)
    assert (folder / "letter.txt").read_text() == "dear"
    link = tmp_path / "link"
    link.symlink_to(folder)
    with pytest.raises(InputError, match="no folder"):
        write_mission(mission, "qgc", link, force=True)
    with pytest.raises(InputError, match="does not exist"):
        write_mission(mission, "qgc", tmp_path / "no" / "where")


def test_a_folder_that_fails_leaves_nothing(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="cannot be written"):
        write_folder(tmp_path / "out", {"a.plan": "1", "a.plan/b.plan": "2"}, (".plan",), False)
    assert list(tmp_path.iterdir()) == []


def test_an_archive_can_be_opened(mission: Mission, tmp_path: Path) -> None:
    path = tmp_path / "bay.nmisz"
    write_mission(mission, "neptus", path)
    with zipfile.ZipFile(path) as archive:
        assert archive.testzip() is None
        assert archive.namelist() == ["mission.nmis", "maps/map.nmap"]


def test_unknown_formats_are_named(mission: Mission, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="did you mean 'neptus'"):
        write_mission(mission, "neptun", tmp_path / "x")


def test_nothing_is_written_that_its_checker_refuses(mission: Mission, tmp_path: Path) -> None:
    from dataclasses import replace

    points = mission.vehicles[0].waypoints
    endless = replace(points[2], hold=70_000.0)
    vehicle = replace(mission.vehicles[0], waypoints=(*points[:2], endless, *points[3:]))
    for name in ("qgc", "wpl", "neptus"):
        with pytest.raises(InputError, match="service time"):
            write_mission(replace(mission, vehicles=(vehicle,)), name, tmp_path / name)
    assert list(tmp_path.iterdir()) == []
    text = VEHICLE_FORMATS["geojson"].write(replace(mission, vehicles=(vehicle,)))
    assert json.loads(text["mission.geojson"])["features"]
