"""What is too large, too deep or too wide is refused before anything is built from it."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from fiveroute.errors import InputError
from fiveroute.formats import csv_nodes, geojson_nodes, gpx_nodes, kml_nodes, native, read_instance
from fiveroute.formats.files import MAX_BYTES, read_text
from fiveroute.ocean.model_file import decoded


def test_a_file_is_no_larger_than_it_may_be(tmp_path: Path) -> None:
    path = tmp_path / "large.json"
    with path.open("wb") as stream:
        stream.truncate(50 * MAX_BYTES)  # a file with a hole: large, but not on the disk
    with pytest.raises(InputError, match="is larger than 32 MB"):
        read_text(path)


def test_endless_files_end() -> None:
    with pytest.raises(InputError, match="is larger than 32 MB"):
        read_text(Path("/dev/zero"))


@pytest.mark.parametrize(
    ("read", "text"),
    [
        (lambda text: native.read(text, "name"), "[" * 1_000_000),
        (lambda text: native.read(text, "name"), '{"a":' * 1_000_000),
        (geojson_nodes.read, '{"features":' * 1_000_000),
        (kml_nodes.read, "<kml>" + "<a>" * 1_000_000),
        (gpx_nodes.read, "<gpx>" * 100),
    ],
)
def test_nesting_has_an_end(read: object, text: str) -> None:
    assert callable(read)
    with pytest.raises(InputError, match="nested too deeply"):
        read(text)


@pytest.mark.parametrize("key", ["nodes", "travel_times"])
def test_faults_are_not_gathered_without_end(key: str) -> None:
    """Ten million faults would fill the memory, and end the process in pydantic's midst."""
    text = (
        '{"format": "fiveroute-instance/1", "name": "a", "nodes": [], "start": {"x": 0, "y": 0}, '
        '"destination": {"x": 1, "y": 0}, "fleet": {"size": 1, "speed": 1, "endurance": 9}'
    )
    many = "[" + "{}," * 100_000 + "{}]"
    text = text.replace("[]", many) + "}" if key == "nodes" else f'{text}, "{key}": {many}}}'
    with pytest.raises(InputError) as refused:
        native.read(text, "name")
    assert f"{key}[0]" in str(refused.value)
    assert "00" not in str(refused.value).partition("faults after this one")[2]


BOMB = '<!DOCTYPE kml [<!ENTITY a "ha"><!ENTITY b "&a;&a;&a;&a;&a;&a;">]><kml>&b;</kml>'
OUTSIDE = '<!DOCTYPE kml [<!ENTITY a SYSTEM "file:///etc/passwd">]><kml>&a;</kml>'


@pytest.mark.parametrize("text", [BOMB, OUTSIDE])
def test_xml_declares_no_entities(text: str) -> None:
    with pytest.raises(InputError, match="must not declare a document type or entities"):
        kml_nodes.read(text)


def test_a_cell_has_an_end() -> None:
    with pytest.raises(InputError, match="line 2: is no table: field larger than field limit"):
        csv_nodes.read("id,x,y\n" + "a" * 1_000_000 + ",1,2\n")


def test_foreign_names_cost_little() -> None:
    """A chart with very many names of columns is read in the time of its length."""
    names = ",".join(f"measurement{k}" for k in range(5_000))
    zeros = ",".join("0" * 5_000)
    assert len(csv_nodes.read(f"id,x,y,{names}\na,1,2,{zeros}\n").sites) == 1


def test_an_array_that_only_claims_to_be_large_is_not_made(tmp_path: Path) -> None:
    path = tmp_path / "claims.nc"
    xr.Dataset({"u": (("y", "x"), np.zeros((2, 2)))}).to_netcdf(path, engine="h5netcdf")
    import h5py  # type: ignore[import-untyped]

    with h5py.File(path, "a") as file:
        file.create_dataset("huge", shape=(10**6, 10**6), dtype="f4", chunks=(100, 100))
    with (
        xr.open_dataset(path, engine="h5netcdf", decode_cf=False, phony_dims="sort") as data,
        pytest.raises(InputError, match=r"huge: .* has more than 2e.08 numbers"),
    ):
        decoded(data["huge"])


def test_the_folder_of_a_name_that_is_no_text(tmp_path: Path) -> None:
    """A file whose name is no UTF-8 is an instance like any other."""
    path = Path(f"{tmp_path}/\udcff.txt")
    path.write_text("n 2\nm 1\ntmax 1\n0 0 0\n1 1 0\n")
    assert read_instance(path).name == "?"
