"""The page of a studio: that of `fiveroute.view`, with what it takes to edit.

The page itself holds neither the mission nor the secret: it takes the secret from its address and
asks for the mission.
"""

from __future__ import annotations

from importlib.resources import files

from fiveroute.vehicle_files import VEHICLE_FORMATS
from fiveroute.view.page import Page, assembled, view_scripts, view_style
from fiveroute.view.payload import embedded

__all__ = ["SCRIPTS", "studio_page"]

SCRIPTS = ("client.js", "fields.js", "gap.js", "editor.js", "panels.js", "studio.js")
"""The studio's own scripts in the order in which they follow those of the view."""


def studio_page() -> Page:
    """The page, and the policy to be sent with it."""
    formats = {name: chosen.holds for name, chosen in VEHICLE_FORMATS.items()}
    page = assembled(
        "studio",
        view_style() + _asset("studio.css"),
        [*view_scripts(), *map(_asset, SCRIPTS)],
        "startStudio",
        embedded({"formats": formats}),
        may_ask=True,
    )
    return page._replace(policy=f"{page.policy}; frame-ancestors 'none'")


def _asset(name: str) -> str:
    return (files("fiveroute.studio") / "assets" / name).read_text(encoding="utf-8")
