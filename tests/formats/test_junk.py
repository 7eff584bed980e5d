"""Whatever a file holds, it is read or refused in one line; nothing else happens."""

from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fiveroute.errors import InputError
from fiveroute.formats import FORMATS, PlanFile, native, read_instance, read_plan, write_plan
from fiveroute.instance import Circle, Fleet, Instance, Node, Ocean, Point, Polygon, Service
from fiveroute.result import Result
from fiveroute.routes import Plan

FULL = Instance(
    name="full",
    nodes=(Node("a", 1.0, 2.0, 0.5), Node("b", 3.0, 4.0, 1.5, service_time=2.0)),
    start=Point(0.0, 0.0),
    destination=Point(5.0, 5.0),
    fleet=Fleet(2, 1.5, (60.0, 50.0)),
    service=Service(1.0, 2.0),
    ocean=Ocean(
        obstacles=(Circle(1.0, 1.0, 0.5), Polygon(((0.0, 0.0), (1.0, 0.0), (0.0, 1.0)))),
    ),
)
TEXTS = {
    "native": native.write(FULL),
    "chao": "n 4\nm 2\ntmax 9.5\n0 0 0\n3\t4\t1\n5;6;2\n0 0 0\n",
    "tsplib": (
        "NAME : t\nTYPE : TSP\nDIMENSION : 3\nEDGE_WEIGHT_TYPE : EXPLICIT\n"
        "EDGE_WEIGHT_FORMAT : UPPER_ROW\nEDGE_WEIGHT_SECTION\n1 2\n3\nDISPLAY_DATA_SECTION\n"
        "1 0 0\n2 3 4\n3 1 1\nEOF\n"
    ),
    "oplib": (
        "NAME : o\nTYPE : OP\nDIMENSION : 2\nCOST_LIMIT : 9\nEDGE_WEIGHT_TYPE : GEO\n"
        "NODE_COORD_SECTION\n1 0 0\n2 3.5 -4\nNODE_SCORE_SECTION\n1 0\n2 1\nDEPOT_SECTION\n1\n-1\n"
    ),
}
PIECES = st.binary(max_size=12) | st.sampled_from(
    [b"-1", b"1e999", b"1e308", b"nan", b"NaN", b"null", b"{}", b"[]", b"[[", b'"', b"\n", b"EOF"]
)
QUIET = settings(
    deadline=None,
    max_examples=150,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)


@st.composite
def mutations(draw: st.DrawFn, original: bytes) -> bytes:
    """Up to four places cut out, doubled or written over, and perhaps the end cut off."""
    content = original
    for _ in range(draw(st.integers(1, 4))):
        start = draw(st.integers(0, len(content)))
        stop = draw(st.integers(start, min(start + 20, len(content))))
        kept = content[start:stop] if draw(st.booleans()) else b""
        content = content[:start] + kept + draw(PIECES) + kept + content[stop:]
    return content[: draw(st.integers(0, len(content)))] if draw(st.booleans()) else content


def must_be_read_or_refused(path: Path, format_name: str | None = None) -> None:
    refusal = ""
    try:
        instance = read_instance(path, format_name)
        instance.problem(instance.fleet_size or 1)
    except InputError as error:
        refusal = str(error)
    assert refusal.isprintable()
    assert len(refusal) < 500 + len(str(path))


@pytest.mark.parametrize("name", TEXTS)
@given(data=st.data())
@QUIET
def test_damaged_files(name: str, data: st.DataObject, tmp_path: Path) -> None:
    path = tmp_path / f"file{FORMATS[name].suffixes[0]}"
    path.write_bytes(data.draw(mutations(TEXTS[name].encode())))
    must_be_read_or_refused(path)


@pytest.mark.parametrize("name", FORMATS)
@given(content=st.binary() | st.text().map(lambda text: text.encode("utf-8", "replace")))
@QUIET
def test_junk(name: str, content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "file"
    path.write_bytes(content)
    must_be_read_or_refused(path)
    must_be_read_or_refused(path, name)


@pytest.mark.parametrize("name", TEXTS)
def test_truncations(name: str, tmp_path: Path) -> None:
    path = tmp_path / f"file{FORMATS[name].suffixes[0]}"
    whole = TEXTS[name]
    for length in range(0, len(whole), 1 + len(whole) // 200):
        path.write_text(whole[:length])
        must_be_read_or_refused(path)


@given(data=st.data())
@QUIET
def test_damaged_plans(data: st.DataObject, tmp_path: Path) -> None:
    path = tmp_path / "plan.json"
    if not path.exists():
        problem = FULL.problem()
        result = Result.judged(problem, Plan.of([[1], [2]]), method="by-hand", seconds=0.0)
        write_plan(PlanFile.of(FULL, problem, result), path)
    damaged = tmp_path / "damaged.json"
    damaged.write_bytes(data.draw(mutations(path.read_bytes())))
    refusal = ""
    try:
        read_plan(damaged)
    except InputError as error:
        refusal = str(error)
    assert refusal.isprintable()
