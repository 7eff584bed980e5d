"""The studio in a real browser."""

import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from fiveroute.formats import read_instance, read_plan
from fiveroute.studio.server import Studio

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
    """The page of a studio, and everything it complained about."""

    def __init__(self, browser: Any, studio: Studio, **options: Any) -> None:
        self.complaints: list[str] = []
        self.asked: list[str] = []
        context = browser.new_context(viewport={"width": 1280, "height": 860}, **options)
        self.page = context.new_page()
        self.page.set_default_timeout(20_000)
        self.page.on("console", self._hear)
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("request", lambda request: self.asked.append(request.url))
        self.home = f"http://{studio.hosts[0]}/"
        self.page.goto(studio.url)
        self.expect("#plan-state").to_contain_text("no plan")

    def _hear(self, message: Any) -> None:
        if not message.text.startswith("Failed to load resource"):  # a refusal, shown in words
            self.complaints.append(message.text)

    def expect(self, selector: str) -> Any:
        return playwright.expect(self.page.locator(selector))

    def place(self, x: float, y: float) -> tuple[float, float]:
        """Where a position in metres is on the screen, while everything is shown."""
        west, south, east, north = self.region
        box = self.page.locator(".pane canvas").bounding_box()
        scale = min(box["width"] / (east - west), box["height"] / (north - south))
        return (
            box["x"] + box["width"] / 2 + scale * (x - (west + east) / 2),
            box["y"] + box["height"] / 2 - scale * (y - (south + north) / 2),
        )

    def fit(self, studio: Studio) -> None:
        """Show everything, and know where it is."""
        self.page.click("#fit")
        self.region = studio.session.told()["view"]["scenes"][0]["region"]

    def drag(self, begin: tuple[float, float], end: tuple[float, float]) -> None:
        mouse = self.page.mouse
        mouse.move(*begin)
        mouse.down()
        mouse.move((begin[0] + end[0]) / 2, (begin[1] + end[1]) / 2)
        mouse.move(*end)
        mouse.up()

    def close(self) -> None:
        self.page.context.close()
        assert self.complaints == []
        assert [url for url in self.asked if not url.startswith(self.home)] == []


def plan(visit: Visit) -> str:
    """Plan anew until the plan is there, and tell the gap."""
    visit.page.click("#plan")
    visit.expect("#plan-state").to_have_text("The plan is up to date.", timeout=60_000)
    return str(visit.page.inner_text("#gap-now"))


def test_a_day_at_the_studio(browser: Any, studio: Studio, mission_path: Path) -> None:
    visit = Visit(browser, studio)
    page, session = visit.page, studio.session
    page.click("#how")
    page.select_option("#bound-kind", "none")
    visit.fit(studio)
    assert plan(visit) == "unknown"
    page.select_option("#bound-kind", "exact")
    assert plan(visit) == "0 (proved)"
    visit.expect("#gap-words").to_contain_text("5 planned of 9; no plan can collect more than 5")

    # Drag the far node near: the draft has no bound until it is planned.
    visit.fit(studio)
    visit.drag(visit.place(1000.0, 2600.0), visit.place(1400.0, 250.0))
    visit.expect("#plan-state").to_contain_text("older than the mission")
    visit.expect("#gap-now").to_have_text("unknown")
    visit.expect("#stop-title").to_have_text("Node far")
    visit.expect("#stop-place").to_contain_text("44.002")
    node = session.version.instance.nodes[2]
    assert (node.x, node.y) == pytest.approx((1400.0, 250.0), abs=15.0)
    plan(visit)
    visit.expect("#gap-words").to_contain_text("9 planned of 9")

    # One AUV more, by the button; data by the form; a node by a click and one by a key.
    page.click("#more")
    visit.expect("#fleet-size").to_have_value("2")
    page.fill("#stop-data", "6.5")
    page.press("#stop-data", "Enter")
    visit.expect("#gap-words").to_contain_text("of 11.5")
    page.click("#add")
    page.mouse.click(*visit.place(600.0, 600.0))
    visit.expect("#stop-title").to_have_text("Node n4")
    page.keyboard.press("n")
    visit.expect("#stop-title").to_have_text("Node n5")
    page.keyboard.press("Delete")
    visit.expect("#stop-title").to_have_text("Stops")
    visit.expect("#gap-words").to_contain_text("of 14.5")  # the server has heard of it as well
    assert [node.id for node in session.version.instance.nodes] == ["a", "b", "far", "n4"]
    plan(visit)

    # Save: the mission's own file is overwritten only after a question.
    page.click("#tab-files")
    page.click("#save-both")
    page.click("#ask-no")
    assert len(read_instance(mission_path).nodes) == 3
    page.click("#save-both")
    page.click("#ask-yes")
    visit.expect("#toast").to_contain_text("Saved bay.json and bay-plan.json")
    saved = read_plan(mission_path.with_name("bay-plan.json"), read_instance(mission_path))
    assert saved.objective == session.version.filed.objective

    # Undo everything, redo something.
    for _ in range(6):
        page.keyboard.press("Control+z")
    visit.expect("#undo").to_be_disabled()
    assert len(session.version.instance.nodes) == 3
    page.click("#tab-edit")
    visit.expect("#gap-words").to_contain_text("5 planned of 9; no plan can collect more than 5")
    page.click("#redo")
    visit.expect("#gap-words").to_contain_text("9 planned of 9")
    visit.close()


def test_errors_stand_on_the_page(browser: Any, studio: Studio, mission_path: Path) -> None:
    visit = Visit(browser, studio, color_scheme="dark")
    page = visit.page
    for field, text, sentence in [
        ("#fleet-size", "two", "AUVs: 'two' is no number"),
        ("#fleet-size", "0", "edit.fleet.size: 0: must be greater than or equal to 1"),
        ("#speed-water", "-1", "edit.fleet.speed: -1: must be greater than 0"),
        ("#endurance", "10, 20, 30", "endurance has 3 entries"),
    ]:
        before = page.input_value(field)
        page.fill(field, text)
        page.press(field, "Enter")
        visit.expect("#toast").to_contain_text(sentence)
        visit.expect(field).to_have_value(before)
    assert studio.session.version.instance == read_instance(mission_path)

    plan(visit)
    page.click("#tab-files")
    page.fill("#export-name", "../out")
    page.click("#export")
    visit.expect("#toast").to_contain_text("is no plain file name")
    page.select_option("#export-format", "qgc")
    page.fill("#export-name", "out")
    page.click("#export")
    visit.expect("#toast").to_contain_text("enter a depth in metres")
    page.fill("#export-depth", "10")
    page.click("#export")
    visit.expect("#toast").to_contain_text("Exported out: auv-1")
    assert [path.suffix for path in (mission_path.parent / "out").iterdir()] == [".plan"]

    page.select_option("#export-format", "csv")
    page.click("#export-more")
    for field, wrong, sentence, right in [
        ("#export-auv", "2", "is no AUV of the plan", "1"),
        ("#export-vehicles", "ann, bea", "must be given 1 times", "ann"),
        ("#export-departure", "noon", "departure: 'noon'", "2016-01-31T12:00"),
        ("#export-tolerance", "wide", "Tolerance: 'wide' is no number", "0.5"),
    ]:
        page.fill(field, wrong)
        page.click("#export")
        visit.expect("#toast").to_contain_text(sentence)
        page.fill(field, right)
    page.click("#export")
    visit.expect("#toast").to_contain_text("Exported out.csv: ann.")
    assert "2016-01-31T12:00:00Z" in (mission_path.parent / "out.csv").read_text(encoding="utf-8")
    visit.close()


def test_it_plans_by_itself_after_an_edit(browser: Any, studio: Studio) -> None:
    visit = Visit(browser, studio)
    page = visit.page
    page.check("#auto")
    page.click("#more")
    visit.expect("#plan-state").to_have_text("The plan is up to date.", timeout=60_000)
    assert studio.session.version.filed.objective == 5.0
    visit.close()


def test_without_the_secret_there_is_nothing_to_see(browser: Any, studio: Studio) -> None:
    page = browser.new_page()
    page.goto(f"http://{studio.hosts[0]}/")
    assert "lacks the secret" in page.inner_text("body")
    page.close()
