"""XML from strangers: no document types, hence no entities, and bounded in size and nesting."""

from __future__ import annotations

from collections.abc import Iterator
from xml.etree.ElementTree import Element, ParseError, TreeBuilder, XMLParser

from fiveroute.errors import InputError

__all__ = ["local_name", "named", "parse_xml", "text_of"]

MAX_NESTING = 64
"""Deepest nesting of elements that is read; charts have ten levels or so."""

MAX_ELEMENTS = 1_000_000
"""Most elements that are read."""


class _Guard(TreeBuilder):
    """Builds the tree of a document, as long as it stays harmless."""

    def __init__(self) -> None:
        super().__init__()
        self._nesting = self._elements = 0

    def start(self, tag: str, attrs: dict[str, str], /) -> Element:
        self._nesting += 1
        self._elements += 1
        if self._nesting > MAX_NESTING:
            raise InputError("is nested too deeply; use the elements of the format only")
        if self._elements > MAX_ELEMENTS:
            raise InputError(f"has more than {MAX_ELEMENTS} elements; split the file")
        return super().start(tag, attrs)

    def end(self, tag: str, /) -> Element:
        self._nesting -= 1
        return super().end(tag)

    def doctype(self, name: str, public: str | None, system: str | None) -> None:
        """Called at the beginning of a document type, before any entity is declared."""
        raise InputError(
            "must not declare a document type or entities; remove the line with <!DOCTYPE"
        )


def parse_xml(text: str) -> Element:
    """Read a document.

    Raises
    ------
    InputError
        If it is no XML, declares a document type, or is absurdly large or deep.
    """
    parser = XMLParser(target=_Guard())
    try:
        parser.feed(text)
        root: Element = parser.close()
    except ParseError as error:
        line, reason = error.position[0], str(error).partition(":")[0]
        raise InputError(f"is no XML: {reason}; correct the line", line=line) from None
    return root


def local_name(element: Element) -> str:
    """The tag without its namespace."""
    return element.tag.rpartition("}")[2]


def named(root: Element, *names: str) -> Iterator[Element]:
    """All elements below a root with one of some names, whatever their namespace."""
    return (element for element in root.iter() if local_name(element) in names)


def text_of(parent: Element, name: str) -> str | None:
    """The text of the first child of a name, stripped; None where there is none."""
    for element in parent:
        if local_name(element) == name:
            return (element.text or "").strip() or None
    return None
