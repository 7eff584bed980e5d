import base64
import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.formats.plan_file import PlanFile
from fiveroute.view.event_log import read_events
from fiveroute.view.payload import document_of, embedded
from fiveroute.view.scene import scene_of


@settings(deadline=None, max_examples=50)
@given(st.text(st.characters(codec=None)))
def test_embedded_text_cannot_end_its_element(text: str) -> None:
    shown = embedded({"id": text + "</script><!--&\u2028\u2029"})
    assert not set("<>&\u2028\u2029") & set(shown)
    assert shown.isascii()
    assert json.loads(shown)["id"].startswith(text)


def test_document_tells_everything(plan: PlanFile, log_path: Path) -> None:
    scene = scene_of(plan, runs=read_events(log_path, plan))
    (shown,) = json.loads(embedded(document_of([scene])))["scenes"]
    assert shown["ids"] == [node.id for node in plan.instance.nodes]
    assert shown["depths"] == [None] * 4
    assert shown["budgets"] == [9000.0, 9000.0]
    assert (shown["objective"], shown["bound"], shown["total"]) == (9.0, 10.0, 10.0)
    assert shown["gap"] == pytest.approx(1.0 / 9.0)
    assert [barrier["kind"] for barrier in shown["barriers"]] == ["obstacle", "land"]
    assert [run["run"] for run in shown["runs"]] == [0, 1]
    heads = [[leg[0] for leg in legs] for legs in shown["runs"][1]["legs"]]
    assert heads == [[1, 5], [2]]


def test_arrays_come_back(plan: PlanFile) -> None:
    scene = scene_of(plan)
    (shown,) = document_of([scene])["scenes"]
    table = np.frombuffer(base64.b64decode(shown["shapes"]["points"]), dtype="<f4").reshape(-1, 3)
    first, second = shown["shapes"]["first"][:2]
    assert table[first:second, :2].tolist() == [[0.0, 0.0], [500.0, 200.0], [1000.0, 0.0]]
    assert scene.chart is not None
    packed = np.frombuffer(base64.b64decode(shown["chart"]["uv"]), dtype="<i2")
    uv = packed.reshape(scene.chart.uv.shape) * (shown["chart"]["fastest"] / 32767)
    assert np.abs(uv - scene.chart.uv).max() <= shown["chart"]["fastest"] / 65000
