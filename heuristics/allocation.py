"""The allocations that the paper compares with: Voronoi, k-means and AHC.

Each one shares the nodes out among the AUVs by where they lie, and knows nothing of
times, data or budgets. What comes out is a set of nodes per AUV; `sub_routes` puts every
set into an order, as the segments of a giant route already are, so that all allocations
enter the same route tier.

References
----------
The paper cites Sun et al. (2022) for Voronoi diagrams, Abbasi et al. (2022, doi
10.1109/TASE.2020.3044155) for k-means and MahmoudZadeh et al. (2019) for agglomerative
hierarchical clustering; the parameters are ours. k-means++: D. Arthur, S. Vassilvitskii,
"k-means++: the advantages of careful seeding", SODA 2007.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from fiveroute.heuristics.insertion_route import insertion_route
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Route

__all__ = ["Generators", "Linkage", "hierarchical", "k_means", "sub_routes", "voronoi"]

Points = NDArray[np.float64]
Generators = Literal["random", "nodes", "ring", "lloyd"]
Linkage = Literal["average", "ward"]


def voronoi(
    points: Points, fleet_size: int, rng: np.random.Generator, generators: Generators = "random"
) -> tuple[Route, ...]:
    """Every AUV gets the nodes in the Voronoi cell of its generator.

    Parameters
    ----------
    points
        Positions of start, nodes and destination in metres, shape (n + 2, 2).
    fleet_size
        Number M of AUVs.
    rng
        Random numbers.
    generators
        ``random``: uniform in the bounding box of the nodes; ``nodes``: M of the nodes;
        ``ring``: M points on a circle about the middle of the box, its radius a quarter of
        the longer side; ``lloyd``: random ones moved to the centroids of their cells until
        they rest.

    Returns
    -------
    tuple of Route
        M sets of nodes, each in ascending order; a cell without nodes is empty.
    """
    nodes = points[1:-1]
    if not len(nodes):
        return ((),) * fleet_size
    low, high = nodes.min(axis=0), nodes.max(axis=0)
    match generators:
        case "nodes":
            sites = nodes[rng.choice(len(nodes), fleet_size, replace=fleet_size > len(nodes))]
        case "ring":
            angle = 2.0 * np.pi * (np.arange(fleet_size) / fleet_size + rng.random())
            radius = 0.25 * (high - low).max()
            sites = (low + high) / 2.0 + radius * np.column_stack((np.cos(angle), np.sin(angle)))
        case "random" | "lloyd":
            sites = rng.uniform(low, high, (fleet_size, 2))
    if generators == "lloyd":
        return _lloyd(nodes, sites)[0]
    return _sets(_nearest(nodes, sites), fleet_size)


def k_means(
    points: Points, fleet_size: int, rng: np.random.Generator, restarts: int = 10
) -> tuple[Route, ...]:
    """Clusters of least squared distance to their centroids, the best of several runs.

    Parameters
    ----------
    points, fleet_size, rng
        As in `voronoi`.
    restarts
        Number of runs, each from other k-means++ seeds.

    Returns
    -------
    tuple of Route
        M sets of nodes; some are empty where fewer positions than AUVs differ.
    """
    nodes = points[1:-1]
    if not len(nodes):
        return ((),) * fleet_size
    runs = [_lloyd(nodes, _plus_plus(nodes, fleet_size, rng)) for _ in range(restarts)]
    return min(runs, key=lambda run: run[1])[0]


def hierarchical(
    points: Points, fleet_size: int, linkage: Linkage = "average"
) -> tuple[Route, ...]:
    """Agglomerative hierarchical clustering (AHC), its tree cut into M clusters.

    Parameters
    ----------
    points, fleet_size
        As in `voronoi`.
    linkage
        Distance of two clusters: the mean over all pairs, or Ward's increase of variance.
    """
    nodes = points[1:-1]
    if len(nodes) < 2:
        return _sets(np.zeros(len(nodes), np.int64), fleet_size)
    from scipy.cluster import hierarchy
    from scipy.spatial.distance import pdist

    tree = hierarchy.linkage(pdist(nodes), method=linkage)
    return _sets(hierarchy.fcluster(tree, fleet_size, criterion="maxclust") - 1, fleet_size)


def sub_routes(problem: TeamOrienteering, sets: Sequence[Route]) -> tuple[Route, ...]:
    """Put every set of nodes into the order of a short route from start to destination."""
    return tuple(insertion_route(problem, nodes) for nodes in sets)


def _sets(labels: NDArray[np.integer[Any]], fleet_size: int) -> tuple[Route, ...]:
    return tuple(tuple((np.flatnonzero(labels == auv) + 1).tolist()) for auv in range(fleet_size))


def _nearest(nodes: Points, sites: Points) -> NDArray[np.int64]:
    from scipy.spatial.distance import cdist

    labels: NDArray[np.int64] = cdist(nodes, sites).argmin(axis=1)
    return labels


def _lloyd(nodes: Points, sites: Points) -> tuple[tuple[Route, ...], float]:
    """Move every site to the centroid of its cell until all rest; an empty one stays.

    Returns the cells and the sum of squared distances to the sites. (scipy's `kmeans2`
    neither stops by itself nor keeps quiet about empty cells.)
    """
    sites = sites.copy()
    labels = _nearest(nodes, sites)
    for _ in range(1000):
        for auv in np.unique(labels):
            sites[auv] = nodes[labels == auv].mean(axis=0)
        before, labels = labels, _nearest(nodes, sites)
        if (labels == before).all():
            break
    return _sets(labels, len(sites)), float(((nodes - sites[labels]) ** 2).sum())


def _plus_plus(nodes: Points, count: int, rng: np.random.Generator) -> Points:
    """k-means++ seeds: each next one a node drawn by its squared distance to the last ones."""
    sites = [nodes[rng.integers(len(nodes))]]
    nearest = np.full(len(nodes), np.inf)
    while len(sites) < count:
        nearest = np.minimum(nearest, ((nodes - sites[-1]) ** 2).sum(axis=1))
        total = nearest.sum()
        weights = nearest / total if total > 0.0 else None
        sites.append(nodes[rng.choice(len(nodes), p=weights)])
    return np.array(sites)
