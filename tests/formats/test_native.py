import json
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from fiveroute.errors import InputError
from fiveroute.formats import (
    currents_file,
    instance_hash,
    native,
    read_instance,
    write_instance,
)
from fiveroute.formats.native import relocated
from fiveroute.generate import paper_scenario
from fiveroute.instance import Currents, Instance, Node, Ocean

# The smallest document: one node, everything else left to its default.
SMALLEST: dict[str, Any] = {
    "format": "fiveroute-instance/1",
    "name": "smallest",
    "nodes": [{"id": "a", "x": 1, "y": 2.5, "data": 1}],
    "start": {"x": 0, "y": 0},
    "destination": {"x": 3, "y": 0},
    "fleet": {"size": 1, "speed": 1, "endurance": 50},
}


def read(**changes: Any) -> Instance:
    return native.read(json.dumps(SMALLEST | changes), "file")


def node(**changes: Any) -> dict[str, Any]:
    return {**SMALLEST["nodes"][0], **changes}


def fleet(**changes: Any) -> dict[str, Any]:
    return {**SMALLEST["fleet"], **changes}


def test_defaults() -> None:
    instance = read()
    assert instance.name == "smallest"
    assert instance.nodes == (Node("a", 1.0, 2.5, 1.0),)
    assert not instance.service_times.any()
    assert not instance.has_ocean


def test_every_key_is_read() -> None:
    ocean = {
        "currents": {
            "vortices": [{"x": 1, "y": 2, "circulation": -3, "radius": 4}],
            "uniform": {"u": 0.1, "v": -0.2},
            "file": "sea.nc",
        },
        "obstacles": [
            {"x": 1, "y": 2, "radius": 3},
            {"polygon": [[0, 0], [1, 0], [0, 1]]},
        ],
        "land": [{"polygon": [[0, 0], [1, 0], [0, 1]]}],
    }
    uncertainty = {"drift": 0.2, "manoeuvres_per_km": 0.5, "manoeuvre_time": 120, "floor": 0.1}
    instance = read(
        nodes=[node(service_time=9)],
        fleet=fleet(size=None, endurance=[1, 2]),
        service={"delay": 5, "rate": 20},
        ocean=ocean,
        uncertainty=uncertainty,
        crs=None,
        metric="explicit",
        travel_times=[[0, 1, 2], [3, 0, 4], [5, 6, 0]],
    )
    assert instance.fleet_size == 2
    assert instance.service_times.tolist() == [0.0, 9.0, 0.0]
    assert len(instance.ocean.obstacles) == 2
    assert instance.travel[2, 1] == 6.0
    assert native.read(native.write(instance), "") == instance


def test_layout_is_readable_and_stable() -> None:
    lines = native.write(paper_scenario(1)).splitlines()
    assert lines[:3] == ["{", '  "format": "fiveroute-instance/1",', '  "name": "scenario-01",']
    assert sum('"data"' in line for line in lines) == 60  # one node a line
    assert sum('"radius"' in line for line in lines) == 20
    keys = [found[1] for line in lines if (found := re.match(r'  "(\w+)"', line))]
    assert keys == [
        "format",
        "name",
        "nodes",
        "start",
        "destination",
        "fleet",
        "service",
        "ocean",
        "uncertainty",
        "crs",
    ]


def test_documented_example_is_what_we_write() -> None:
    text = (Path(__file__).parents[2] / "docs" / "formats.md").read_text(encoding="utf-8")
    found = re.search(r"```json\n(.*?)```", text, re.DOTALL)
    assert found is not None
    assert native.write(native.read(found[1], "")) == found[1]


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"nodes": [node(x=float("nan"))]}, r"nodes\[0\].x: nan: must be a finite number"),
        ({"nodes": [node(y=float("-inf"))]}, r"nodes\[0\].y: -inf: must be a finite number"),
        ({"nodes": [node(x=10**400)]}, r"nodes\[0\].x: 10+\.\.\.: must be a finite number"),
        ({"nodes": [node(x="5")]}, r"nodes\[0\].x: '5': must be a number; write it without"),
        ({"nodes": [node(x=True)]}, r"nodes\[0\].x: True: must be a valid number"),
        ({"nodes": [node(data=-1)]}, r"nodes\[0\].data: -1: must be greater than or equal to 0"),
        ({"nodes": [node(id=3)]}, r"nodes\[0\].id: 3: must be text; write it in quotes"),
        ({"nodes": [node(id="")]}, r"nodes\[0\].id: ''"),
        ({"nodes": [node(), node()]}, r"nodes\[1\].id: 'a': is the id of nodes\[0\] too"),
        (
            {"nodes": [node(servicetime=3)]},
            r"nodes\[0\].servicetime: .*did you mean 'service_time'",
        ),
        ({"nodes": [{}]}, r"nodes\[0\].id: is missing; .*\(faults after this one: 3\)"),
        ({"nodes": "abc"}, r"nodes: 'abc': must be a valid array"),
        ({"nodes": None}, r"nodes: must be a valid array"),
        ({"fleet": fleet(speed=0)}, r"fleet.speed: 0: must be greater than 0; correct"),
        ({"fleet": fleet(speed=-1)}, r"fleet.speed: -1: must be greater than 0"),
        ({"fleet": fleet(size=1.5)}, r"fleet.size: 1.5: must be a valid integer"),
        ({"fleet": fleet(size=10**9)}, r"fleet.size: 1000000000: must be less than"),
        ({"fleet": fleet(endurance=[1, -2])}, r"fleet.endurance\[1\]: -2: must be greater than 0"),
        ({"fleet": fleet(endurance=[])}, r"fleet.endurance: \[\]: must have at least 1 entries"),
        ({"fleet": fleet(endurance="5")}, r"fleet.endurance: '5': must be a number"),
        ({"fleet": fleet(size=3, endurance=[1, 2])}, r"fleet.size: 3: endurance has 2 entries"),
        (
            {"fleet": {"endurence": 5, "size": 1, "speed": 1}},
            r"fleet.endurence: .*mean 'endurance'",
        ),
        ({"nods": []}, r"nods: \[\]: is no key of this format; did you mean 'nodes'"),
        ({"zzz": 1}, r"zzz: 1: is no key of this format; known are crs, destination, fleet,"),
        ({"a\nb": 1}, r"\['a\\nb'\]: 1: is no key"),
        ({"ocean": {"obstacles": [{"polygon": [[0, 0]]}]}}, r"ocean.obstacles\[0\].polygon: .*3"),
        ({"ocean": {"obstacles": [{"radius": 3}]}}, r"ocean.obstacles\[0\].x: is missing"),
        ({"ocean": {"currents": {"vortex": []}}}, r"ocean.currents.vortex: .*mean 'vortices'"),
        ({"crs": "EPSG:4326"}, r"crs: 'EPSG:4326': only local metres"),
        ({"metric": "MAN_2D"}, r"metric: 'MAN_2D': must be 'euclidean', 'EUC_2D'"),
        (
            {"metric": "explicit", "travel_times": [[0, 1, 2]] * 2},
            r"travel_times: 2: must have 3 entries",
        ),
        (
            {"metric": "explicit", "travel_times": [[0, 1, 2], [1, 0, 2], [-1, 0, 1]]},
            r"travel_times\[2\]\[0\]: -1: must be greater than or equal to 0",
        ),
        ({"format": "fiveroute-plan/1"}, r"format: 'fiveroute-plan/1': .*fiveroute-instance/1"),
        ({"format": 1}, r"format: 1: is not the format of this file"),
    ],
)
def test_faults_are_named(changes: dict[str, Any], sentence: str) -> None:
    with pytest.raises(InputError, match=f"^{sentence}"):
        read(**changes)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (json.dumps(SMALLEST, indent=1)[:100], r"line \d: the JSON text ends too early; .*cut off"),
        ("{'format': 1}", r"line 1: is no JSON: .*column 2"),
        ("[1, 2]", "must be a JSON object"),
        ("{}", 'format: is missing; add "format"'),
        ("{} {}", "line 1: is no JSON: trailing characters"),
        ("nul", "line 1: "),
        ('{"format": 1' + "0" * 5000 + "}", "line 1: is no JSON: number out of range"),
        ("[" * 1_000_000, "line 1: the JSON text is nested too deeply"),
        ('{"a":' * 1_000_000, "line 1: the JSON text is nested too deeply"),
        (json.dumps(SMALLEST).replace("smallest", r"\ud800"), "line 1: is no JSON"),
        (json.dumps(SMALLEST).replace("2.5", "1e999"), r"nodes\[0\].y: inf: must be a finite"),
    ],
)
def test_what_is_no_document_is_refused(text: str, sentence: str) -> None:
    with pytest.raises(InputError, match=f"^{sentence}"):
        native.read(text, "file")


def test_missing_keys_are_named() -> None:
    for key in ("name", "nodes", "start", "destination", "fleet"):
        document = {name: value for name, value in SMALLEST.items() if name != key}
        with pytest.raises(InputError, match=f"^{key}: is missing; add this key"):
            native.read(json.dumps(document), "file")


def test_hash_knows_content_not_names_and_folders() -> None:
    instance = read()
    assert instance_hash(instance) == instance_hash(replace(instance, name="other"))
    assert instance_hash(instance) == instance_hash(read(crs=None))
    assert instance_hash(instance) != instance_hash(read(nodes=[node(data=2)]))
    assert instance_hash(instance) != instance_hash(read(nodes=[node(id="b")]))
    here, there, other = (
        read(ocean={"currents": {"file": file}}) for file in ("sea.nc", "../x/sea.nc", "lake.nc")
    )
    assert instance_hash(here) == instance_hash(there) != instance_hash(other)
    assert re.fullmatch("[0-9a-f]{64}", instance_hash(here))


def test_hash_does_not_move() -> None:
    """Plans are tied to their instances by it."""
    assert instance_hash(read()).startswith("676c255042221a31")


def with_currents(file: str | None) -> Instance:
    return replace(read(), ocean=Ocean(Currents(file=file)))


def test_depths_are_written_where_they_are_stated() -> None:
    plain = json.loads(native.write(read()))
    assert plain["nodes"][0].keys() == {"id", "x", "y", "data"}
    assert plain["fleet"].keys() == {"size", "speed", "endurance"}
    deep = read(nodes=[node(depth=12.5)], fleet=fleet(depth=0, depth_rating=90))
    document = json.loads(native.write(deep))
    assert document["nodes"][0]["depth"] == 12.5
    assert (document["fleet"]["depth"], document["fleet"]["depth_rating"]) == (0.0, 90.0)
    assert native.read(native.write(deep), "") == deep
    assert instance_hash(deep) != instance_hash(read())


def test_currents_file_is_relative_to_the_instance(tmp_path: Path) -> None:
    path = tmp_path / "instance.json"
    assert currents_file(with_currents("sea/a.nc"), path) == tmp_path / "sea" / "a.nc"
    assert currents_file(with_currents("/sea/a.nc"), path) == Path("/sea/a.nc")
    assert currents_file(with_currents(None), path) is None


def test_instance_keeps_its_currents_when_it_moves(tmp_path: Path) -> None:
    old, new = tmp_path / "old" / "instance.json", tmp_path / "new" / "deep" / "copy.json"
    moved = relocated(with_currents("sea/a.nc"), old, new)
    assert moved.ocean.currents.file == "../../old/sea/a.nc"
    for file in ("/sea/a.nc", None):
        assert relocated(with_currents(file), old, new) == with_currents(file)

    old.parent.mkdir()
    new.parent.mkdir(parents=True)
    write_instance(with_currents("sea/a.nc"), old)
    write_instance(read_instance(old), new, source=old)
    named = currents_file(read_instance(new), new)
    assert named is not None
    assert named.resolve() == (old.parent / "sea" / "a.nc").resolve()
