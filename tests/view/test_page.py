import base64
import hashlib
import json
import re
from html.parser import HTMLParser
from pathlib import Path

from fiveroute.formats.plan_file import PlanFile
from fiveroute.view.page import SCRIPTS, page_of
from fiveroute.view.scene import scene_of

ASSETS = Path(__file__).parents[2] / "fiveroute" / "view" / "assets"


class Elements(HTMLParser):
    """Tags with their attributes, and the text within each of the page's blocks."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.texts: dict[int, str] = {}
        self.is_open = False
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))
        self.is_open = True

    def handle_endtag(self, tag: str) -> None:
        self.is_open = False

    def handle_data(self, data: str) -> None:
        if self.is_open:
            place = len(self.tags) - 1
            self.texts[place] = self.texts.get(place, "") + data

    def blocks(self, tag: str) -> list[str]:
        return [self.texts[k] for k, (name, _) in enumerate(self.tags) if name == tag]


def test_policy_allows_the_pages_own_style_and_script_only(plan: PlanFile) -> None:
    page = Elements(page_of([scene_of(plan)]))
    policy = next(
        attributes["content"]
        for tag, attributes in page.tags
        if tag == "meta" and attributes.get("http-equiv") == "Content-Security-Policy"
    )
    assert policy is not None
    assert policy.startswith("default-src 'none';")
    assert "unsafe" not in policy
    _, script = page.blocks("script")
    (style,) = page.blocks("style")
    for kind, text in (("script-src", script), ("style-src", style)):
        digest = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
        assert f"{kind} 'sha256-{digest}'" in policy


def test_names_stay_text(plan: PlanFile) -> None:
    text = page_of([scene_of(plan)])
    page = Elements(text)
    assert "img" not in {tag for tag, _ in page.tags}
    assert [tag for tag, _ in page.tags].count("script") == 2
    data, _ = page.blocks("script")
    ids = json.loads(data)["scenes"][0]["ids"]
    assert ids == [node.id for node in plan.instance.nodes]
    assert "<img src=x" in ids[1]


def test_page_asks_for_nothing(plan: PlanFile) -> None:
    page = Elements(page_of([scene_of(plan)]))
    for _, attributes in page.tags:
        for name in ("src", "href", "action", "style"):
            assert (attributes.get(name) or "data:,") == "data:,"
    code = "".join((ASSETS / name).read_text() for name in (*SCRIPTS, "page.css"))
    forbidden = r"innerHTML|outerHTML|insertAdjacent|document\.write|eval\(|Function\(|fetch\(|"
    assert not re.search(forbidden + r"XMLHttp|WebSocket|import\(|url\(|@import", code)


def test_all_scripts_are_in_the_page() -> None:
    assert sorted(SCRIPTS) == sorted(path.name for path in ASSETS.glob("*.js"))
