from dataclasses import replace

import pytest

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
    Vortex,
)
from fiveroute.result import Result
from fiveroute.routes import Plan
from fiveroute.sea.events import Event
from fiveroute.view.event_log import RunLog
from fiveroute.view.scene import Scene, scene_of

STILL = Instance(
    name="pond",
    nodes=(Node("a", 1000.0, 0.0, 2.0), Node("b", 2000.0, 500.0, 3.0), Node("c", 0.0, 900.0, 5.0)),
    start=Point(0.0, 0.0),
    destination=Point(4000.0, 0.0),
    fleet=Fleet(2, 1.0, 9000.0),
)

OCEAN = Ocean(
    currents=Currents(vortices=(Vortex(2000.0, 1000.0, 900.0, 700.0),)),
    obstacles=(Circle(3000.0, 1500.0, 200.0), Polygon(((1.0, 1.0), (9.0, 1.0), (5.0, 9.0)))),
    land=(Polygon(((-400.0, -900.0), (200.0, -900.0), (-100.0, -600.0))),),
)

LOG = RunLog(3, (Event(1000.0, 0, "collect", 1), Event(4000.0, 0, "arrive")))


def drawn(instance: Instance, runs: tuple[RunLog, ...] = ()) -> Scene:
    problem = instance.problem()
    result = Result.judged(problem, Plan.of([[1], [2]]), method="by-hand", seconds=0.1, bound=10.0)
    return scene_of(PlanFile.of(instance, problem, result), runs=runs)


@pytest.fixture(scope="session")
def pond() -> Scene:
    """Still water, two AUVs, a node each and one left over; a log in which one AUV sails."""
    return drawn(STILL, (LOG,))


@pytest.fixture(scope="session")
def bay() -> Scene:
    """The same with a vortex, obstacles and land."""
    return drawn(replace(STILL, ocean=OCEAN), (LOG,))
