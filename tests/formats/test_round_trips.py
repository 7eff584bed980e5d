"""Any instance comes back from every format that can hold it."""

import json
from typing import get_args

from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.formats import chao, instance_hash, native, oplib, tsplib
from fiveroute.formats.plan_file import PlanFile
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
    Uncertainty,
    Uniform,
    Vortex,
)
from fiveroute.metric import Metric
from fiveroute.result import Status

REAL = st.floats(allow_nan=False, allow_infinity=False)
NON_NEGATIVE = st.floats(0.0, allow_nan=False, allow_infinity=False)
POSITIVE = st.floats(0.0, exclude_min=True, allow_nan=False, allow_infinity=False)
TEXT = st.text(st.characters(exclude_categories=["Cs"]))
NAME = st.text(st.characters(categories=["L", "N", "P", "S"]), min_size=1)
POINT = st.builds(Point, REAL, REAL)
POLYGON = st.builds(Polygon, st.lists(st.tuples(REAL, REAL), min_size=3, max_size=5).map(tuple))
WATER = settings(deadline=None, max_examples=60)


def tuples(elements: st.SearchStrategy, most: int = 3) -> st.SearchStrategy:
    return st.lists(elements, max_size=most).map(tuple)


OCEAN = st.builds(
    Ocean,
    currents=st.builds(
        Currents,
        vortices=tuples(st.builds(Vortex, REAL, REAL, REAL, POSITIVE)),
        uniform=st.none() | st.builds(Uniform, REAL, REAL),
        file=st.none() | TEXT.filter(bool),
    ),
    obstacles=tuples(st.builds(Circle, REAL, REAL, POSITIVE) | POLYGON),
    land=tuples(POLYGON),
)


@st.composite
def matrices(draw: st.DrawFn, size: int) -> tuple[tuple[float, ...], ...]:
    rows = st.lists(NON_NEGATIVE, min_size=size, max_size=size).map(tuple)
    return tuple(draw(st.lists(rows, min_size=size, max_size=size)))


@st.composite
def any_instances(draw: st.DrawFn) -> Instance:
    ids = draw(st.lists(TEXT.filter(bool), unique=True, max_size=5))
    nodes = tuple(
        Node(name, draw(REAL), draw(REAL), draw(NON_NEGATIVE), draw(st.none() | NON_NEGATIVE))
        for name in ids
    )
    size = draw(st.none() | st.integers(1, 4))
    each = st.lists(POSITIVE, min_size=size or 1, max_size=size or 4).map(tuple)
    metric = draw(st.sampled_from(get_args(Metric)))
    return Instance(
        name=draw(TEXT),
        nodes=nodes,
        start=draw(POINT),
        destination=draw(POINT),
        fleet=Fleet(size, draw(POSITIVE), draw(st.none() | POSITIVE | each)),
        service=draw(st.builds(Service, NON_NEGATIVE, NON_NEGATIVE)),
        ocean=draw(OCEAN),
        uncertainty=draw(
            st.builds(Uncertainty, NON_NEGATIVE, NON_NEGATIVE, NON_NEGATIVE, st.floats(0, 1))
        ),
        metric=metric,
        travel_times=draw(matrices(len(ids) + 2)) if metric == "explicit" else None,
    )


@st.composite
def numbered(draw: st.DrawFn, data: st.SearchStrategy[float]) -> tuple[Node, ...]:
    """Nodes with the ids that benchmark formats give them."""
    size = draw(st.integers(0, 5))
    return tuple(Node(str(i), draw(REAL), draw(REAL), draw(data)) for i in range(2, size + 2))


@st.composite
def closed_tours(draw: st.DrawFn, data: st.SearchStrategy[float], limited: bool) -> Instance:
    """What TSPLIB and OPLib can hold."""
    nodes = draw(numbered(data))
    metric = draw(st.sampled_from([metric for metric in get_args(Metric) if metric != "euclidean"]))
    times = None
    if metric == "explicit":
        inner = [list(row) for row in draw(matrices(len(nodes) + 1))]
        for i, row in enumerate(inner):
            row[i] = 0.0
        order = [*range(len(inner)), 0]
        times = tuple(tuple(inner[i][j] for j in order) for i in order)
    depot = draw(POINT)
    return Instance(
        name=draw(NAME),
        nodes=nodes,
        start=depot,
        destination=depot,
        fleet=Fleet(1, 1.0, draw(POSITIVE) if limited else None),
        metric=metric,
        travel_times=times,
    )


@given(instance=any_instances())
@WATER
def test_native(instance: Instance) -> None:
    text = native.write(instance)
    assert native.read(text, "") == instance
    assert native.write(native.read(text, "")) == text
    assert instance_hash(native.read(text, "")) == instance_hash(instance)


@given(instance=any_instances())
@WATER
def test_native_is_plain_json(instance: Instance) -> None:
    """Other programs read it with whatever parser they have."""
    document = json.loads(native.write(instance), parse_constant=lambda name: 1 / 0)
    assert [node["x"] for node in document["nodes"]] == [node.x for node in instance.nodes]
    assert document == json.loads(json.dumps(native.instance_document(instance)))


@given(
    nodes=numbered(NON_NEGATIVE),
    ends=st.tuples(POINT, POINT),
    size=st.integers(1, 9),
    limit=POSITIVE,
)
@WATER
def test_chao(nodes: tuple[Node, ...], ends: tuple[Point, Point], size: int, limit: float) -> None:
    instance = Instance("name", nodes, *ends, Fleet(size, 1.0, limit))
    assert chao.read(chao.write(instance), "name") == instance


@given(instance=closed_tours(st.just(1.0), limited=False))
@WATER
def test_tsplib(instance: Instance) -> None:
    assert tsplib.read(tsplib.write(instance), "") == instance


@given(instance=closed_tours(NON_NEGATIVE, limited=True))
@WATER
def test_oplib(instance: Instance) -> None:
    assert oplib.read(oplib.write(instance), "") == instance


@given(instance=any_instances(), data=st.data())
@WATER
def test_plan_of_any_routes(instance: Instance, data: st.DataObject) -> None:
    """Vertex numbers and names are two ways to say the same."""
    name = st.sampled_from([node.id for node in instance.nodes]) if instance.nodes else TEXT
    routes = data.draw(tuples(tuples(name | TEXT)))
    plan = PlanFile(
        instance, routes, (1.0,) * len(routes), 0.0, Status.FEASIBLE, None, "", None, ""
    )
    names = plan.vertex_names
    assert tuple(tuple(names[vertex] for vertex in route) for route in plan.plan.routes) == routes
