"""Positions as people write them, and never another place than they mean."""

from typing import Literal

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fiveroute.errors import InputError
from fiveroute.formats.degrees import parsed_degrees


@pytest.mark.parametrize(
    ("text", "axis", "degrees"),
    [
        ("63.44", "lat", 63.44),
        ("-8.5", "lon", -8.5),
        ("1e1", "lon", 10.0),
        ("63.44N", "lat", 63.44),
        ("63.44° n", "lat", 63.44),
        ("W 8.5", "lon", -8.5),
        ("63°26.4'N", "lat", 63.44),
        ("63° 26.4\u2032", "lat", 63.44),
        ("63 26.4 S", "lat", -63.44),
        ("-8 30", "lon", -8.5),
        ("008:30:36 E", "lon", 8.51),
        ("8°30'36\"W", "lon", -8.51),
        ("8º30\u201936\u201d", "lon", 8.51),
    ],
)
def test_ways_of_writing_a_position(text: str, axis: Literal["lon", "lat"], degrees: float) -> None:
    assert parsed_degrees(text, axis, 2) == pytest.approx(degrees, abs=1e-12)


@pytest.mark.parametrize(
    "text",
    ["", "E", "6326.4N", "63°60'N", "63.5°20'N", "-63 N", "N 63 S", "63°26'N", "8 30 60", "8 1 2 3",
     "8,5", "8 30.5 20", "nan", "8°-3'"],
)  # fmt: skip
def test_anything_else_is_refused(text: str) -> None:
    with pytest.raises(InputError, match="line 7, lon"):
        parsed_degrees(text, "lon", 7)


@given(degrees=st.floats(-179.9, 179.9))
def test_there_and_back(degrees: float) -> None:
    minutes, letter = 60.0 * (abs(degrees) % 1.0), "W" if degrees < 0.0 else "E"
    if f"{minutes:.5f}" != "60.00000":
        text = f"{int(abs(degrees))}°{minutes:08.5f}'{letter}"
        assert parsed_degrees(text, "lon", 1) == pytest.approx(degrees, abs=1e-6)
