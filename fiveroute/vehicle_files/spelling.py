"""Names, numbers and XML as files for vehicles can bear them.

Ids of nodes come from anywhere. Nothing in one may end a line, a cell or an element of a file:
XML and JSON escape what they must, and every other format gets a `label`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from xml.etree import ElementTree

from fiveroute.errors import InputError
from fiveroute.words import printable

__all__ = [
    "child",
    "degrees",
    "label",
    "metres",
    "readable",
    "require",
    "whole_seconds",
    "xml_text",
]

Element = ElementTree.Element


def label(text: str, longest: int = 60) -> str:
    """One short line of printable text."""
    line = printable(text)
    return line if len(line) <= longest else f"{line[: longest - 3]}..."


def readable(text: str) -> str:
    """The text without the signs that XML cannot hold."""
    return "".join(sign if _is_xml(sign) else " " for sign in text)


def degrees(value: float) -> str:
    """A longitude or latitude to the centimetre and below."""
    return f"{value:.8f}"


def metres(value: float) -> str:
    """A length in metres to the millimetre."""
    return f"{value:.3f}"


def whole_seconds(seconds: float) -> int:
    """A stay in whole seconds, not a shorter one."""
    return 0 if seconds <= 0.0 else max(1, math.ceil(seconds - 1e-6))


def child(
    parent: Element, tag: str, text: str | None = None, attributes: Mapping[str, str] | None = None
) -> Element:
    """A new element inside another one."""
    element = ElementTree.SubElement(
        parent, tag, {key: readable(value) for key, value in (attributes or {}).items()}
    )
    if text is not None:
        element.text = readable(text)
    return element


def xml_text(root: Element) -> str:
    """The document of a root element."""
    ElementTree.indent(root)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{ElementTree.tostring(root, "unicode")}\n'


def require(holds: bool, rule: str, value: object = None, field: str | None = None) -> None:
    """Refuse a file that breaks a rule of its format."""
    if not holds:
        raise InputError(rule, value=value, field=field)


def _is_xml(sign: str) -> bool:
    """Whether XML 1.0 allows a sign, and keeps it as it is in attributes too."""
    return " " <= sign <= "\ud7ff" or "\ue000" <= sign <= "\ufffd" or sign >= "\U00010000"
