"""Sweeps: their rows, their marks, and what an interruption leaves."""

from fiveroute.decide.sweep import Row, Sweep, vary
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


def test_missing_figures_are_no_best() -> None:
    assert Sweep("sea", "speed", "", ({"speed": 1.0, "gap": None},)).best("gap") is None


def test_a_notebook_shows_the_table() -> None:
    rows: tuple[Row, ...] = ({"fleet_size": 1, "gap": None}, {"fleet_size": 2, "gap": 0.123456})
    html = Sweep("<sea>", "fleet_size", "", rows, marked=2, because="the <best>")._repr_html_()
    assert "<b>&lt;sea&gt;</b>: the &lt;best&gt;<table>" in html
    assert "<th>fleet size</th><th>gap</th>" in html
    assert "<tr><td>1</td><td>-</td></tr><tr><th>2</th><th>0.1235</th></tr>" in html
    assert "<tr></tr>" in Sweep("sea", "speed", "", ())._repr_html_()
