"""Routes as sets of legs and back."""

import pytest

from fiveroute.models.legs import legs_of, route_along


@pytest.mark.parametrize("route", [(), (3,), (2, 1, 3)])
def test_there_and_back(route: tuple[int, ...]) -> None:
    assert route_along(reversed(legs_of(route, 4)), 4) == route


def test_cycles_apart_from_the_route_are_ignored() -> None:
    assert route_along([(2, 3), (0, 1), (3, 2), (1, 4)], 4) == (1,)
