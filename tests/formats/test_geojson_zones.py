"""Zones in GeoJSON: what comes back, what others write, and what is refused."""

import json
from typing import Any

import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.errors import InputError
from fiveroute.formats import geojson_zones
from fiveroute.instance import Circle, Currents, Ocean, Polygon, Uniform

REAL = st.floats(-1e6, 1e6)
CORNERS = st.lists(st.tuples(REAL, REAL), min_size=3, max_size=6).map(tuple)
POLYGON = st.builds(Polygon, CORNERS)
CIRCLE = st.builds(Circle, REAL, REAL, st.floats(1e-3, 1e5))
OCEAN = st.builds(
    Ocean,
    obstacles=st.lists(CIRCLE | POLYGON, max_size=4).map(tuple),
    land=st.lists(POLYGON, max_size=3).map(tuple),
)

RING = [[0, 0], [10, 0], [10, 5], [0, 0]]


def feature(shape: str = "Polygon", coordinates: Any = None, **properties: Any) -> dict[str, Any]:
    return {
        "type": "Feature",
        "properties": properties,
        "geometry": {"type": shape, "coordinates": [RING] if coordinates is None else coordinates},
    }


def collection(*features: Any, **others: Any) -> str:
    return json.dumps({"type": "FeatureCollection", "features": features, **others})


def same_ring(one: Polygon, other: Polygon) -> bool:
    """Whether two polygons have the same corners from the same first one, in either sense."""
    first, *rest = one.polygon
    return other.polygon in (one.polygon, (first, *reversed(rest)))


@given(ocean=OCEAN)
@settings(deadline=None, max_examples=60)
def test_zones_come_back(ocean: Ocean) -> None:
    """To the last bit; only the sense of rotation of a polygon may change, and only once."""
    text = geojson_zones.write(ocean)
    back = geojson_zones.read(text)
    for zones, found in ((ocean.obstacles, back.obstacles), (ocean.land, back.land)):
        for zone, other in zip(zones, found, strict=True):
            if isinstance(zone, Polygon):
                assert isinstance(other, Polygon)
                assert same_ring(zone, other)
            else:
                assert zone == other
    assert geojson_zones.write(back) == text


@given(ocean=OCEAN)
@settings(deadline=None, max_examples=30)
def test_rings_are_written_closed_and_anticlockwise(ocean: Ocean) -> None:
    for part in json.loads(geojson_zones.write(ocean))["features"]:
        if part["geometry"]["type"] == "Polygon":
            (ring,) = part["geometry"]["coordinates"]
            assert ring[0] == ring[-1]
            shape = shapely.Polygon(ring)
            if shape.is_valid and shape.area > 1e-3:
                assert shape.exterior.is_ccw


def test_shapely_reads_what_we_write() -> None:
    ocean = Ocean(
        obstacles=(Polygon(((0.0, 0.0), (0.0, 5.0), (10.0, 5.0), (10.0, 0.0))),),
        land=(Polygon(((20.0, 0.0), (30.0, 0.0), (30.0, 10.0))),),
    )
    shapes = shapely.from_geojson(geojson_zones.write(ocean))
    assert [shape.area for shape in shapely.get_parts(shapes)] == [50.0, 50.0]


def test_currents_are_not_zones() -> None:
    assert (
        geojson_zones.read(geojson_zones.write(Ocean(Currents(uniform=Uniform(1, 0))))) == Ocean()
    )


def test_what_others_write_is_read() -> None:
    """Several parts, altitudes, names, no properties at all, and members of their own."""
    parts = feature("MultiPolygon", [[RING], [[[*place, -3.5] for place in RING]]], kind="land")
    bare = {**feature(), "properties": None, "id": 7}
    buoy = feature("Point", [3, 4], radius=2, kind="obstacle", name="buoy")
    ocean = geojson_zones.read(collection(parts, bare, buoy, crs=None, bbox=[0, 0, 10, 5]))
    triangle = Polygon(((0.0, 0.0), (10.0, 0.0), (10.0, 5.0)))
    assert ocean == Ocean(obstacles=(triangle, Circle(3.0, 4.0, 2.0)), land=(triangle, triangle))


def test_holes_are_cut_out() -> None:
    hole = [[2.0, 0.5], [2.0, 0.8], [4.0, 0.8], [2.0, 0.5]]
    ocean = geojson_zones.read(collection(feature("Polygon", [RING, hole], kind="land")))
    whole = shapely.union_all([shapely.Polygon(part.polygon) for part in ocean.land])
    assert len(ocean.land) == 2
    assert whole.symmetric_difference(shapely.Polygon(RING, [hole])).area < 1e-12


@pytest.mark.parametrize(
    ("wrong", "sentence"),
    [
        (3, r"features\[1\]: 3: must be an object that says"),
        ({**feature(), "type": "feature"}, r"features\[1\]: .*must be an object that says"),
        ({**feature(), "geometry": None}, r"features\[1\].geometry: must be an object; a zone"),
        ({**feature(), "properties": []}, r"features\[1\].properties: \[\]: must be an object"),
        (feature(kind="water"), r"features\[1\].properties.kind: 'water': must be one of obst"),
        (feature(kind=[]), r"features\[1\].properties.kind: \[\]: must be one of obstacle"),
        (feature("LineString", RING), r"features\[1\].geometry.type: 'LineString': must be Poly"),
        (feature("Point", [1, 2]), r"features\[1\].properties.radius: a Point needs a radius"),
        (feature("Point", [1, 2], radius=0), r"features\[1\].properties.radius: 0: a Point needs"),
        (feature("Point", [1, 2], radius="5"), r"features\[1\].properties.radius: '5': a Point"),
        (feature("Point", [1, 2], radius=True), r"features\[1\].properties.radius: True: a P"),
        (feature("Point", [1, 2], radius=5, kind="land"), r"features\[1\]: land must be a polygon"),
        (feature("Point", [1], radius=5), r"features\[1\].geometry.coordinates: \[1\]: a position"),
        (feature("Point", 7, radius=5), r"features\[1\].geometry.coordinates: 7: must be a list"),
        (feature("Polygon", []), r"features\[1\].geometry.coordinates\[0\]: must be a list"),
        (feature("Polygon", [RING, RING]), r"features\[1\].geometry.coordinates: its holes must"),
        (feature("Polygon", [RING[:3]]), r"features\[1\].geometry.coordinates\[0\]: .*four pos"),
        (feature("Polygon", [[*RING, [1, 1]]]), r"features\[1\].*\[0\]: .*the same as the first"),
        (
            feature("Polygon", [[[0, 0], [1, None], [1, 1], [0, 0]]]),
            r"features\[1\].geometry.coordinates\[0\]\[1\]: \[1, None\]: a position must be two",
        ),
        (feature("Polygon", [[[0, 10**400]] * 4]), r"features\[1\].*\[0\]\[0\]: .*two finite"),
        (feature("Polygon", [[[0, float("nan")]] * 4]), r"features\[1\].*\[0\]\[0\]: .*two finite"),
        (feature("MultiPolygon", [[RING], 5]), r"features\[1\].geometry.coordinates\[1\]: 5: must"),
        (feature("MultiPolygon", [[RING, RING]]), r"features\[1\].*coordinates\[0\]: its holes"),
        (feature("Polygon", [RING, RING[:3]]), r"features\[1\].*coordinates\[1\]: .*four pos"),
    ],
)
def test_a_wrong_feature_is_named(wrong: Any, sentence: str) -> None:
    with pytest.raises(InputError, match=f"^{sentence}"):
        geojson_zones.read(collection(feature(), wrong))


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ('{"type":\n oops}', "line 2: is no JSON: expected value"),
        ("", "line 1: the JSON text ends too early"),
        ("[" * 1_000_000, "line 1: the JSON text is nested too deeply"),
        ('{"type": ' + "1" * 5000 + "}", "line 1: is no JSON: number out of range"),
        ("[]", 'must be GeoJSON that says "type": "FeatureCollection"'),
        (json.dumps(feature()), 'must be GeoJSON that says "type": "FeatureCollection"'),
        ('{"type": "FeatureCollection"}', "features: must be a list of features"),
        (collection(crs={"type": "name"}), "crs: .*only local metres are supported"),
    ],
)
def test_what_is_no_collection_is_refused(text: str, sentence: str) -> None:
    with pytest.raises(InputError, match=f"^{sentence}"):
        geojson_zones.read(text)
