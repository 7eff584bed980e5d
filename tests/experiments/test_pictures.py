import numpy as np
from matplotlib.lines import Line2D

from fiveroute.experiments.pictures import (
    Panel,
    completion_boxes,
    gap_profile,
    route_panels,
)
from fiveroute.instance import Fleet, Instance, Node, Point

LINE = Instance(
    name="line",
    nodes=tuple(Node(str(i), 1000.0 * i, 0.0, 0.5) for i in (1, 2, 3)),
    start=Point(0.0, 0.0),
    destination=Point(4000.0, 0.0),
    fleet=Fleet(2, 1.0, 9000.0),
)


def test_a_map_draws_every_route_and_marks_the_ends() -> None:
    (axis,) = route_panels(LINE, [Panel("both", ((1, 2), (3,)))]).axes
    first, second, start, destination = axis.lines
    assert [np.array(line.get_xdata()).tolist() for line in (first, second)] == [
        [0, 1, 2, 4],
        [0, 3, 4],
    ]
    assert (start.get_marker(), destination.get_marker()) == ("^", "*")
    assert axis.get_title() == "both"


def test_open_ends_leave_the_outer_legs_out() -> None:
    (axis,) = route_panels(LINE, [Panel("open", ((1, 2),), open_ends=True)]).axes
    assert np.array(axis.lines[0].get_xdata()).tolist() == [1, 2]


def test_idle_nodes_are_hollow() -> None:
    (axis,) = route_panels(LINE, [Panel("", ((2,), ()))]).axes
    visited, idle = axis.collections
    assert [len(np.array(c.get_offsets())) for c in (visited, idle)] == [1, 2]


def test_an_instance_without_nodes_can_be_drawn() -> None:
    empty = Instance(LINE.name, (), LINE.start, LINE.destination, LINE.fleet)
    assert len(route_panels(empty, [Panel("", ((), ()))]).axes) == 1


def test_boxes_mark_the_published_mean_where_there_is_one() -> None:
    figure = completion_boxes("t", {"a": [0.1, 0.2, 0.3], "b": [0.5, 0.6, 0.7]}, {"b": 0.65})
    diamonds = [line for line in figure.axes[0].lines if line.get_marker() == "D"]
    heights = [np.array(line.get_ydata()).tolist() for line in diamonds]
    assert [height for height in heights if height] == [[0.65]]


def share_at(line: Line2D, place: float) -> float:
    x, y = np.array(line.get_xdata()), np.array(line.get_ydata())
    return float(y[x <= place][-1])


def test_a_profile_climbs_to_the_share_that_is_reached() -> None:
    figure = gap_profile({"a": [0.0, 0.5, 0.01], "b": [1.0, 0.0, 0.0]}, [])
    (axis,) = figure.axes
    a, b = axis.lines
    assert [a.get_label(), b.get_label()] == ["a", "b"]
    assert [share_at(a, x) for x in (0.0, 0.9, 1.0, 50.0)] == [1 / 3, 1 / 3, 2 / 3, 1.0]
    assert [share_at(b, x) for x in (0.0, 99.0, 100.0)] == [2 / 3, 2 / 3, 1.0]


def test_what_was_not_proved_counts_in_the_share_over_time() -> None:
    _, axis = gap_profile({"exact": [0.0, 0.0]}, [3.0, None, 1.0, None]).axes
    (line,) = axis.lines
    assert [share_at(line, t) for t in (1.0, 2.9, 3.0, 6.0)] == [0.25, 0.25, 0.5, 0.5]


def test_a_profile_of_nothing_is_empty() -> None:
    (axis,) = gap_profile({}, [None]).axes
    assert len(axis.lines) == 0
