"""One HTML page that shows plans and plays their runs, and asks nothing of the network.

Styles, scripts and data stand in the page itself. Its content security policy allows the one
style and the one script whose hashes it names and nothing else, so that no text of a file can
become code; all text is put on the page as text, never as markup.
"""

from __future__ import annotations

import base64
import hashlib
import html
from collections.abc import Sequence
from functools import cache
from importlib.resources import files
from string import Template

from fiveroute.view.payload import document_of, embedded
from fiveroute.view.scene import Scene

__all__ = ["SCRIPTS", "page_of"]

SCRIPTS = (
    "numbers.js",
    "colours.js",
    "camera.js",
    "tracks.js",
    "model.js",
    "history.js",
    "chart.js",
    "map.js",
    "tables.js",
    "strip.js",
    "bars.js",
    "pane.js",
    "player.js",
    "app.js",
)
"""The page's scripts in the order in which they are joined."""


def page_of(scenes: Sequence[Scene]) -> str:
    """The page of one scene, or of two to be compared.

    Parameters
    ----------
    scenes
        One scene or two.
    """
    style, script = _asset("page.css"), _script()
    title = " and ".join(dict.fromkeys(scene.title for scene in scenes))
    return Template(_asset("page.html")).substitute(
        title=html.escape(title),
        style=style,
        style_hash=_hash(style),
        script=script,
        script_hash=_hash(script),
        data=embedded(document_of(scenes)),
    )


@cache
def _asset(name: str) -> str:
    return (files("fiveroute.view") / "assets" / name).read_text(encoding="utf-8")


def _script() -> str:
    """All scripts as one, in a scope of their own."""
    parts = "\n".join(_asset(name) for name in SCRIPTS)
    return f'"use strict";\n(() => {{\n{parts}\nstart();\n}})();\n'


def _hash(text: str) -> str:
    digest = hashlib.sha256(text.encode()).digest()
    return f"sha256-{base64.b64encode(digest).decode('ascii')}"
