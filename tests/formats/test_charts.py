"""Charts of nodes: what each format says, and what is wrong with one, in one line."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fiveroute.errors import InputError
from fiveroute.formats import SURVEY_FORMATS, read_instance, read_survey, survey_format
from fiveroute.formats.survey import Area, Site, Survey

SQUARE = [[10.2, 63.0], [10.3, 63.0], [10.3, 63.1], [10.2, 63.0]]
CORNERS = ((10.2, 63.0), (10.3, 63.0), (10.3, 63.1))

CSV = """\
Station; Longitude (deg); Latitude; Data; Service time; Depth (m); remark
"A; the first"; 10.01; 63.5; 2.5; 60; 30; "say ""hi"" twice"
'=B; 10.02; 63.6; ; ; ;

Start; 10.0; 63.4; ; ; ;
"""
GEOJSON = json.dumps(
    {
        "type": "FeatureCollection",
        "features": [
            {
                "type": "Feature",
                "properties": {"name": "A; the first", "data": 2.5, "service_time": 60},
                "geometry": {"type": "Point", "coordinates": [10.01, 63.5, -30.0]},
            },
            {
                "type": "Feature",
                "id": "=B",
                "properties": None,
                "geometry": {"type": "Point", "coordinates": [10.02, 63.6, 4.0]},
            },
            {
                "type": "Feature",
                "properties": {"kind": "start"},
                "geometry": {"type": "Point", "coordinates": [10.0, 63.4]},
            },
            {
                "type": "Feature",
                "properties": {"kind": "land"},
                "geometry": {"type": "MultiPolygon", "coordinates": [[SQUARE]]},
            },
            {
                "type": "Feature",
                "properties": {"radius": 300},
                "geometry": {"type": "Point", "coordinates": [10.1, 63.5]},
            },
            {
                "type": "Feature",
                "properties": {"kind": "route"},
                "geometry": {"type": "LineString", "coordinates": SQUARE},
            },
        ],
    }
)
KML = """\
<?xml version="1.0" encoding="UTF-8"?>
<kml xmlns="http://www.opengis.net/kml/2.2"><Document><Folder>
<NetworkLink><Link><href>http://example.org/more.kml</href></Link></NetworkLink>
<Placemark><name>A; the first</name><ExtendedData>
  <Data name="data"><value>2.5</value></Data>
  <SchemaData><SimpleData name="service_time">60</SimpleData></SchemaData></ExtendedData>
  <Point><coordinates> 10.01,63.5,-30 </coordinates></Point></Placemark>
<Placemark><name>=B</name><Point><coordinates>10.02,63.6</coordinates></Point></Placemark>
<Placemark><name>START</name><Point><coordinates>10.0,63.4,0</coordinates></Point></Placemark>
<Placemark><name>isle</name><ExtendedData>
  <Data name="kind"><value>land</value></Data></ExtendedData>
  <Polygon><outerBoundaryIs><LinearRing><coordinates>
  10.2,63.0 10.3,63.0 10.3,63.1 10.2,63.0</coordinates></LinearRing></outerBoundaryIs></Polygon>
</Placemark>
</Folder></Document></kml>
"""
GPX = """\
<?xml version="1.0"?>
<gpx version="1.1" creator="x" xmlns="http://www.topografix.com/GPX/1/1">
<wpt lat="63.5" lon="10.01"><ele>-30</ele><name>A; the first</name><type>WPT</type></wpt>
<wpt lat="63.6" lon="10.02"><ele>4.0</ele><name>=B</name></wpt>
<wpt lat="63.4" lon="10.0"><name>start</name></wpt>
<rte><rtept lat="1" lon="1"/></rte>
</gpx>
"""
TEXTS = {"csv": CSV, "geojson": GEOJSON, "kml": KML, "gpx": GPX}
LAND = Area("land", CORNERS)
AREAS = {"geojson": (LAND, Area("obstacle", ((10.1, 63.5),), 300.0)), "kml": (LAND,)}


@pytest.mark.parametrize("name", TEXTS)
def test_charts_say_the_same_in_every_format(name: str) -> None:
    chart = SURVEY_FORMATS[name].read(TEXTS[name])
    first, second, start = chart.sites
    data, service = (None, None) if name == "gpx" else (2.5, 60.0)
    assert first == Site("A; the first", (10.01, 63.5), data, service, 30.0)
    assert second == Site("=B", (10.02, 63.6))
    assert (start.spot, start.end) == ((10.0, 63.4), "start")
    assert chart.geographic
    assert chart.areas == AREAS.get(name, ())


@pytest.mark.parametrize("name", TEXTS)
def test_doors_know_charts(name: str, tmp_path: Path) -> None:
    path = tmp_path / ("chart.csv" if name == "csv" else "chart.json")
    path.write_text(TEXTS[name])
    assert survey_format(path, TEXTS[name]) == name
    assert read_survey(path) == read_survey(path, name) == SURVEY_FORMATS[name].read(TEXTS[name])
    with pytest.raises(InputError, match="fiveroute convert"):
        read_instance(path)


def test_other_files_are_no_charts(tmp_path: Path) -> None:
    path = tmp_path / "file.txt"
    path.write_text("n 3\nm 1\ntmax 9\n0 0 0\n3 4 1\n0 0 0\n")
    assert survey_format(path, path.read_text()) is None
    with pytest.raises(InputError, match="known are csv"):
        read_survey(path)


@pytest.mark.parametrize(
    "text",
    [
        "id,x,y\na,1.5,-2\n",
        "id\tx\ty\na\t1.5\t-2\n",
        "\r\nid,y,x\r\na,-2,1.5\r\n",
        "name,x [m],y [m],notes\na,1.5,-2,\n",
    ],
)
def test_tables_in_metres(text: str) -> None:
    assert SURVEY_FORMATS["csv"].read(text) == Survey(False, (Site("a", (1.5, -2.0)),))


@pytest.mark.parametrize(
    "text",
    [
        "id;lon;lat;data\n1,5;10,5;63,25;0,5\n;;;\n",
        "id\tlon\tlat\tdata\n1,5\t10,500\t63,250\t0,5\n",
        "sep=;\r\nid;lon;lat;Data (MB)\r\n1,5;10.5;63.25;0.5\r\n",
        "# made by hand\n#\nid;lon;lat;data\n1,5;10°30'E;63 15 N;.5\n",
    ],
)
def test_tables_as_spreadsheets_of_many_countries_save_them(text: str) -> None:
    assert SURVEY_FORMATS["csv"].read(text) == Survey(True, (Site("1,5", (10.5, 63.25), 0.5),))


def test_metres_may_have_decimal_commas_where_they_cannot_be_thousands() -> None:
    text = "id;x;y;depth\na;1234,5;6,789;2\n"
    assert SURVEY_FORMATS["csv"].read(text).sites[0].spot == (1234.5, 6.789)


def test_a_multipoint_of_one_is_a_point() -> None:
    text = feature({"type": "MultiPoint", "coordinates": [[10.5, 63.25]]}, name="a")
    assert SURVEY_FORMATS["geojson"].read(text).sites == (Site("a", (10.5, 63.25)),)


def feature(geometry: object, **properties: object) -> str:
    return json.dumps({"type": "Feature", "properties": properties, "geometry": geometry})


POINT = {"type": "Point", "coordinates": [1, 2]}


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("csv", "10,63\n11,64\n", ("line 1", "lon and lat")),
        ("csv", "id,lon,lat\na,10\n", ("line 2", "2 cells, not 3")),
        ("csv", "id,lon,lat\na,10,63\nb,ten,63\n", ("line 3", "lon", "'ten'")),
        ("csv", "id;lon;lat\na;10,5;63.5\n", ("line 2", "10,5")),
        ("csv", "id;x;y\na;1,234;5,678\n", ("line 2", "1,234")),
        ("csv", "# a\n\nid,lon,lat\na,10,N\n", ("line 4", "lat", "'N'")),
        ("csv", "# nothing else\n", ("names its columns",)),
        ("csv", "id,lon,lat\na,10,95\n", ("line 2", "latitude")),
        ("csv", "id,lon,lat,data\na,10,63,-1\n", ("line 2", "data", "negative")),
        ("csv", "id,lon,lat,dpeth\na,10,63,1\n", ("line 1", "depth")),
        ("csv", 'id,lon,lat\n"a,10,63\n', ("no table",)),
        ("csv", "lon,lat,longitude\n1,2,3\n", ("line 1", "same as")),
        ("geojson", "{", ("JSON text ends too early", "line 1")),
        ("geojson", '{"type": "Topology"}', ("FeatureCollection",)),
        ("geojson", "[" * 100_000, ("nested too deeply",)),
        ("geojson", feature(POINT, data="much"), ("features[0]", "data", "much")),
        ("geojson", feature(POINT, data=[1]), ("features[0]", "data")),
        ("geojson", feature(POINT, radius=0), ("radius", "above 0")),
        ("geojson", feature(POINT, radius=9, kind="land"), ("polygon",)),
        ("geojson", feature({"type": "Point", "coordinates": [1, "2"]}), ("finite",)),
        ("geojson", feature({"type": "Point", "coordinates": [500000, 7e6]}), ("longitude",)),
        ("geojson", feature({"type": "LineString", "coordinates": SQUARE}), ("Polygon",)),
        ("geojson", feature({"type": "Polygon", "coordinates": [SQUARE[:3]]}), ("ring",)),
        ("geojson", feature({"type": "Polygon", "coordinates": [SQUARE, SQUARE[1:]]}), ("ring",)),
        ("geojson", feature({"type": "Polygon", "coordinates": [SQUARE]}, kind="bog"), ("land",)),
        ("geojson", feature({"type": "MultiPoint", "coordinates": SQUARE}), ("of one",)),
        ("geojson", feature(None), ("geometry",)),
        (
            "geojson",
            '{"type": "FeatureCollection", "crs": {"name": "EPSG:25833"}, "features": []}',
            ("WGS84",),
        ),
        ("kml", "<kml><Placemark>", ("no XML",)),
        ("kml", "<gpx/>", ("kml element",)),
        ("kml", KML.replace("10.01,63.5,-30", "10.01 63.5"), ("placemark 1",)),
        ("kml", KML.replace("10.01,63.5,-30", "10.01,x"), ("placemark 1", "'x'")),
        ("kml", KML.replace("10.01,63.5,-30", "10,63 11,64"), ("placemark 1", "one position")),
        ("kml", KML.replace('"data"', '"deppth"'), ("placemark 1", "depth")),
        ("gpx", "<!DOCTYPE gpx><gpx/>", ("document type",)),
        ("gpx", GPX.replace('lat="63.6"', ""), ("waypoint 2", "lat")),
        ("gpx", GPX.replace("<ele>-30", "<ele>deep"), ("waypoint 1", "ele", "deep")),
        ("gpx", "<kml/>", ("gpx element",)),
    ],
)
def test_faults_are_named(name: str, text: str, words: tuple[str, ...]) -> None:
    with pytest.raises(InputError) as error:
        SURVEY_FORMATS[name].read(text)
    assert all(word in str(error.value) for word in words)
    assert "\n" not in str(error.value)


def told(name: str, text: str) -> str:
    """What the reader complains of; nothing where it reads the chart."""
    try:
        SURVEY_FORMATS[name].read(text)
    except InputError as error:
        return str(error)
    return ""


PIECES = st.text(max_size=8) | st.sampled_from(
    ["-1", "1e999", "nan", "null", "[", "]", '"', "<", ">", "&x;", "<!--", ",", ";", "\n", "{}"]
)


@settings(
    deadline=None, max_examples=150, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@pytest.mark.parametrize("name", TEXTS)
@given(data=st.data())
def test_junk_is_read_or_refused(name: str, data: st.DataObject) -> None:
    text = TEXTS[name]
    for _ in range(data.draw(st.integers(1, 4))):
        start = data.draw(st.integers(0, len(text)))
        stop = data.draw(st.integers(start, min(start + 15, len(text))))
        text = text[:start] + data.draw(PIECES) + text[stop:]
    assert "\n" not in told(name, text)
