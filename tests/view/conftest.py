import json
from dataclasses import replace
from pathlib import Path

import pytest

from fiveroute.formats.plan_file import PlanFile, write_plan
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
    Vortex,
)
from fiveroute.result import Result
from fiveroute.routes import Plan

HOSTILE = "</script><img src=x onerror=alert(1)>&\u2028"

SEA = Instance(
    name=f"bay {HOSTILE}",
    nodes=(
        Node("a", 1000.0, 0.0, 2.0),
        Node(HOSTILE, 2000.0, 500.0, 3.0),
        Node("c", 1500.0, 2000.0, 4.0),
        Node("d", 2500.0, -900.0, 1.0),
    ),
    start=Point(0.0, 0.0),
    destination=Point(4000.0, 0.0),
    fleet=Fleet(2, 1.0, 9000.0),
    service=Service(delay=60.0),
    ocean=Ocean(
        currents=Currents(vortices=(Vortex(2000.0, 1000.0, 900.0, 700.0),)),
        obstacles=(Circle(3000.0, 1500.0, 200.0),),
        land=(Polygon(((-400.0, -900.0), (200.0, -900.0), (-100.0, -600.0))),),
    ),
)

AWARD = {"number": 0, "kind": "award", "sender": 0, "receiver": 1, "bits": 68}
HEARD = [{"auv": 1, "t": 1201.0}]
REPORT = {"number": 1, "kind": "report", "sender": 1, "receiver": None, "bits": 50}

EVENTS = [
    {"run": 1, "t": 0.0, "auv": 0, "kind": "depart"},
    {"run": 1, "t": 0.0, "auv": 1, "kind": "depart"},
    {"run": 1, "t": 1100.0, "auv": 0, "kind": "collect", "node": "a"},
    {"run": 1, "t": 1150.0, "auv": 0, "kind": "discard", "node": HOSTILE},
    {"run": 1, "t": 1200.0, "auv": 0, "kind": "send", "message": AWARD | {"heard": HEARD}},
    {"run": 1, "t": 1201.0, "auv": 1, "kind": "receive", "message": AWARD},
    {"run": 1, "t": 1250.0, "auv": 1, "kind": "send", "message": REPORT | {"heard": []}},
    {"run": 1, "t": 1300.0, "auv": 1, "kind": "manoeuvre"},
    {"run": 1, "t": 1400.0, "auv": 1, "kind": "pick_up", "node": HOSTILE},
    {"run": 1, "t": 2700.0, "auv": 1, "kind": "collect", "node": HOSTILE},
    {"run": 1, "t": 3500.0, "auv": 1, "kind": "fail"},
    {"run": 1, "t": 5000.0, "auv": 0, "kind": "arrive"},
    {"run": 0, "t": 9300.0, "auv": 0, "kind": "arrive"},
]


@pytest.fixture(scope="session")
def plan() -> PlanFile:
    """Two AUVs and four nodes, one on no route; the first leg is bent."""
    problem = SEA.problem()
    result = Result.judged(
        problem, Plan.of([[1, 2], [3]]), method="by-hand", seconds=0.1, bound=10.0, seed=7
    )
    straight = PlanFile.of(SEA, problem, result)
    paths = (
        (
            ((0.0, 0.0), (500.0, 200.0), (1000.0, 0.0)),
            ((1000.0, 0.0), (2000.0, 500.0)),
            ((2000.0, 500.0), (4000.0, 0.0)),
        ),
        (((0.0, 0.0), (1500.0, 2000.0)), ((1500.0, 2000.0), (4000.0, 0.0))),
    )

    return replace(straight, paths=paths)


@pytest.fixture
def plan_path(plan: PlanFile, tmp_path: Path) -> Path:
    path = tmp_path / "plan.json"
    write_plan(plan, path)
    return path


@pytest.fixture
def log_path(tmp_path: Path) -> Path:
    path = tmp_path / "events.jsonl"
    path.write_text("".join(json.dumps(event) + "\n" for event in EVENTS), encoding="utf-8")
    return path
