from xml.etree import ElementTree

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fiveroute.errors import InputError
from fiveroute.vehicle_files.spelling import (
    child,
    label,
    readable,
    require,
    whole_seconds,
    xml_text,
)


@given(st.text())
def test_a_label_is_one_short_printable_line(text: str) -> None:
    line = label(text)
    assert line.isprintable()
    assert len(line) <= 60
    assert label("buoy 7") == "buoy 7"


@given(st.text(), st.text())
def test_any_text_survives_xml(text: str, value: str) -> None:
    root = ElementTree.Element("root")
    child(root, "name", text, {"key": value})
    back = ElementTree.fromstring(xml_text(root))[0]
    assert (back.text or "") == readable(text)
    assert back.attrib["key"] == readable(value)


@pytest.mark.parametrize(
    ("seconds", "whole"), [(0.0, 0), (0.1, 1), (30.0, 30), (30.2, 31), (30.0 + 1e-9, 30), (1e-9, 1)]
)
def test_stays_are_not_cut_short(seconds: float, whole: int) -> None:
    assert whole_seconds(seconds) == whole


def test_rules_are_told_with_value_and_field() -> None:
    require(True, "fine")
    with pytest.raises(InputError, match=r"^depth: -1: is above the water$"):
        require(False, "is above the water", -1, "depth")
