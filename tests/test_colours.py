"""The page and the pictures agree on the colours of the AUVs."""

import re
from importlib.resources import files

from fiveroute.colours import COLOURS


def test_the_page_has_the_same_colours() -> None:
    script = (files("fiveroute.view") / "assets" / "colours.js").read_text(encoding="utf-8")
    found = re.search(r"auvs: \[(.*?)\]", script, re.DOTALL)
    assert found is not None
    assert tuple(re.findall(r"#[0-9a-f]{6}", found.group(1))) == COLOURS
