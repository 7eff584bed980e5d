import json
import math
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.errors import InputError
from fiveroute.formats.plan_file import PlanFile
from fiveroute.sea.events import Event, Frame
from fiveroute.view.event_log import read_events, run_logs


def test_runs_come_in_their_order_with_vertices(plan: PlanFile, log_path: Path) -> None:
    first, second = read_events(log_path, plan)
    assert (first.run, second.run) == (0, 1)
    assert first.events == (Event(9300.0, 0, "arrive"),)
    assert second.events[2] == Event(1100.0, 0, "collect", 1)
    assert [event.t for event in second.events] == sorted(event.t for event in second.events)


MESSAGE = {"number": 4, "kind": "bid", "sender": 0, "receiver": 1, "bits": 52}
SENT = {"run": 0, "t": 1.0, "auv": 0, "kind": "send"}
GOOD = {"run": 0, "t": 1.0, "auv": 0, "kind": "collect", "node": "a"}


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("nonsense", "is no JSON"),
        ("[1]", "is no event"),
        (json.dumps(GOOD | {"kind": "explode"}), "kind: 'explode'"),
        (json.dumps(GOOD | {"auv": 2}), "auv: 2: the plan has 2 AUVs"),
        (json.dumps(GOOD | {"node": "z"}), "node: 'z': is no node of the plan's instance"),
        (json.dumps(GOOD | {"t": -1.0}), "t: -1.0"),
        (json.dumps(GOOD).replace("1.0", "NaN"), "line 2"),
        (json.dumps(GOOD | {"speed": 1.0}), "speed: 1.0: is no key of this format"),
        (json.dumps({"run": 0}), "is missing"),
        (json.dumps(SENT | {"message": MESSAGE | {"receiver": 2}}), "message.receiver: 2: the"),
        (json.dumps(SENT | {"message": MESSAGE | {"sender": 9}}), "message.sender: 9: the plan"),
        (json.dumps(SENT | {"message": MESSAGE | {"bits": -1}}), "message.bits: -1"),
        (json.dumps(SENT | {"message": MESSAGE | {"kind": "x" * 41}}), "message.kind"),
        (json.dumps(SENT | {"message": {"number": 1}}), "is missing"),
        (json.dumps({"run": 0, "t": 1.0, "auv": 0, "kind": "discard"}), "node: is missing"),
    ],
)
def test_wrong_line_is_named(plan: PlanFile, tmp_path: Path, line: str, said: str) -> None:
    path = tmp_path / "log.jsonl"
    path.write_text(f"{json.dumps(GOOD)}\n{line}\n")
    with pytest.raises(InputError) as error:
        read_events(path, plan)
    assert str(error.value).startswith(f"{path}, line 2")
    assert said in str(error.value)


def test_messages_are_told_or_not(plan: PlanFile) -> None:
    """Logs of before messages were told are still read."""
    ((_, events),) = ((log.run, log.events) for log in run_logs(json.dumps(SENT), plan))
    assert events == (Event(1.0, 0, "send"),)
    heard = SENT | {"message": MESSAGE | {"heard": [{"auv": 1, "t": 1.5}]}}
    (log,) = run_logs(json.dumps(heard), plan)
    assert log.events == (Event(1.0, 0, "send", None, Frame(4, 0, 1, "bid", 52)),)


def test_blank_lines_do_not_count(plan: PlanFile) -> None:
    assert len(run_logs(f"\n{json.dumps(GOOD)}\n\n", plan)) == 1


@settings(deadline=None, max_examples=200)
@given(
    st.text()
    | st.dictionaries(
        st.sampled_from(["run", "t", "auv", "kind", "node"]),
        st.none() | st.booleans() | st.integers() | st.floats() | st.text() | st.just("collect"),
    ).map(json.dumps)
)
def test_any_line_is_an_event_or_an_error_of_ours(plan: PlanFile, line: str) -> None:
    try:
        logs = run_logs(f"{json.dumps(GOOD)}\n{line}", plan)
    except InputError:
        return
    assert all(math.isfinite(event.t) for log in logs for event in log.events)
