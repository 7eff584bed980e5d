import json
from typing import Annotated, Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass

from fiveroute.errors import InputError
from fiveroute.formats.json_document import layout, read_document

VALUE = st.recursive(
    st.none() | st.booleans() | st.floats(allow_nan=False, allow_infinity=False) | st.text(),
    lambda inside: st.lists(inside) | st.dictionaries(st.text(), inside),
    max_leaves=30,
)


@given(value=VALUE)
@settings(deadline=None)
def test_layout_changes_nothing_but_blanks(value: Any) -> None:
    assert json.loads(layout(value)) == value


def test_layout_keeps_plain_containers_on_one_line() -> None:
    value = {"a": [1.0, 2.5], "b": [{"x": 0.1, "y": []}, {}], "c": {}}
    assert layout(value).splitlines() == [
        "{",
        '  "a": [1.0, 2.5],',
        '  "b": [',
        '    {"x": 0.1, "y": []},',
        "    {}",
        "  ],",
        '  "c": {}',
        "}",
    ]


_STRICT = ConfigDict(extra="forbid", strict=True)


@dataclass(frozen=True, config=_STRICT)
class Leaf:
    weight: Annotated[int, Field(ge=0)]


@dataclass(frozen=True, config=_STRICT)
class Tree:
    format: str
    height: float
    leaves: tuple[Leaf, ...] = ()


def fault(**changes: Any) -> str:
    with pytest.raises(InputError) as caught:
        read_document(json.dumps({"format": "tree/1", "height": 1} | changes), Tree, "tree/1")
    return str(caught.value)


def test_document_becomes_the_model() -> None:
    text = '{"format": "tree/1", "height": 2, "leaves": [{"weight": 3}]}'
    assert read_document(text, Tree, "tree/1") == Tree("tree/1", 2.0, (Leaf(3),))


def test_first_fault_is_told_and_the_others_counted() -> None:
    assert fault(leaves=[{"weight": 1}, {"weight": -1}, {"weight": -2}]) == (
        "leaves[1].weight: -1: must be greater than or equal to 0; correct the value "
        "(faults after this one: 1)"
    )


def test_unknown_key_is_told_before_the_missing_one_it_stands_for() -> None:
    assert fault(leaves=[{"wieght": 1}]) == (
        "leaves[0].wieght: 1: is no key of this format; did you mean 'weight'? "
        "(faults after this one: 1)"
    )


def test_keys_are_suggested_from_the_right_object() -> None:
    assert fault(zzz=1).endswith("known are format, height, leaves")


def test_tag_is_judged_first() -> None:
    assert fault(format="bush/1", height="tall") == (
        "format: 'bush/1': is not the format of this file; "
        'a fiveroute tree says "format": "tree/1"'
    )
