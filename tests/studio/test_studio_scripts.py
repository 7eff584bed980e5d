"""The pure functions of the studio's page, run by Node."""

import json
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest

from fiveroute.studio import page
from fiveroute.view.page import view_scripts

ASSETS = Path(__file__).parents[2] / "fiveroute" / "studio" / "assets"
NODE = shutil.which("node")

pytestmark = pytest.mark.skipif(NODE is None, reason="needs Node to run the page's scripts")


def evaluate(expression: str) -> Any:
    """The value of an expression among the page's scripts."""
    own = [(ASSETS / name).read_text(encoding="utf-8") for name in page.SCRIPTS]
    scripts = "\n".join([*view_scripts(), *own])
    program = f'"use strict";\n{scripts}\nconsole.log(JSON.stringify({expression}));'
    done = subprocess.run(
        [str(NODE), "-"], input=program, capture_output=True, text=True, check=False, timeout=60
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_numbers_are_read_as_they_are_typed() -> None:
    assert evaluate('["", " 1.5 ", "-2e3"].map((text) => numberOf(text, "x"))') == [
        None,
        1.5,
        -2000,
    ]
    assert evaluate('["", "9", "9, 8"].map((text) => numbersOf(text, "x"))') == [None, 9, [9, 8]]
    assert evaluate('[" ", "ann, bea"].map(namesOf)') == [None, ["ann", "bea"]]
    assert evaluate("[null, 0.1 + 0.2, [1, 2.5]].map(shownNumber)") == ["", "0.3", "1, 2.5"]
    wrong = """["1,", "one", "Infinity"].map((text) => {
      try { return numbersOf(text, "Speed"); } catch (error) { return error.message; }
    })"""
    assert evaluate(wrong) == [
        "Speed: a number is missing beside a comma",
        "Speed: 'one' is no number",
        "Speed: 'Infinity' is no number",
    ]


def test_the_bar_holds_all_data() -> None:
    assert evaluate("gapShares(4, 5, 10)") == pytest.approx(
        {"collected": 0.4, "open": 0.1, "most": 0.5}
    )
    assert evaluate("[gapShares(null, null, 10).open, gapShares(0, 0, 0).open]") == [1, 0]
    assert evaluate("[gapWords(null), gapWords(0, 'optimal'), gapWords(0.125)]") == [
        "unknown",
        "0 (proved)",
        "12.5 %",
    ]


def test_the_state_of_the_plan_is_said() -> None:
    words = """[
      planWords({ job: { state: "running", message: "routes", seconds: 1, limit: 30 } }, {}),
      planWords({ job: null, planned: true }, {}),
      planWords({ job: null, planned: false }, { routes: [] }),
      planWords({ job: null, planned: false }, { routes: [[1]] }),
      planWords({ job: { state: "failed", error: "why" } }, {}),
    ]"""
    assert evaluate(words) == [
        "Planning: routes, 1.0 of 30 s",
        "The plan is up to date.",
        "There is no plan yet.",
        "The plan is older than the mission: routes are a draft.",
        "No plan: why",
    ]
