"""Damaged files by the million, for every reader: whatever they hold, they are read or refused.

    python benchmarks/fuzz.py READER|all [--count N] [--seed N] [--only K]

A file that is well-formed is damaged with its structure in mind: bits, pieces and lines are cut
out, doubled, moved and written over, numbers and words become absurd ones, keys and values of JSON
are lost, doubled and exchanged, encodings and ends of lines are others, and the end is cut off.
Files of currents are also written whole with contents that make no sense (`sea`). A reader may
answer, or refuse with one printable line (`InputError`); anything else is a finding: another
exception, a warning, more than `SECONDS` of processor time or `PATIENCE` without any, more than
`MEMORY`, the end of the process. Python hears no signal while a library is at work, so that one
that never comes back ends the process, whatever code it is in; the run says where, and goes on
with the next input. Input K of a reader and a seed is the same in every run; ``--only K`` reads
it alone.
"""

from __future__ import annotations

import argparse
import faulthandler
import io
import json
import mmap
import os
import random
import re
import resource
import signal
import sys
import tempfile
import time
import traceback
import warnings
import zipfile
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache, partial
from pathlib import Path
from typing import Any

import numpy as np
import spoilt_seas

from fiveroute.errors import InputError
from fiveroute.formats import (
    PlanFile,
    Terms,
    geojson_zones,
    read_instance,
    read_plan,
    read_survey,
    write_instance,
    write_plan,
)
from fiveroute.formats.files import read_text
from fiveroute.instance import (
    Circle,
    Currents,
    Fleet,
    Instance,
    Node,
    Ocean,
    Point,
    Polygon,
    Service,
    Uniform,
    Vortex,
)
from fiveroute.limits import Limits
from fiveroute.result import Result
from fiveroute.routes import Plan

SECONDS = 5
"""Processor time that reading a small file may take."""

PATIENCE = 600
"""Seconds after which a reader waits for what will not come."""

MEMORY = 6 * 2**30
"""Address space of the process that reads; the libraries' own is most of it."""

LONGEST = 1000
"""Characters of a refusal, without the name of the file."""

BATCH = 20_000

PIECES = [
    *(b"-1", b"0", b"1e308", b"-1e308", b"1e999", b"nan", b"NaN", b"inf", b"-Infinity", b"1_0"),
    *(b"9" * 400, b"9" * 5000, b"0x10", b"1e-400", b"\xd9\xa1", b"null", b"true", b"{}", b"[]"),
    *(b"[" * 300, b'{"a":' * 200, b"<a>" * 100, b'"', b"'", b",", b";", b"\t", b":", b"}", b"]"),
    *(
        b"\n",
        b"\r",
        b"\r\n",
        b"\0",
        b"\x1a",
        b"\x85",
        b"\xe2\x80\xa8",
        b"\xff",
        b"\xc3",
        b"\xef\xbb\xbf",
    ),
    *(
        b"\\ud800",
        b"\\u0000",
        b"&#0;",
        b"&#xD800;",
        b"&amp;",
        b"&x;",
        b"<!DOCTYPE a>",
        b"<![CDATA[",
    ),
    *(b"EOF", b"-", b" ", b"x" * 3000, b"../../x", b"/etc/passwd", b"%s", b"<?xml?>", b"]]>"),
]
VALUES: list[Any] = [
    *(None, True, False, -1, 0, 0.5, -0.0, 1e308, -1e308, 10**400, 2**63, float("nan")),
    *(float("inf"), "", "x", "nan", "1", "\ud800", "\0", "\u2028", "e\u0301" * 40, "y" * 5000),
    *([], {}, [[]], [None], {"": 0}, [1, 2], [0.0, 0.0], {"format": 1}, "../../x", "optimal"),
]


# --- damage ---------------------------------------------------------------------------------------


def damaged(content: bytes, rng: random.Random) -> bytes:
    """A file with one to four faults."""
    for _ in range(rng.choice((1, 1, 2, 4))):
        content = rng.choice(_WAYS)(content, rng)
    return content


def _bits(content: bytes, rng: random.Random) -> bytes:
    spoilt = bytearray(content)
    for _ in range(rng.choice((1, 1, 3, 20))):
        if spoilt:
            spoilt[rng.randrange(len(spoilt))] ^= 1 << rng.randrange(8)
    return bytes(spoilt)


def _span(length: int, rng: random.Random) -> tuple[int, int]:
    start = rng.randint(0, length)
    return start, min(length, start + rng.choice((0, 1, 2, 8, 40, 400)))


def _piece(content: bytes, rng: random.Random) -> bytes:
    """A piece cut out, doubled, moved or written over."""
    start, stop = _span(len(content), rng)
    new = rng.choice((b"", content[start:stop] * 2, rng.choice(PIECES), rng.choice(PIECES)))
    return content[:start] + new + content[stop:]


def _word(content: bytes, rng: random.Random) -> bytes:
    """A word or number written over."""
    words = list(re.finditer(rb"[\w.+-]+", content))
    if not words:
        return content + rng.choice(PIECES)
    word = rng.choice(words)
    new = rng.choice((rng.choice(PIECES), rng.choice(words).group()))
    return content[: word.start()] + new + content[word.end() :]


def _lines(content: bytes, rng: random.Random) -> bytes:
    """A line lost, doubled or moved."""
    lines = content.splitlines(keepends=True) or [b""]
    line = lines.pop(rng.randrange(len(lines)))
    for _ in range(rng.randrange(3)):
        lines.insert(rng.randint(0, len(lines)), line)
    return b"".join(lines)


def _cut(content: bytes, rng: random.Random) -> bytes:
    return content[: rng.randint(0, len(content))]


def _encoded(content: bytes, rng: random.Random) -> bytes:
    """Another encoding, or other ends of lines."""
    text = content.decode("utf-8", "replace")
    code = rng.choice(("utf-8-sig", "utf-16", "latin-1", "utf-32-le", "crlf", "cr", "lf2", "utf-7"))
    ends = {"crlf": "\r\n", "cr": "\r", "lf2": "\n\n"}
    if code in ends:
        return text.replace("\n", ends[code]).encode()
    return text.encode(code, "replace")


def _json(content: bytes, rng: random.Random) -> bytes:
    """A value or key of a JSON document lost, doubled or exchanged."""
    try:
        document = json.loads(content)
    except (ValueError, RecursionError):
        return _word(content, rng)
    holders = [part for part in _parts(document) if part]
    if not holders:
        return _word(content, rng)
    holder = rng.choice(holders)
    key = rng.choice(list(holder) if isinstance(holder, dict) else range(len(holder)))
    value = rng.choice((rng.choice(VALUES), rng.choice(VALUES), rng.choice(holders)))
    if rng.random() < 0.2:
        del holder[key]
    elif isinstance(holder, dict) and rng.random() < 0.3:
        holder[rng.choice((str(key) + "x", "", "format", "\ud800", "id", "k" * 500))] = value
    elif isinstance(holder, list) and rng.random() < 0.3:
        holder.insert(key, holder[key])
    else:
        holder[key] = value
    try:
        text = json.dumps(document, ensure_ascii=rng.random() < 0.7)
    except ValueError:  # it holds itself
        return _word(content, rng)
    if rng.random() < 0.1:
        text = re.sub(r'("\w+": [^,{}\[\]]+)', r"\1, \1", text, count=rng.randrange(1, 9))
    return text.encode("utf-8", "surrogatepass")


def _parts(document: Any) -> list[Any]:
    """All objects and lists of a document."""
    found, ahead = [], [document]
    while ahead:
        part = ahead.pop()
        if isinstance(part, (dict, list)):
            found.append(part)
            ahead += part.values() if isinstance(part, dict) else part
    return found


_WAYS = (_bits, _piece, _piece, _word, _word, _word, _lines, _cut, _encoded, _json, _json, _json)


# --- readers --------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Reader:
    """How files of a kind are read, and some that are well-formed."""

    suffix: str
    files: tuple[bytes, ...]
    read: Callable[[Path], object]
    spoil: Callable[[random.Random], bytes] | None = None

    def spoilt(self, rng: random.Random) -> bytes:
        """One of the files damaged, or a file that was spoilt as it was written."""
        if self.spoil is not None:
            return self.spoil(rng)
        return damaged(rng.choice(self.files), rng)


SEA = Instance(
    name="bay",
    nodes=(
        Node("a", 1000.0, 200.0, 2.0, service_time=30.0, depth=20.0),
        Node("b \u00e9", 2000.0, 500.0, 1.0),
        Node("c", 1500.0, 2000.0, 0.5),
    ),
    start=Point(0.0, 0.0),
    destination=Point(4000.0, 0.0),
    fleet=Fleet(2, 1.5, (9000.0, 8000.0), depth=10.0, depth_rating=100.0),
    service=Service(1.0, 2.0),
    ocean=Ocean(
        currents=Currents((Vortex(9.0, 9.0, 5.0, 100.0),), Uniform(0.1, 0.0)),
        obstacles=(Circle(1.0, 9000.0, 0.5), Polygon(((0.0, 5e3), (1e3, 5e3), (0.0, 6e3)))),
        land=(Polygon(((0.0, -5e3), (1e3, -5e3), (0.0, -6e3))),),
    ),
    crs="+proj=aeqd +lat_0=63 +lon_0=10",
)
STILL = replace(SEA, ocean=Ocean(), fleet=Fleet(2, 1.5, 9000.0))
CHAO = b"n 4\nm 2\ntmax 9.5\n0 0 0\n3\t4\t1\n5;6;2\n0 0 0\n"
TSP = (
    b"NAME : t\nTYPE : TSP\nCOMMENT : c\nDIMENSION : 3\nEDGE_WEIGHT_TYPE : EXPLICIT\n"
    b"EDGE_WEIGHT_FORMAT : UPPER_ROW\nEDGE_WEIGHT_SECTION\n1 2\n3\nDISPLAY_DATA_SECTION\n"
    b"1 0 0\n2 3 4\n3 1 1\nEOF\n",
    b"NAME : g\nTYPE : TSP\nDIMENSION : 3\nEDGE_WEIGHT_TYPE : GEO\nNODE_COORD_SECTION\n"
    b"1 38.24 20.42\n2 39.57 26.15\n3 40.56 25.32\nEOF\n",
)
OP = (
    b"NAME : o\nTYPE : OP\nDIMENSION : 3\nCOST_LIMIT : 9\nEDGE_WEIGHT_TYPE : EUC_2D\n"
    b"NODE_COORD_SECTION\n1 0 0\n2 3.5 -4\n3 1 1\nNODE_SCORE_SECTION\n1 0\n2 1\n3 2\n"
    b"DEPOT_SECTION\n1\n-1\nEOF\n"
)
CSV = (
    b"id,lon,lat,data,service time (s),depth,kind,note\nstart,10.0,63.0,,,,start,\n"
    b'a,10.1,63.0,2.5,30,20,node,"x, ""y"""\nb,10.1,63.1,1,,,,\nhome,10.2,63,,,,destination,z\n',
    b"name;x;y;score\nstart;0;0;\n'=a;1e3;5;2\nb;2000;7;1\ndestination;3000;0;\n",
)
POINTS = [("start", 10.0, 63.0), ("a", 10.1, 63.0), ("b", 10.1, 63.1), ("destination", 10.2, 63.0)]
RING = [[9.9, 63.2], [10.0, 63.2], [10.0, 63.3], [9.9, 63.2]]
HOLE = [[9.97, 63.21], [9.98, 63.25], [9.99, 63.22], [9.97, 63.21]]
CHART = json.dumps(
    {
        "type": "FeatureCollection",
        "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:OGC:1.3:CRS84"}},
        "features": [
            *(
                {
                    "type": "Feature",
                    "properties": {"id": name, "data": 1.5, "depth": 20, "colour": "red"},
                    "geometry": {"type": "Point", "coordinates": [lon, lat, -3.0]},
                }
                for name, lon, lat in POINTS
            ),
            {
                "type": "Feature",
                "properties": {"kind": "land"},
                "geometry": {"type": "Polygon", "coordinates": [RING]},
            },
            {
                "type": "Feature",
                "properties": {"radius": 300.0},
                "geometry": {"type": "Point", "coordinates": [10.05, 63.4]},
            },
            {
                "type": "Feature",
                "properties": None,
                "geometry": {"type": "MultiPolygon", "coordinates": [[RING, HOLE], [RING]]},
            },
        ],
    }
).encode()
ZONES = geojson_zones.write(SEA.ocean).encode()
KML = (
    '<?xml version="1.0" encoding="UTF-8"?>\n<kml xmlns="http://www.opengis.net/kml/2.2"><Document>'
    + "".join(
        f"<Placemark><name>{name}</name><ExtendedData><Data name='data'><value>2</value></Data>"
        f"<SchemaData><SimpleData name='depth'>5</SimpleData></SchemaData></ExtendedData>"
        f"<Point><coordinates>{lon},{lat},-3</coordinates></Point></Placemark>\n"
        for name, lon, lat in POINTS
    )
    + "<Placemark><Polygon>"
    + "".join(
        f"<{side}BoundaryIs><LinearRing><coordinates>"
        + " ".join(f"{lon},{lat}" for lon, lat in ring)
        + f"</coordinates></LinearRing></{side}BoundaryIs>"
        for side, ring in (("outer", RING), ("inner", HOLE))
    )
    + "</Polygon></Placemark></Document></kml>\n"
).encode()


def _kmz(content: bytes = KML, how: int = zipfile.ZIP_DEFLATED, **document: Any) -> bytes:
    """A document in an archive, beside a picture; what its entry says may be other things."""
    into, member = io.BytesIO(), zipfile.ZipInfo("doc.kml")
    with zipfile.ZipFile(into, "w", how) as archive:
        archive.writestr("files/icon.png", b"\x89PNG")
        member.compress_type = how
        for name, value in document.items():
            setattr(member, name, value)
        archive.writestr(member, content)
    return into.getvalue()


def _spoilt_kmz(rng: random.Random) -> bytes:
    """An archive of a damaged document, or one whose members or bytes are damaged."""
    how = rng.choice((zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED))
    if rng.random() < 0.3:
        return _kmz(damaged(KML, rng), how)
    told: dict[str, Any] = {}
    if rng.random() < 0.3:
        told["filename"] = rng.choice(("a.KML", "../doc.kml", "C:x.kml", "a/b.kml", "\u2028.kml"))
    if rng.random() < 0.2:
        told["external_attr"] = rng.getrandbits(32)
    whole = _kmz(KML, how, **told)
    if rng.random() < 0.5:
        return rng.choice((_bits, _piece, _cut, _word))(whole, rng)
    spoilt = bytearray(whole)  # a field of an entry, of a header or of the end written over
    at = rng.choice([m.start() for m in re.finditer(rb"PK(\x01\x02|\x03\x04|\x05\x06)", whole)])
    for _ in range(rng.choice((1, 1, 2, 5))):
        field, size = at + 2 * rng.randint(2, 22), rng.choice((1, 2, 4))
        spoilt[field : field + size] = rng.choice((0, 1, rng.getrandbits(32), -1)).to_bytes(
            5, "little", signed=True
        )[:size]
    return bytes(spoilt)


GPX = (
    '<?xml version="1.0"?>\n<gpx version="1.1" xmlns="http://www.topografix.com/GPX/1/1">'
    + "".join(
        f'<wpt lat="{lat}" lon="{lon}"><ele>-5</ele><name>{name}</name><type>{name}</type></wpt>\n'
        for name, lon, lat in POINTS
    )
    + "</gpx>\n"
).encode()
SAID = {"number": 0, "kind": "award", "sender": 1, "receiver": None, "bits": 68}
HEARD = [{"auv": 0, "t": 9.9}]
EVENTS = "".join(
    json.dumps(event) + "\n"
    for event in (
        {"run": 1, "t": 0.0, "auv": 0, "kind": "depart"},
        {"run": 1, "t": 11.5, "auv": 0, "kind": "collect", "node": "a"},
        {"run": 0, "t": 12, "auv": 1, "kind": "discard", "node": "c"},
        {"run": 0, "t": 9.0, "auv": 1, "kind": "send"},
        {"run": 0, "t": 9.5, "auv": 1, "kind": "send", "message": SAID | {"heard": HEARD}},
        {"run": 0, "t": 9.9, "auv": 0, "kind": "receive", "message": SAID},
    )
).encode()
REFERENCE = b'instance,best_known,source\nbay,3.5,here\n"p1, a",12,there\nc,1e3,\n'
ROW = json.dumps(
    {
        "instance": "bay",
        "nodes": 3,
        "fleet_size": 2,
        "heuristic": 3.5,
        "bound": 3.5,
        "best_known": 3.5,
        "gap": 0.0,
        "status": "optimal",
        "seconds": 0.1,
        "peers": {"vroom": {"objective": 3.0, "status": "feasible", "seconds": 1.0}},
    }
).encode()


@cache
def _plan() -> PlanFile:
    problem = STILL.problem()
    result = Result.judged(problem, Plan.of([[1, 2], [3]]), method="by-hand", seconds=0.1, seed=7)
    return PlanFile.of(STILL, problem, result)


def _written(write: Callable[[Path], object], suffix: str) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"file{suffix}"
        write(path)
        return path.read_bytes()


def _read_instance(format_name: str, path: Path) -> None:
    instance = read_instance(path, format_name)
    instance.problem(instance.fleet_size or 1)


def _read_plan(path: Path) -> None:
    from fiveroute.verdict import judge

    filed = read_plan(path)
    assert filed.tracks is None or len(filed.tracks) == len(filed.routes)
    judge(filed.instance, filed, straight_lines=True)


def _read_chart(format_name: str, path: Path) -> None:
    terms = Terms(speed=1.0, endurance=9e3)
    mission = read_survey(path, format_name).instance(path.stem, terms)
    mission.problem(1)


def _read_netcdf(path: Path) -> None:
    from fiveroute.ocean.model_current import read_current

    current = read_current(path, reach=500e3)
    current(np.zeros(2), np.zeros(2), 0.0)


def _read_events(path: Path) -> None:
    from fiveroute.view.event_log import read_events

    read_events(path, _plan())


def _tracks() -> tuple[bytes, ...]:
    """Tracks of the runs of `EVENTS`, as netCDF-4 and as netCDF-3."""
    from fiveroute.formats.track_file import trajectories

    way = np.array([[0.0, 0.0, 0.0], [10.0, 8.0, 6.0]])
    data = trajectories(STILL, [(0, (way, way)), (1, (way, way[:0]))])
    named = data.assign(trajectory=("trajectory", [0, 1, 2]))
    return (
        _written(partial(data.to_netcdf, engine="h5netcdf"), ".nc"),
        _written(partial(named.to_netcdf, engine="scipy"), ".nc"),
    )


def _read_tracks(path: Path) -> None:
    from fiveroute.view.event_log import run_logs
    from fiveroute.view.track_log import with_tracks

    with_tracks(run_logs(EVENTS.decode(), _plan()), path, 2)


def _read_certificate(path: Path) -> None:
    from fiveroute.cli.certifying import confirm_certificate

    confirm_certificate(STILL, path, path, Limits(0.2))


def _read_reference(path: Path) -> None:
    from fiveroute.experiments.gap_table import read_reference

    read_reference(path)


def _read_kept(path: Path) -> None:
    from fiveroute.experiments.gap_row import GapRow
    from fiveroute.experiments.kept_rows import KeptRows

    class Named(KeptRows):
        def _file(self, label: str, key: str) -> Path:
            return path

    document = Named(path.parent).get("label", "key")
    if document is not None:
        GapRow.of_document(document)


def _netcdf() -> tuple[bytes, ...]:
    """A small sea, as netCDF-3 and as netCDF-4."""
    import xarray as xr

    dims = ("time", "depth", "latitude", "longitude")
    u = np.linspace(-0.5, 0.5, 2 * 1 * 4 * 5, dtype=np.float32).reshape(2, 1, 4, 5)
    u[:, :, 0, 0] = np.float32(9.96921e36)
    name = "{}ward_sea_water_velocity"
    told = {"units": "m s-1", "_FillValue": np.float32(9.96921e36)}
    hours = {"units": "hours since 2020-03-01 00:00:00", "standard_name": "time"}
    sea = xr.Dataset(
        {
            "uo": (dims, u, told | {"standard_name": name.format("east")}),
            "vo": (dims, -u, told | {"standard_name": name.format("north")}),
            "time": ("time", np.array([0.0, 6.0]), hours),
            "depth": ("depth", [0.5], {"units": "m", "positive": "down", "axis": "Z"}),
            "latitude": ("latitude", 60.0 + 0.01 * np.arange(4), {"units": "degrees_north"}),
            "longitude": ("longitude", 5.0 + 0.02 * np.arange(5), {"units": "degrees_east"}),
        }
    )
    still = sea.isel(time=0, depth=0, drop=True)
    old = partial(sea.to_netcdf, engine="scipy")
    return (
        _written(old, ".nc"),
        _written(partial(still.to_netcdf, engine="scipy"), ".nc"),
        _written(partial(still.to_netcdf, engine="h5netcdf"), ".nc"),
    )


def _certificate() -> bytes:
    from fiveroute.formats.native import instance_hash
    from fiveroute.models.branch_price.certificate import certify

    proof = certify(STILL.problem())
    assert proof is not None
    more = {"instance_hash": instance_hash(STILL), "fleet_size": 2, "straight_lines": True}
    return json.dumps(proof.document() | more).encode()


def _native() -> tuple[bytes, ...]:
    timed = replace(
        STILL,
        metric="explicit",
        travel_times=tuple(tuple(float(abs(i - j)) for j in range(5)) for i in range(5)),
    )
    return tuple(
        _written(partial(write_instance, instance), ".json") for instance in (SEA, STILL, timed)
    )


@cache
def reader(name: str) -> Reader:
    """The reader of that name."""
    return _READERS[name]()


_READERS: dict[str, Callable[[], Reader]] = {
    "native": lambda: Reader(".json", _native(), partial(_read_instance, None)),
    "plan": lambda: Reader(".json", (_written(partial(write_plan, _plan()), ".json"),), _read_plan),
    "chao": lambda: Reader(".txt", (CHAO,), partial(_read_instance, "chao")),
    "tsplib": lambda: Reader(".tsp", TSP, partial(_read_instance, "tsplib")),
    "oplib": lambda: Reader(".op", (OP,), partial(_read_instance, "oplib")),
    "csv": lambda: Reader(".csv", CSV, partial(_read_chart, "csv")),
    "geojson": lambda: Reader(".geojson", (CHART,), partial(_read_chart, "geojson")),
    "kml": lambda: Reader(".kml", (KML,), partial(_read_chart, "kml")),
    "kmz": lambda: Reader(
        ".kmz",
        (_kmz(), _kmz(how=zipfile.ZIP_STORED)),
        partial(_read_chart, "kml"),
        _spoilt_kmz,
    ),
    "gpx": lambda: Reader(".gpx", (GPX,), partial(_read_chart, "gpx")),
    "zones": lambda: Reader(".geojson", (ZONES,), lambda path: geojson_zones.read(read_text(path))),
    "netcdf": lambda: Reader(".nc", _netcdf(), _read_netcdf),
    "sea": lambda: Reader(
        ".nc",
        tuple(spoilt_seas.file_of(layout()) for layout in spoilt_seas.LAYOUTS),
        _read_netcdf,
        spoilt_seas.spoilt_sea,
    ),
    "tracks": lambda: Reader(".nc", _tracks(), _read_tracks),
    "events": lambda: Reader(".jsonl", (EVENTS,), _read_events),
    "certificate": lambda: Reader(".json", (_certificate(),), _read_certificate),
    "reference": lambda: Reader(".csv", (REFERENCE,), _read_reference),
    "kept": lambda: Reader(".json", (ROW,), _read_kept),
}
READERS = tuple(_READERS)


def fault_of(kind: Reader, path: Path) -> str | None:
    """What is wrong with how a file is read; None where it is read or refused in one line."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            kind.read(path)
    except InputError as error:
        told = str(error)
        if not told.isprintable() or len(told) > LONGEST + len(str(path)):
            return f"refusal of {len(told)} characters: {told[:200]!r}"
    except Exception:
        return traceback.format_exc()
    return None


# --- the long run ---------------------------------------------------------------------------------


def content_of(name: str, seed: int, number: int) -> bytes:
    """Input of a number."""
    return reader(name).spoilt(random.Random(f"{name} {seed} {number}"))


def _read_batch(name: str, seed: int, numbers: range, path: Path, at: mmap.mmap) -> None:
    """Read inputs in this process, and print what is found."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    for limit in (signal.SIGPROF, signal.SIGALRM):
        faulthandler.register(limit, sys.stdout, chain=True)  # tell the place, and end
    kind, seen = reader(name), set[str]()
    for number in numbers:
        at[:8] = number.to_bytes(8, "little")
        path.write_bytes(content_of(name, seed, number))
        signal.setitimer(signal.ITIMER_PROF, SECONDS)
        signal.setitimer(signal.ITIMER_REAL, PATIENCE)
        fault = fault_of(kind, path)
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        if fault is not None:
            at[8:16] = (int.from_bytes(at[8:16], "little") + 1).to_bytes(8, "little")
            if (short := " ".join(fault.split()[-12:])) not in seen and len(seen) < 20:
                seen.add(short)
                sys.stdout.write(f"{name} --seed {seed} --only {number}\n{fault}\n")
                sys.stdout.flush()


def _end(status: int) -> str:
    """How a process ended that should not have."""
    if not os.WIFSIGNALED(status):
        return f"ended with {os.waitstatus_to_exitcode(status)}"
    if os.WTERMSIG(status) in (signal.SIGPROF, signal.SIGALRM):
        return "never comes to an end"
    return f"ended by {signal.Signals(os.WTERMSIG(status)).name}"


def run(name: str, count: int, seed: int, first: int = 0) -> int:
    """Read inputs, a batch a process; the number of findings."""
    begun, findings, number = time.process_time(), 0, first
    reader(name)
    folder = "/dev/shm" if Path("/dev/shm").is_dir() else None
    with tempfile.TemporaryDirectory(dir=folder) as place, mmap.mmap(-1, 16) as at:
        path = Path(place) / f"file{reader(name).suffix}"
        while number < first + count:
            numbers = range(number, min(number + BATCH, first + count))
            at[:16] = bytes(16)
            child = os.fork()
            if child == 0:
                try:
                    _read_batch(name, seed, numbers, path, at)
                except BaseException:  # a fault of ours; the folder is the parent's to clear away
                    traceback.print_exc()
                    os._exit(1)
                os._exit(0)
            _, status = os.waitpid(child, 0)
            number = numbers.stop
            findings += int.from_bytes(at[8:16], "little")
            if status != 0:
                number = int.from_bytes(at[:8], "little") + 1
                findings += 1
                sys.stdout.write(f"{name} --seed {seed} --only {number - 1}: {_end(status)}\n")
                sys.stdout.flush()
    times = os.times()
    seconds = time.process_time() - begun + times.children_user + times.children_system
    sys.stdout.write(f"{name}: {count} inputs, {findings} findings, {seconds:.0f} s\n")
    sys.stdout.flush()
    return findings


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("reader", choices=[*READERS, "all"])
    parser.add_argument("--count", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--only", type=int)
    asked = parser.parse_args()
    if asked.only is not None:
        content = content_of(asked.reader, asked.seed, asked.only)
        sys.stdout.buffer.write(content + b"\n")
        sys.exit(run(asked.reader, 1, asked.seed, asked.only) > 0)
    names = READERS if asked.reader == "all" else (asked.reader,)
    sys.exit(sum(run(name, asked.count, asked.seed) for name in names) > 0)


if __name__ == "__main__":
    main()
