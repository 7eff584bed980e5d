"""Sweeps: their rows, their marks, and what an interruption leaves."""

import pytest

from fiveroute.decide.sweep import Row, Sweep, Value, seen_columns, shown, vary
from fiveroute.limits import Limits


def row(value: float, limits: Limits) -> Row:
    return {"square": value * value, "left": limits.time}


def test_a_row_a_value() -> None:
    sweep = vary("sea", "speed", "m/s", [1.0, -3.0, 2.0], row, clock=Limits().start())
    assert [r["speed"] for r in sweep.rows] == [1.0, -3.0, 2.0]
    best = sweep.best("square")
    assert best is not None
    assert best["speed"] == -3.0
    assert sweep.marking(2.0, "why not").marked == 2.0


def test_the_time_that_is_left_is_shared() -> None:
    sweep = vary("sea", "speed", "", [1.0, 2.0], row, clock=Limits(100.0).start())
    first, second = (r["left"] for r in sweep.rows)
    assert isinstance(first, float)
    assert isinstance(second, float)
    assert 40.0 < first <= 50.0 < second <= 100.0


def test_an_interruption_leaves_what_is_done() -> None:
    limits = Limits()

    def interrupted(value: float, given: Limits) -> Row:
        limits.interrupt.set()
        return row(value, given)

    sweep = vary("sea", "speed", "", [1.0, 2.0, 3.0], interrupted, clock=limits.start())
    assert len(sweep.rows) == 1
    assert sweep.left_out == (2.0, 3.0)


def test_a_row_that_is_cut_short_is_left_out() -> None:
    limits = Limits()

    def interrupted(value: float, given: Limits) -> Row:
        if value == 2.0:
            limits.interrupt.set()
        return row(value, given)

    sweep = vary("sea", "speed", "", [1.0, 2.0, 3.0], interrupted, clock=limits.start())
    assert [r["speed"] for r in sweep.rows] == [1.0]
    assert sweep.left_out == (2.0, 3.0)


def test_missing_figures_are_no_best() -> None:
    assert Sweep("sea", "speed", "", ({"speed": 1.0, "gap": None},)).best("gap") is None


def test_of_equals_the_cheapest_is_the_best() -> None:
    rows: tuple[Row, ...] = tuple(
        {"data": data, "time": time} for data, time in ((1.0, 5.0), (2.0, 9.0), (2.0, 7.0))
    )
    sweep = Sweep("sea", "data", "", rows)
    assert sweep.best("data") == rows[1]
    assert sweep.best("data", least="time") == rows[2]


def test_nodes_out_of_reach_are_shown_where_there_are_any() -> None:
    rows: list[Row] = [{"speed": 1.0, "unreachable": 0}, {"speed": 2.0, "unreachable": 3}]
    assert seen_columns(Sweep("sea", "speed", "", (rows[0],))) == ["speed"]
    assert seen_columns(Sweep("sea", "speed", "", tuple(rows))) == ["speed", "unreachable"]


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("bound_rate", None, "-"),
        ("completion_rate", 0.5603, "56.0 %"),
        ("held_out_cvar", 1.0, "100.0 %"),
        ("gap", 1e12, "endless"),
        ("mean_duration", 17797.0, "4:56:37"),
        ("departure", "2015-11-16T06:30:00", "2015-11-16 06:30"),
        ("speed", 1.2, "1.2"),
        ("status", "optimal", "optimal"),
    ],
)
def test_figures_for_people(name: str, value: Value, words: str) -> None:
    assert shown(name, value) == words


def test_a_notebook_shows_the_table() -> None:
    rows: tuple[Row, ...] = ({"fleet_size": 1, "gap": None}, {"fleet_size": 2, "gap": 0.123456})
    html = Sweep("<sea>", "fleet_size", "", rows, marked=2, because="the <best>")._repr_html_()
    assert "<b>&lt;sea&gt;</b>: the &lt;best&gt;<table>" in html
    assert "<th>AUVs</th><th>gap</th>" in html
    assert "<tr><td>1</td><td>-</td></tr><tr><th>2</th><th>12.3 %</th></tr>" in html
    assert "<tr></tr>" in Sweep("sea", "speed", "", ())._repr_html_()
