from dataclasses import replace
from html.parser import HTMLParser

from fiveroute.fleet_planning import plan as plan_fleet
from fiveroute.formats.plan_file import PlanFile
from fiveroute.instance import Fleet, Instance, Ocean, Point
from fiveroute.view.notebook import plan_html


def tags(html: str) -> list[str]:
    found: list[str] = []

    class Tags(HTMLParser):
        def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
            found.append(tag)
            assert not {"style", "src", "href", "onerror"} & {name for name, _ in attrs}

    Tags().feed(html)
    return found


def test_cell_shows_map_and_fleet(plan: PlanFile) -> None:
    html = plan_html(plan)
    assert tags(html).count("polyline") == 2
    assert tags(html).count("circle") == 7
    assert tags(html).count("tr") == 3
    assert "9 collected, feasible, bound 10, gap 11.11%" in html


def test_the_map_follows_the_paths(plan: PlanFile) -> None:
    """The first leg bends, so that AUV 1 has a corner more than stops."""
    corners = [line.partition('"')[0].count(",") for line in plan_html(plan).split('points="')]
    assert corners[2:] == [5, 3]
    assert tags(plan_html(replace(plan, paths=None))).count("polyline") == 2


def test_a_mission_shows_itself(plan: PlanFile) -> None:
    html = plan.instance._repr_html_()
    assert "4 nodes, data 10, 2 AUVs, 1 m/s, 2:30:00, currents, 2 zones" in html
    assert tags(html).count("polygon") == 1
    assert tags(html).count("circle") == 7
    assert not {"script", "img", "polyline"} & set(tags(html))
    own = replace(plan.instance, fleet=Fleet(None, 0.5, None), ocean=Ocean())
    assert "AUVs to be estimated, 0.5 m/s, unlimited<" in own._repr_html_()


def test_names_stay_text(plan: PlanFile) -> None:
    assert not {"script", "img"} & set(tags(plan_html(plan)))


def test_a_plan_of_a_fleet_shows_itself(plan: PlanFile) -> None:
    planned = plan_fleet(replace(plan.instance, name="still"), seed=1)
    assert planned._repr_html_().startswith("<div><b>still</b>")


def test_mission_without_a_plan_says_so() -> None:
    far = Instance("far", (), Point(0.0, 0.0), Point(9.0, 0.0), Fleet(1, 1.0, 1.0))
    assert plan_fleet(far)._repr_html_() == "<div><b>far</b>: infeasible</div>"


def test_long_lists_are_cut(plan: PlanFile) -> None:
    many = replace(plan, routes=((),) * 60, durations=(1.0,) * 60, paths=None)
    html = plan_html(many)
    assert tags(html).count("tr") == 52
    assert "and 10 more" in html


def test_plan_of_an_empty_map() -> None:
    lonely = Instance("lonely", (), Point(5.0, 5.0), Point(5.0, 5.0), Fleet(1, 1.0, 1.0))
    assert "nan" not in plan_fleet(lonely)._repr_html_()
