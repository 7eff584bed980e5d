import pytest

from fiveroute.errors import FiverouteError, InputError, nearest


@pytest.mark.parametrize(
    ("parts", "sentence"),
    [
        ({}, "must be even"),
        ({"value": 3}, "3: must be even"),
        ({"field": "m"}, "m: must be even"),
        ({"field": "m", "value": 3, "line": 7}, "line 7, m: 3: must be even"),
        (
            {"file": "a.txt", "line": 7, "field": "m", "value": "x"},
            "a.txt, line 7, m: 'x': must be even",
        ),
    ],
)
def test_sentence_says_where_and_what(parts: dict[str, object], sentence: str) -> None:
    assert str(InputError("must be even", **parts)) == sentence  # type: ignore[arg-type]


def test_file_is_named_afterwards() -> None:
    error = InputError("must be even", value=3, field="m", line=2).at("a.txt")
    assert str(error) == "a.txt, line 2, m: 3: must be even"
    assert isinstance(error, FiverouteError)


def test_sentence_stays_short_and_on_one_line() -> None:
    error = InputError("must\nbe\x1b[31m short", value="x" * 10_000, file="a\nb\r.txt")
    assert str(error).isprintable()
    assert len(str(error)) < 120


def test_the_nearest_name_is_offered() -> None:
    assert nearest("tmx", ["n", "m", "tmax"]) == "did you mean 'tmax'?"
    assert nearest("zzz", ["n", "m"]) == "known are m, n"


def test_no_name_is_lost_in_thousands() -> None:
    told = nearest("zzz", [str(k) for k in range(5000)])
    assert told.endswith(" and 4980 more")
    assert len(told) < 200
