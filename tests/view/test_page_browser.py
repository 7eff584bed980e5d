"""The page in a real browser that has no network."""

import math
import re
import shutil
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from fiveroute.formats.plan_file import PlanFile
from fiveroute.instance import Fleet, Instance, Node, Point, Service
from fiveroute.result import Result
from fiveroute.routes import Plan
from fiveroute.view.event_log import read_events
from fiveroute.view.page import page_of
from fiveroute.view.scene import Scene, scene_of

playwright = pytest.importorskip("playwright.sync_api", reason="needs Playwright")
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")

pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="needs a Chromium browser")


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    playwright.expect.set_options(timeout=20_000)
    with playwright.sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield browser
        browser.close()


class Visit:
    """A page opened without a network, and everything it complained about."""

    def __init__(self, browser: Any, path: Path, **options: Any) -> None:
        self.complaints: list[str] = []
        self.asked: list[str] = []
        context = browser.new_context(
            viewport={"width": 1280, "height": 800}, offline=True, **options
        )
        context.route("**/*", self._decide)
        self.page = context.new_page()
        self.page.set_default_timeout(20_000)
        self.page.on("console", lambda message: self.complaints.append(message.text))
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("dialog", lambda dialog: self.complaints.append(dialog.message))
        self.page.goto(path.as_uri())
        playwright.expect(self.page.locator("#clock")).to_contain_text("/")

    def _decide(self, route: Any) -> None:
        if route.request.url.startswith("file:"):
            route.continue_()
        else:
            self.asked.append(route.request.url)
            route.abort()

    def text(self, selector: str) -> str:
        return str(self.page.inner_text(selector))

    def set_time(self, share: float) -> None:
        self.page.evaluate(
            """(share) => {
              const slider = document.getElementById("time");
              slider.value = share * slider.max;
              slider.dispatchEvent(new Event("input"));
            }""",
            share,
        )
        self.settle()

    def settle(self) -> None:
        self.page.evaluate(
            "() => new Promise((go) => requestAnimationFrame(() => requestAnimationFrame(go)))"
        )

    def pixels(self, place: int = 0) -> str:
        """The map as it is drawn."""
        self.settle()
        script = "(k) => document.querySelectorAll('.pane canvas')[k].toDataURL()"
        return str(self.page.evaluate(script, place))

    def middle(self) -> tuple[float, float]:
        """The middle of the map on the screen."""
        box = self.page.locator(".pane canvas").bounding_box()
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def close(self) -> None:
        self.page.context.close()
        assert self.complaints == []
        assert self.asked == []


def written(scenes: list[Scene], folder: Path) -> Path:
    path = folder / "page.html"
    path.write_text(page_of(scenes), encoding="utf-8")
    return path


@pytest.fixture
def scene(plan: PlanFile, log_path: Path) -> Scene:
    return scene_of(plan, runs=read_events(log_path, plan))


def test_click_through(browser: Any, scene: Scene, tmp_path: Path) -> None:
    visit = Visit(browser, written([scene], tmp_path), color_scheme="light")
    page = visit.page
    assert page.title().startswith("bay </script>")
    assert page.text_content("#title") == scene.instance.name

    # The clock: slider, play, speed, keys.
    page.select_option(".pane select", "0 1")
    visit.set_time(0.5)
    assert visit.text("#clock") == "0:41:40 / 1:23:20"
    before = visit.pixels()
    page.select_option("#speed", "1200")
    page.click("#play")
    assert page.get_attribute("#play", "aria-label") == "Pause"
    playwright.expect(page.locator("#clock")).to_have_text("1:23:20 / 1:23:20")
    playwright.expect(page.locator("#play")).to_have_attribute("aria-label", "Play")
    assert visit.pixels() != before
    assert "5 of 10" in visit.text(".figures")
    page.keyboard.press("Home")
    visit.settle()
    assert visit.text("#clock").startswith("0:00:00")
    page.locator(".pane canvas").focus()
    page.keyboard.press("ArrowRight")
    visit.settle()
    assert visit.text("#clock").startswith("0:00:50")
    page.keyboard.press("]")
    visit.settle()
    assert "AUV 1 has collected a" in visit.text("#said")

    # The map: wheel, drag, keys, fit.
    whole = visit.pixels()
    page.mouse.move(400, 400)
    page.mouse.wheel(0, -400)
    near = visit.pixels()
    assert near != whole
    page.mouse.down()
    page.mouse.move(460, 420, steps=3)
    page.mouse.up()
    assert visit.pixels() != near
    page.keyboard.press("f")
    page.mouse.move(1270, 790)
    assert visit.pixels() == whole
    page.keyboard.press("+")
    assert visit.pixels() != whole
    page.keyboard.press("-")
    page.keyboard.press("Shift+ArrowUp")
    assert visit.pixels() != whole

    # Colours, help.
    assert page.get_attribute("html", "data-theme") == "light"
    page.keyboard.press("d")
    assert page.get_attribute("html", "data-theme") == "dark"
    page.keyboard.press("?")
    assert page.is_visible("#keys")
    page.click("#keys button")
    assert not page.is_visible("#keys")
    visit.close()


def test_tables_tell_what_happens(browser: Any, scene: Scene, tmp_path: Path) -> None:
    visit = Visit(browser, written([scene], tmp_path))
    page = visit.page
    page.select_option(".pane select", "0 1")
    page.keyboard.press("End")
    visit.set_time(1.0)
    fleet = visit.text("#panel-fleet")
    assert "1:23:20" in fleet
    assert "never" in fleet

    page.click("#tab-nodes")
    head = page.locator("#panel-nodes th").nth(1)
    names = page.locator("#panel-nodes tbody td:first-child")
    head.locator("button").click()
    assert head.get_attribute("aria-sort") == "ascending"
    assert names.all_inner_texts()[0] == "d"
    head.locator("button").click()
    assert head.get_attribute("aria-sort") == "descending"
    shown = names.all_inner_texts()
    assert shown[0] == "c"
    assert "</script><img src=x onerror=alert(1)>&" in shown[1]
    page.locator("#panel-nodes tbody tr").first.click()
    assert page.locator("#panel-nodes tr.marked").count() == 1

    # A node out of sight is brought into it.
    page.locator(".pane canvas").focus()
    for _ in range(20):
        page.keyboard.press("Shift+ArrowLeft")
    away = visit.pixels()
    page.locator("#panel-nodes tbody tr").nth(2).click()
    assert visit.pixels() != away
    page.mouse.move(*visit.middle())
    assert "data 2" in visit.text("#tip")

    page.click("#tab-events")
    rows = page.locator("#events .event")
    assert rows.count() == 12
    said = rows.all_inner_texts()
    assert "AUV 1 sends award to AUV 2 (68 bits)" in said[4]
    assert "AUV 2 hears award of AUV 1 after 1.0 s" in said[5]
    assert "AUV 2 sends report to all, lost (50 bits)" in said[6]
    assert rows.nth(6).evaluate("(row) => row.classList.contains('lost')")
    page.get_by_label("messages").uncheck()
    assert rows.count() == 9
    rows.filter(has_text="drops").click()
    visit.settle()
    assert visit.text("#clock").startswith("0:19:10")
    assert page.locator("#events .now").inner_text().startswith("0:19:10")

    page.click("#tab-key")
    assert "nobody has picked it up" in visit.text("#panel-key")
    page.get_by_label("arrows of the current").uncheck()
    visit.close()


@pytest.fixture(scope="module")
def crowd() -> PlanFile:
    """A plan of one route among five thousand nodes."""
    nodes = tuple(Node(f"n{k}", 20.0 * k, 7.0 * (k % 50), 1.0 + k % 3) for k in range(1, 5001))
    far = Instance("crowd", nodes, Point(0.0, 0.0), Point(1e5, 0.0), Fleet(1, 1.0, 1e6), Service())
    problem = far.problem()
    return PlanFile.of(
        far, problem, Result.judged(problem, Plan.of([[1, 2]]), method="", seconds=0)
    )


def test_a_table_of_thousands_makes_the_rows_in_sight_only(
    browser: Any, crowd: PlanFile, tmp_path: Path
) -> None:
    visit = Visit(browser, written([scene_of(crowd)], tmp_path))
    page = visit.page
    page.click("#tab-nodes")
    rows = page.locator("#panel-nodes tbody tr")
    panel = page.locator("#panel-nodes")

    def first_in_sight() -> str:
        """The node under the heads."""
        script = """(panel) => {
          const head = panel.querySelector("th").getBoundingClientRect();
          const cell = document.elementFromPoint(head.left + 9, head.bottom + 9);
          return cell.closest("tr").cells[0].textContent;
        }"""
        visit.settle()
        return str(panel.evaluate(script))

    assert rows.count() < 60
    assert page.get_attribute("#panel-nodes table", "aria-rowcount") == "5001"
    assert first_in_sight() == "n1"
    height = panel.evaluate("(panel) => panel.scrollHeight")
    assert height > 5000 * 20
    for share in (0.25, 0.5, 1.0):
        panel.evaluate("(panel, share) => { panel.scrollTop = share * panel.scrollHeight; }", share)
        assert int(first_in_sight()[1:]) == pytest.approx(5000 * share, abs=40)
        assert rows.count() < 60
        assert panel.evaluate("(panel) => panel.scrollHeight") == height
    assert rows.last.inner_text().startswith("n5000")
    assert rows.last.get_attribute("aria-rowindex") == "5001"
    visit.close()


def test_a_long_table_can_be_walked_by_keys(browser: Any, crowd: PlanFile, tmp_path: Path) -> None:
    visit = Visit(browser, written([scene_of(crowd)], tmp_path))
    page = visit.page
    page.click("#tab-nodes")

    def focused() -> str:
        visit.settle()
        script = "() => document.activeElement.closest('tr').cells[0].textContent"
        return str(page.evaluate(script))

    page.locator("#panel-nodes th button").last.focus()
    page.keyboard.press("Tab")
    assert focused() == "n1"
    for key, node in [
        ("ArrowDown", "n2"),
        ("ArrowUp", "n1"),
        ("ArrowUp", "n1"),
        ("End", "n5000"),
        ("ArrowUp", "n4999"),
        ("Home", "n1"),
        ("ArrowDown", "n2"),
    ]:
        page.keyboard.press(key)
        assert focused() == node
    page.keyboard.press("PageDown")
    assert int(focused()[1:]) > 10
    clock = visit.text("#clock")
    page.keyboard.press("Enter")
    assert page.locator("#panel-nodes tr.marked").count() == 1
    assert visit.text("#clock") == clock

    # Sorted by data, what is marked stays so; a row that the wheel takes out of sight leaves the
    # focus to the panel.
    page.locator("#panel-nodes th button").nth(1).click()
    assert page.locator("#panel-nodes tbody tr").first.inner_text().startswith("n3\t1")
    page.locator("#panel-nodes tbody tr").first.focus()
    page.locator("#panel-nodes").evaluate("(panel) => { panel.scrollTop = 50_000; }")
    visit.settle()
    assert page.evaluate("() => document.activeElement.id") == "panel-nodes"
    visit.close()


def test_what_is_marked_on_the_map_comes_into_sight_in_the_table(
    browser: Any, crowd: PlanFile, tmp_path: Path
) -> None:
    visit = Visit(browser, written([scene_of(crowd)], tmp_path))
    page = visit.page
    page.click("#tab-nodes")
    x, y = visit.middle()
    page.mouse.click(x, y)
    visit.settle()
    marked = page.locator("#panel-nodes tr.marked")
    assert 2000 < int(marked.inner_text().split()[0][1:]) < 3000
    assert marked.evaluate(
        """(row) => {
          const own = row.getBoundingClientRect();
          const box = row.closest("#panel-nodes").getBoundingClientRect();
          return own.top > box.top && own.bottom <= box.bottom;
        }"""
    )
    visit.close()


def test_messages_are_links_while_they_are_fresh(
    browser: Any, scene: Scene, tmp_path: Path
) -> None:
    """A line from sender to receiver at its time; a broken one in the colour of alarm if lost."""
    visit = Visit(browser, written([scene], tmp_path), color_scheme="light")
    page = visit.page
    page.select_option(".pane select", "0 1")
    page.select_option("#speed", "30")
    page.click("#tab-key")
    page.get_by_label("names of nodes").uncheck()

    def reds() -> int:
        """Pixels in the colour of alarm."""
        script = """() => {
          const copy = document.createElement("canvas");
          const shown = document.querySelector(".pane canvas");
          [copy.width, copy.height] = [shown.width, shown.height];
          const context = copy.getContext("2d", { willReadFrequently: true });
          context.drawImage(shown, 0, 0);
          const { data } = context.getImageData(0, 0, copy.width, copy.height);
          let count = 0;
          for (let k = 0; k < data.length; k += 4) {
            count += data[k] === 193 && data[k + 1] === 18 && data[k + 2] === 31;
          }
          return count;
        }"""
        visit.settle()
        return int(page.evaluate(script))

    def at(seconds: float) -> str:
        visit.set_time(seconds / 5000.0)
        return visit.pixels()

    def without_events(seconds: float) -> str:
        box = page.get_by_label("events", exact=True)
        box.uncheck()
        shown = at(seconds)
        box.check()
        return shown

    assert at(1210.0) != without_events(1210.0)
    at(1210.0)
    assert reds() == 0
    at(1250.5)
    assert reds() > 20
    at(1290.0)
    assert reds() == 0
    visit.close()


def test_two_plans_side_by_side(browser: Any, plan: PlanFile, scene: Scene, tmp_path: Path) -> None:
    other = scene_of(replace(plan, paths=None), title="other")
    visit = Visit(browser, written([scene, other], tmp_path), color_scheme="dark")
    page = visit.page
    assert page.locator(".pane").count() == 2
    assert page.get_attribute("html", "data-theme") == "dark"
    boths = [visit.pixels(0), visit.pixels(1)]
    page.mouse.move(300, 400)
    page.mouse.wheel(0, -300)
    assert all(visit.pixels(k) != boths[k] for k in (0, 1))
    page.select_option("#which", "1")
    assert "plan as filed" in visit.text("#subtitle")
    page.click("#compare")
    assert page.locator(".pane").count() == 1
    page.keyboard.press("c")
    assert page.locator(".pane").count() == 2
    visit.close()


def test_hover_and_pinch(browser: Any, scene: Scene, tmp_path: Path) -> None:
    visit = Visit(browser, written([scene], tmp_path), has_touch=True)
    page = visit.page
    box = page.locator(".pane canvas").bounding_box()
    page.mouse.move(box["x"] + 40, box["y"] + box["height"] / 2)
    assert "m/s to" in visit.text("#tip")
    assert "° N" not in visit.text("#tip")  # nobody says where on Earth it is
    before = visit.pixels()
    client = page.context.new_cdp_session(page)
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def touch(kind: str, reach: float) -> None:
        points = [{"x": x - reach, "y": y, "id": 0}, {"x": x + reach, "y": y, "id": 1}]
        shown = [] if kind == "touchEnd" else points
        client.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": shown})

    touch("touchStart", 50)
    touch("touchMove", 90)
    touch("touchMove", 130)
    touch("touchEnd", 0)
    assert visit.pixels() != before
    visit.close()


def test_a_place_on_earth_is_told(browser: Any, plan: PlanFile, tmp_path: Path) -> None:
    sea = replace(plan.instance, crs="+proj=aeqd +lat_0=60.5 +lon_0=-4.75")
    visit = Visit(browser, written([scene_of(replace(plan, instance=sea))], tmp_path))
    box = visit.page.locator(".pane canvas").bounding_box()
    visit.page.mouse.move(box["x"] + 40, box["y"] + box["height"] / 2)
    assert re.search(r"60\.\d{5}° N, 4\.\d{5}° W", visit.text("#tip"))
    visit.close()


def test_every_control_has_a_name(browser: Any, scene: Scene, tmp_path: Path) -> None:
    visit = Visit(browser, written([scene], tmp_path))
    nameless = visit.page.evaluate(
        """() => [...document.querySelectorAll("button, select, input, canvas[tabindex]")]
          .filter((control) => !(control.textContent.trim() || control.ariaLabel
            || control.getAttribute("aria-label") || (control.labels && control.labels.length)))
          .map((control) => control.outerHTML)"""
    )
    assert nameless == []
    visit.close()


def test_a_hundred_thousand_points_play(browser: Any, plan: PlanFile, tmp_path: Path) -> None:
    many = 100_000
    wave = tuple((4000.0 * k / many, 300.0 * math.sin(k / 900.0)) for k in range(1, many))
    paths = ((((0.0, 0.0), *wave, (4000.0, 0.0)),), (((0.0, 0.0), (4000.0, 0.0)),))
    long = replace(plan, routes=((), ()), paths=paths)
    visit = Visit(browser, written([scene_of(long)], tmp_path))
    visit.set_time(0.5)
    half = visit.pixels()
    visit.set_time(0.75)
    assert visit.pixels() != half
    visit.close()


def test_going_back_in_time_draws_what_was_there(
    browser: Any, scene: Scene, tmp_path: Path
) -> None:
    """Nodes are drawn again only where they change; backwards they must change back."""
    visit = Visit(browser, written([scene], tmp_path))
    shots = []
    for time in (0.2, 0.6, 0.2, 0.6):
        visit.set_time(time)
        shots.append(visit.pixels())
    assert shots[0] == shots[2] != shots[1]
    visit.close()


def test_a_rested_map_is_what_is_drawn_from_scratch(
    browser: Any, plan: PlanFile, tmp_path: Path
) -> None:
    """Long routes move as a picture with the camera; at rest they are as if it had always been."""
    many = 4000
    saw = tuple((4000.0 * k / many, 300.0 * (-1) ** k) for k in range(1, many))
    paths = ((((0.0, 0.0), *saw, (4000.0, 0.0)),), (((0.0, 0.0), (4000.0, 0.0)),))
    visit = Visit(
        browser, written([scene_of(replace(plan, routes=((), ()), paths=paths))], tmp_path)
    )
    page = visit.page
    visit.set_time(0.5)
    canvas = page.locator(".pane canvas")
    for zoom in (-40, 60):
        # turn the wheel until a frame was drawn in between
        canvas.evaluate(
            """async (canvas, deltaY) => {
              do {
                const place = { clientX: 300, clientY: 300, cancelable: true };
                canvas.dispatchEvent(new WheelEvent("wheel", { deltaY, ...place }));
                await new Promise((go) => requestAnimationFrame(go));
              } while (canvas.getAttribute("aria-busy") !== "true");
            }""",
            zoom,
        )
        playwright.expect(canvas).to_have_attribute("aria-busy", "false")
        rested = visit.pixels()
        page.keyboard.press("d")
        assert visit.pixels() != rested
        page.keyboard.press("d")
        assert visit.pixels() == rested
    visit.close()


def test_paper_is_light_and_shows_the_map_whole(browser: Any, scene: Scene, tmp_path: Path) -> None:
    visit = Visit(browser, written([scene], tmp_path), color_scheme="dark")
    page = visit.page
    page.evaluate("() => dispatchEvent(new Event('beforeprint'))")
    assert page.get_attribute("html", "data-theme") == "light"
    page.emulate_media(media="print")
    assert not page.is_visible(".transport")
    shape = "(canvas) => [canvas.clientWidth / canvas.clientHeight, canvas.width / canvas.height]"
    shown, drawn = page.locator(".pane canvas").evaluate(shape)
    assert shown == pytest.approx(drawn, rel=0.01)
    page.emulate_media(media="screen")
    page.evaluate("() => dispatchEvent(new Event('afterprint'))")
    assert page.get_attribute("html", "data-theme") == "dark"
    visit.close()


def test_a_phone_shows_nothing_cut_off(browser: Any, scene: Scene, tmp_path: Path) -> None:
    visit = Visit(browser, written([scene], tmp_path))
    visit.page.set_viewport_size({"width": 390, "height": 844})
    visit.settle()
    wide = """() => [...document.querySelectorAll("body *")]
      .filter((one) => one.getBoundingClientRect().right > 391 && !one.closest("[role=tabpanel] *"))
      .map((one) => one.id || one.className || one.tagName)"""
    assert visit.page.evaluate(wide) == []
    controls = "#play, #before, #after, #clock, #speed"
    tops = visit.page.locator(controls).evaluate_all(
        """(all) => all.map((one) => {
          const { top, bottom } = one.getBoundingClientRect();
          return (top + bottom) / 2;
        })"""
    )
    assert max(tops) - min(tops) < 5
    visit.close()


def test_policy_stops_markup_that_gets_in(browser: Any, scene: Scene, tmp_path: Path) -> None:
    """Even if a text became markup, its script would not run."""
    visit = Visit(browser, written([scene], tmp_path))
    visit.page.evaluate(
        """() => {
          const intruder = document.createElement("div");
          intruder.innerHTML = "<img src='data:,' onerror='window.hacked = true'>";
          document.body.append(intruder);
          const script = document.createElement("script");
          script.textContent = "window.hacked = true";
          document.body.append(script);
        }"""
    )
    visit.settle()
    assert visit.page.evaluate("() => window.hacked === undefined")
    assert any("Content Security Policy" in complaint for complaint in visit.complaints)
