"""Colours of Okabe and Ito (2008), which colour-blind readers can tell apart.

Every picture, page and notebook gives the k-th AUV the k-th of them; `view/assets/colours.js` has
the same ones.
"""

from __future__ import annotations

__all__ = ["BLUE", "COLOURS", "GREEN", "VERMILION"]

BLUE, VERMILION, GREEN = "#0072b2", "#d55e00", "#009e73"

COLOURS = (BLUE, VERMILION, GREEN, "#cc79a7", "#e69f00", "#56b4e9", "#000000")
"""One an AUV, over and over; black comes last, so that it can be left out on dark ground."""
