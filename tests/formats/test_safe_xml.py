"""XML that would read files, fill the memory or call home is refused before it can."""

import pytest

from fiveroute.errors import InputError
from fiveroute.formats.safe_xml import MAX_NESTING, local_name, named, parse_xml, text_of

LAUGHS = (
    '<?xml version="1.0"?><!DOCTYPE l [<!ENTITY a "ha"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">]>'
    "<gpx>&b;</gpx>"
)
FILE = '<!DOCTYPE gpx [<!ENTITY f SYSTEM "file:///etc/passwd">]><gpx>&f;</gpx>'
REMOTE = '<!DOCTYPE gpx SYSTEM "http://example.org/x.dtd"><gpx/>'
PARAMETER = '<!DOCTYPE g [<!ENTITY % p SYSTEM "file:///etc/passwd"> %p;]><g/>'


@pytest.mark.parametrize("text", [LAUGHS, FILE, REMOTE, PARAMETER, "<!doctype html><gpx/>"])
def test_document_types_are_refused(text: str) -> None:
    with pytest.raises(InputError, match=r"document type|no XML"):
        parse_xml(text)


def test_undeclared_entities_are_no_xml() -> None:
    with pytest.raises(InputError, match="line 2"):
        parse_xml("<gpx>\n&nbsp;</gpx>")


def test_nesting_is_bounded() -> None:
    deep = MAX_NESTING
    assert parse_xml("<a>" * deep + "</a>" * deep).tag == "a"
    with pytest.raises(InputError, match="nested too deeply"):
        parse_xml("<a>" * (deep + 1) + "</a>" * (deep + 1))
    with pytest.raises(InputError, match="nested too deeply"):
        parse_xml("<a>" * 500_000)


def test_the_number_of_elements_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("fiveroute.formats.safe_xml.MAX_ELEMENTS", 10)
    parse_xml(f"<a>{'<b/>' * 9}</a>")
    with pytest.raises(InputError, match="more than 10"):
        parse_xml(f"<a>{'<b/>' * 10}</a>")


def test_names_are_found_in_any_namespace() -> None:
    root = parse_xml(
        '<k:kml xmlns:k="urn:k"><k:name> a </k:name><name/><b><name>c</name></b></k:kml>'
    )
    assert local_name(root) == "kml"
    assert text_of(root, "name") == "a"
    assert text_of(root, "missing") is None
    assert [element.text for element in named(root, "name")] == [" a ", None, "c"]


def test_stated_encodings_do_not_matter_to_text() -> None:
    assert parse_xml('<?xml version="1.0" encoding="UTF-16"?><a>ø</a>').text == "ø"
