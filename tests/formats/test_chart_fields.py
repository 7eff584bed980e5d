"""The words of charts: which mean what, and which must not be overlooked."""

import pytest

from fiveroute.errors import InputError
from fiveroute.formats.chart_fields import area_kind, fields_of, site_of


@pytest.mark.parametrize(
    ("name", "field"),
    [
        ("Longitude", "lon"),
        ("LAT (deg)", "lat"),
        ("long", "lon"),
        ("x [m]", "x"),
        ("Easting", "x"),
        ("Service Time (s)", "service_time"),
        ("service_time", "service_time"),
        ("Depth (m)", "depth"),
        ("Station ID", "id"),
        ("RHO", "data"),
        ("Data (MB)", "data"),
        ("Volume [kbit]", "data"),
    ],
)
def test_names_have_many_spellings(name: str, field: str) -> None:
    assert fields_of([name, "remark", "colour"]) == {field: name}


def test_the_first_of_several_names_is_the_id() -> None:
    assert fields_of(["station", "name", "id"]) == {"id": "id"}
    assert fields_of(["Label", "Name"]) == {"id": "Name"}


@pytest.mark.parametrize("name", ["dpeth", "depth_km", "depth (km)", "longtitude", "service_min"])
def test_slips_and_other_units_are_not_overlooked(name: str) -> None:
    with pytest.raises(InputError, match="did you mean"):
        fields_of(["id", name])


def test_two_names_for_one_number_are_refused() -> None:
    with pytest.raises(InputError, match="same as"):
        fields_of(["data", "score"])


def test_kinds_of_zones() -> None:
    assert [area_kind(kind, "") for kind in (None, "Zone", "coastline")] == [
        "obstacle",
        "obstacle",
        "land",
    ]
    with pytest.raises(InputError, match="obstacle or land"):
        area_kind("swamp", "features[0]")


@pytest.mark.parametrize(
    ("name", "kind", "end"),
    [
        ("START", "", "start"),
        ("Destination", "", "destination"),
        ("start", "node", None),
        ("a", "start", "start"),
        ("a", "destination", "destination"),
        ("start", "buoy", "start"),
        ("a", "buoy", None),
    ],
)
def test_ends_are_told_by_name_or_kind(name: str, kind: str, end: str | None) -> None:
    site = site_of({"id": name, "kind": kind}, (10.0, 63.0), geographic=True)
    assert site.end == end


def test_longitudes_up_to_360_are_wrapped() -> None:
    assert site_of({}, (350.0, 1.0), geographic=True).spot == (-10.0, 1.0)
    assert site_of({}, (350.0, 1.0), geographic=False).spot == (350.0, 1.0)
