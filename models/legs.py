"""Routes as sets of legs, the way arc models see them."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise

from fiveroute.routes import Route

__all__ = ["Leg", "legs_of", "route_along"]

Leg = tuple[int, int]
"""From one vertex to the next."""


def legs_of(route: Route, destination: int) -> list[Leg]:
    """Legs of a route, from the start to the destination."""
    return list(pairwise((0, *route, destination)))


def route_along(legs: Iterable[Leg], destination: int) -> Route:
    """The route that follows the legs from the start; cycles apart from it are ignored."""
    following = dict(legs)
    route = []
    vertex = following[0]
    while vertex != destination:
        route.append(vertex)
        vertex = following[vertex]
    return tuple(route)
