from dataclasses import replace
from typing import Any

import pytest

from fiveroute.errors import InputError
from fiveroute.formats.expressible import (
    require_closed,
    require_plain,
    single_endurance,
    spelled,
)
from fiveroute.instance import (
    Currents,
    Fleet,
    Instance,
    Node,
    Ocean,
    Point,
    Service,
    Uncertainty,
    Uniform,
)

# Nothing in it that a benchmark format would not know.
PLAIN = Instance("plain", (Node("2", 1.0, 0.0, 1.0),), Point(0, 0), Point(0, 0), Fleet(1, 1.0, 9.0))


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"service": Service(delay=5.0)}, "service: Chao files know no service times"),
        ({"nodes": (Node("2", 1.0, 0.0, 1.0, service_time=5.0),)}, "no service times"),
        ({"ocean": Ocean(Currents(uniform=Uniform(0.1, 0.0)))}, "ocean: Chao files know no curr"),
        ({"uncertainty": Uncertainty(drift=0.2)}, "uncertainty: Chao files know no uncertainty"),
        ({"fleet": Fleet(1, 2.0, 9.0)}, "fleet.speed: Chao files know no speed other than 1"),
        ({"nodes": (Node("2", 1.0, 0.0, 1.0, depth=5.0),)}, "nodes: Chao files know no depths"),
        ({"fleet": Fleet(1, 1.0, 9.0, depth=0.0)}, "fleet: Chao files know no depths"),
        ({"fleet": Fleet(1, 1.0, 9.0, depth_rating=5.0)}, "fleet: Chao files know no depths"),
    ],
)
def test_more_than_benchmarks_know_is_refused(changes: dict[str, Any], words: str) -> None:
    require_plain(PLAIN, "Chao")
    with pytest.raises(InputError, match=words):
        require_plain(replace(PLAIN, **changes), "Chao")


def test_closed_tours_of_one_auv() -> None:
    require_closed(PLAIN, "OPLib")
    require_closed(replace(PLAIN, fleet=Fleet(None, 1.0, 9.0)), "OPLib")
    with pytest.raises(InputError, match="one vehicle only"):
        require_closed(replace(PLAIN, fleet=Fleet(2, 1.0, 9.0)), "OPLib")
    with pytest.raises(InputError, match="closed tours only"):
        require_closed(replace(PLAIN, destination=Point(1.0, 0.0)), "OPLib")


def test_endurance_must_be_the_same_for_all() -> None:
    assert single_endurance(PLAIN, "Chao") == 9.0
    assert single_endurance(replace(PLAIN, fleet=Fleet(None, 1.0, (7.0, 7.0))), "Chao") == 7.0
    for endurance in (None, (7.0, 8.0)):
        with pytest.raises(InputError, match="need one endurance"):
            single_endurance(replace(PLAIN, fleet=Fleet(None, 1.0, endurance)), "Chao")


def test_numbers_are_short_and_exact() -> None:
    values = {3.0: "3", 0.1: "0.1", -0.5: "-0.5", 1e300: "1e+300", 1 / 3: "0.3333333333333333"}
    assert {value: spelled(value) for value in values} == values
    assert spelled(-0.0) == "-0"
