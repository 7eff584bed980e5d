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
from typing import NamedTuple

from fiveroute.view.payload import document_of, embedded
from fiveroute.view.scene import Scene

__all__ = ["SCRIPTS", "Page", "assembled", "page_of", "view_scripts", "view_style"]

SCRIPTS = (
    "numbers.js",
    "colours.js",
    "elements.js",
    "camera.js",
    "earth.js",
    "tracks.js",
    "model.js",
    "history.js",
    "layer.js",
    "chart.js",
    "marks.js",
    "routes.js",
    "ground.js",
    "nodes.js",
    "names.js",
    "happenings.js",
    "links.js",
    "furniture.js",
    "strip.js",
    "bars.js",
    "table.js",
    "tables.js",
    "events.js",
    "key.js",
    "tips.js",
    "gestures.js",
    "pane.js",
    "player.js",
    "app.js",
)
"""The page's scripts in the order in which they are joined."""


class Page(NamedTuple):
    """A page and the policy that it states.

    Parameters
    ----------
    text
        The HTML.
    policy
        Its content security policy.
    """

    text: str
    policy: str


def page_of(scenes: Sequence[Scene]) -> str:
    """The page of one scene, or of two to be compared.

    Parameters
    ----------
    scenes
        One scene or two.
    """
    title = " and ".join(dict.fromkeys(scene.title for scene in scenes))
    parts = view_scripts()
    return assembled(title, view_style(), parts, "start", embedded(document_of(scenes))).text


def assembled(
    title: str, style: str, scripts: Sequence[str], start: str, data: str, may_ask: bool = False
) -> Page:
    """Put a page together.

    Parameters
    ----------
    title
        Its title.
    style
        Its style sheet.
    scripts
        Its scripts, which share a scope of their own.
    start
        Name of the function that begins.
    data
        JSON text that can stand inside a script element.
    may_ask
        Whether it may ask the server that it comes from.
    """
    parts = "\n".join(scripts)
    script = f'"use strict";\n(() => {{\n{parts}\n{start}();\n}})();\n'
    policy = (
        f"default-src 'none'; script-src '{_hash(script)}'; style-src '{_hash(style)}'; "
        f"img-src data:; base-uri 'none'; form-action 'none'"
        + ("; connect-src 'self'" if may_ask else "")
    )
    text = Template(_asset("page.html")).substitute(
        title=html.escape(title), policy=policy, style=style, script=script, data=data
    )
    return Page(text, policy)


def view_scripts() -> list[str]:
    """The scripts of the view, in their order."""
    return [_asset(name) for name in SCRIPTS]


def view_style() -> str:
    """The style sheet of the view."""
    return _asset("page.css")


@cache
def _asset(name: str) -> str:
    return (files("fiveroute.view") / "assets" / name).read_text(encoding="utf-8")


def _hash(text: str) -> str:
    digest = hashlib.sha256(text.encode()).digest()
    return f"sha256-{base64.b64encode(digest).decode('ascii')}"
