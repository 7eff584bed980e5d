"""TSPLIB files of the symmetric and the asymmetric travelling salesman problem.

A file without profits becomes an instance whose nodes all hold data 1: one AUV of speed 1
and unlimited endurance starts and ends at node 1, and its best plan collects everything.
The other nodes keep their numbers as ids. Distances follow the rule that the file states
and are times; ``DISPLAY_DATA_SECTION`` gives positions where distances are explicit, and
without it all positions are 0.

We read these files ourselves: vrplib 2.2 leaves EUC_2D distances unrounded, knows neither
GEO nor ATT nor UPPER_ROW nor the DIAG formats, and does not say in which line a fault is.

References
----------
G. Reinelt, "TSPLIB 95", Universitaet Heidelberg, 1995.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import cast

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.formats.expressible import require_closed, require_plain, spelled
from fiveroute.formats.keyword_file import KeywordFile, parse
from fiveroute.instance import Fleet, Instance, Node, Point
from fiveroute.metric import Metric

__all__ = ["KEYS", "SECTIONS", "Network", "network", "network_lines", "read", "write"]

Matrix = NDArray[np.float64]

KEYS = (
    "NAME",
    "TYPE",
    "DIMENSION",
    "EDGE_WEIGHT_TYPE",
    "EDGE_WEIGHT_FORMAT",
    "NODE_COORD_TYPE",
    "DISPLAY_DATA_TYPE",
)
SECTIONS = ("NODE_COORD_SECTION", "EDGE_WEIGHT_SECTION", "DISPLAY_DATA_SECTION")

_METRICS = ("EUC_2D", "CEIL_2D", "GEO", "ATT")
_UPPER = ("UPPER_ROW", "UPPER_DIAG_ROW", "LOWER_COL", "LOWER_DIAG_COL")
_LOWER = ("LOWER_ROW", "LOWER_DIAG_ROW", "UPPER_COL", "UPPER_DIAG_COL")
_FORMAT = "TSPLIB"


@dataclass(frozen=True, slots=True)
class Network:
    """Nodes of a keyword file, the depot first.

    Parameters
    ----------
    points
        Positions, shape (n + 1, 2).
    metric
        How they become distances.
    times
        Explicit distances, shape (n + 1, n + 1); None where the metric gives them.
    """

    points: Matrix
    metric: Metric
    times: Matrix | None

    def instance(self, name: str, data: Matrix, endurance: float | None) -> Instance:
        """Closed tours of one AUV from the first node.

        Parameters
        ----------
        name
            Name of the instance.
        data
            Data of every node, shape (n + 1,). A depot that has data is a sensor node too:
            every tour collects it without any detour.
        endurance
            Time limit; None is unlimited.
        """
        visited = [i for i in range(len(data)) if i > 0 or data[0] > 0.0]
        stops = [0, *visited, 0]
        depot = Point(*self.points[0].tolist())
        x, y = self.points.T.tolist()
        return Instance(
            name=name,
            nodes=tuple(Node(str(i + 1), x[i], y[i], float(data[i])) for i in visited),
            start=depot,
            destination=depot,
            fleet=Fleet(1, 1.0, endurance),
            metric=self.metric,
            travel_times=None
            if self.times is None
            else tuple(map(tuple, self.times[np.ix_(stops, stops)].tolist())),
        )


def read(text: str, name: str) -> Instance:
    """Read an instance.

    Parameters
    ----------
    text
        Content of the file.
    name
        Name of the instance if the file states none.
    """
    file = parse(text, KEYS, SECTIONS)
    kind = file.choice("TYPE", ("TSP", "ATSP"), default="TSP")
    nodes = network(file)
    if kind == "TSP" and nodes.times is not None:
        _require_symmetric(nodes.times)
    data = np.ones(len(nodes.points))
    data[0] = 0.0
    return nodes.instance(file.name(name), data, None)


def write(instance: Instance) -> str:
    """Write an instance; its ids, unless they are line numbers, are lost.

    Raises
    ------
    InputError
        If the instance has anything that the format cannot hold.
    """
    require_plain(instance, _FORMAT)
    require_closed(instance, _FORMAT)
    if instance.fleet.endurance is not None:
        raise InputError(
            "TSPLIB files know no endurance; write OPLib or the native format",
            field="fleet.endurance",
            value=instance.fleet.endurance,
        )
    for i, node in enumerate(instance.nodes):
        if node.data != 1.0:
            raise InputError(
                "TSPLIB files know no data, only 1 a node; write OPLib or the native format",
                field=f"nodes[{i}].data",
                value=node.data,
            )
    symmetric = instance.travel_times is None or np.array_equal(instance.travel, instance.travel.T)
    kind = "TSP" if symmetric else "ATSP"
    return "\n".join([*network_lines(instance, kind), "EOF", ""])


def network(file: KeywordFile) -> Network:
    """The nodes of a file and what is between them."""
    kind = file.choice("EDGE_WEIGHT_TYPE", (*_METRICS, "EXPLICIT"))
    file.choice("NODE_COORD_TYPE", ("TWOD_COORDS", "NO_COORDS"), default="TWOD_COORDS")
    if kind != "EXPLICIT":
        points = file.table("NODE_COORD_SECTION", ("x", "y"))
        return Network(points, cast(Metric, kind), None)
    times = _matrix(file)
    shown = [key for key in ("DISPLAY_DATA_SECTION", "NODE_COORD_SECTION") if key in file.sections]
    points = file.table(shown[0], ("x", "y")) if shown else np.zeros((len(times), 2))
    return Network(points, "explicit", times)


def network_lines(instance: Instance, kind: str, *extra: str) -> list[str]:
    """Header and sections of the nodes of an instance with start = destination.

    Parameters
    ----------
    instance
        The instance.
    kind
        The value of TYPE.
    extra
        More lines of the header.
    """
    if instance.name != instance.name.strip() or not instance.name.isprintable():
        raise InputError("must be one line of text; rename it", field="name", value=instance.name)
    if instance.metric == "euclidean":
        raise InputError(
            "TSPLIB's distances are whole numbers; write Chao's or the native format",
            field="metric",
            value=instance.metric,
        )
    explicit = instance.travel_times is not None
    header = [
        f"NAME : {instance.name}",
        f"TYPE : {kind}",
        f"DIMENSION : {len(instance.nodes) + 1}",
        *extra,
        f"EDGE_WEIGHT_TYPE : {'EXPLICIT' if explicit else instance.metric}",
    ]
    points = instance.points[:-1]
    if not explicit:
        return [*header, "NODE_COORD_SECTION", *_table_lines(points)]
    matrix = instance.travel
    _require_closed_times(matrix)
    lines = [*header, "EDGE_WEIGHT_FORMAT : FULL_MATRIX", "EDGE_WEIGHT_SECTION"]
    lines += [" ".join(map(spelled, row)) for row in matrix[:-1, :-1].tolist()]
    if points.any():
        lines += ["DISPLAY_DATA_SECTION", *_table_lines(points)]
    return lines


def _table_lines(points: Matrix) -> list[str]:
    return [f"{i} {spelled(x)} {spelled(y)}" for i, (x, y) in enumerate(points.tolist(), start=1)]


def _matrix(file: KeywordFile) -> Matrix:
    """The matrix of an EDGE_WEIGHT_SECTION, its diagonal zero."""
    form = file.choice("EDGE_WEIGHT_FORMAT", ("FULL_MATRIX", *_UPPER, *_LOWER))
    size = file.dimension
    weights = file.weights("EDGE_WEIGHT_SECTION")
    diagonal = "DIAG" in form
    expected = size * size if form == "FULL_MATRIX" else size * (size - 1 + 2 * diagonal) // 2
    if len(weights) != expected:
        raise InputError(
            f"must be {expected} for DIMENSION {size} and {form}; the file may be cut off",
            field="numbers in EDGE_WEIGHT_SECTION",
            value=len(weights),
        )
    if form == "FULL_MATRIX":
        matrix = weights.reshape(size, size)
    else:
        matrix = np.zeros((size, size))
        if form in _UPPER:
            matrix[np.triu_indices(size, 0 if diagonal else 1)] = weights
        else:
            matrix[np.tril_indices(size, 0 if diagonal else -1)] = weights
        matrix += matrix.T
    np.fill_diagonal(matrix, 0.0)
    return matrix


def _require_symmetric(times: Matrix) -> None:
    differ = np.argwhere(times != times.T)
    if len(differ):
        i, j = (int(k) for k in differ[0])
        raise InputError(
            f"the way from {i + 1} to {j + 1} takes {times[i, j]:g}, back {times[j, i]:g}; "
            "correct it, or say TYPE : ATSP",
            field="EDGE_WEIGHT_SECTION",
        )


def _require_closed_times(times: Matrix) -> None:
    """Start and destination must be one node."""
    ends = times[[0, -1]][:, [0, -1]]
    if ends.any() or not (
        np.array_equal(times[0], times[-1]) and np.array_equal(times[:, 0], times[:, -1])
    ):
        raise InputError(
            "of start and destination differ, but a closed tour has one depot; "
            "write the native format",
            field="travel_times",
        )
