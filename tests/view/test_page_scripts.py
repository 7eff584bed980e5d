"""The page's pure functions, run by Node."""

import json
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from fiveroute.formats.plan_file import PlanFile
from fiveroute.ocean.local_plane import LocalPlane
from fiveroute.view.event_log import read_events
from fiveroute.view.page import SCRIPTS
from fiveroute.view.payload import document_of, embedded
from fiveroute.view.scene import scene_of

ASSETS = Path(__file__).parents[2] / "fiveroute" / "view" / "assets"
NODE = shutil.which("node")

pytestmark = pytest.mark.skipif(NODE is None, reason="needs Node to run the page's scripts")


def evaluate(body: str) -> Any:
    """What a function body returns among the page's scripts."""
    scripts = "\n".join((ASSETS / name).read_text(encoding="utf-8") for name in SCRIPTS)
    program = f'"use strict";\n{scripts}\nconsole.log(JSON.stringify((() => {{ {body} }})()));'
    done = subprocess.run(
        [str(NODE), "-"], input=program, capture_output=True, text=True, check=False, timeout=60
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_numbers_are_shown_as_people_read_them() -> None:
    assert evaluate("return [0, 59.6, 3599.7, 36000].map(clock)") == [
        "0:00:00",
        "0:01:00",
        "1:00:00",
        "10:00:00",
    ]
    assert evaluate("return [0, 0.12346, 31.519, 12345.6, 2e7].map(amount)") == [
        "0",
        "0.1235",
        "31.52",
        "12345.6",
        "2.00e+7",
    ]
    assert evaluate("return [9, 10, 49, 0.003].map(roundLength)") == pytest.approx(
        [5, 10, 20, 0.002]
    )
    assert evaluate(
        "return [bearing(0, 1), bearing(1, 0), bearing(-1, -1), bearing(-1e-9, 1)]"
    ) == [
        "N (000°)",
        "E (090°)",
        "SW (225°)",
        "N (000°)",
    ]


@pytest.mark.parametrize("origin", [(4.7, 60.9), (-179.9, -33.0), (0.0, 0.0), (12.5, 89.0)])
def test_metres_lie_where_the_planner_says(origin: tuple[float, float]) -> None:
    """Within a centimetre of PROJ up to 500 km from the origin, across the 180th meridian too."""
    rng = np.random.default_rng(3)
    points = rng.uniform(-350e3, 350e3, (40, 2))
    points[:3] = (0.0, 0.0), (0.0, 9e4), (-9e4, 0.0)
    shown = np.array(
        evaluate(f"return {points.tolist()}.map((p) => onEarth({list(origin)}, ...p))")
    )
    x, y = LocalPlane(*origin).project(*shown.T)
    assert np.hypot(x - points[:, 0], y - points[:, 1]).max() < 0.01


def test_positions_are_written_as_on_charts() -> None:
    said = evaluate("return [placeText({ origin: [-8.5, -33] }, 0, 0), placeText({}, 1, 2)]")
    assert said == ["33.00000° S, 8.50000° W", None]


def test_ways_that_nobody_told_are_drawn_in_pieces(plan: PlanFile, log_path: Path) -> None:
    """AUV 2 goes to a node that is not on its plan; AUV 1 keeps to its own until it goes home."""
    scene = scene_of(plan, runs=read_events(log_path, plan))
    body = f"""
      const scene = unpackScene({embedded(document_of([scene]))}.scenes[0]);
      const bare = {{ ...scene, shapes: {{ first: [0], points: [] }}, cache: new Map() }};
      return [-1, 1].map((run) => timelineOf(scene, run).guessed).concat([
        timelineOf(bare, 1).guessed]);
    """
    planned, sailed, without_paths = evaluate(body)
    assert planned == without_paths == [[], []]
    assert sailed == [[[1100.0, 5000.0]], [[0.0, 2640.0]]]


def test_search_counts_values_up_to_a_limit() -> None:
    assert evaluate("return [-1, 0, 1, 1.5, 9].map((t) => countUpTo([0, 1, 1, 3], t))") == [
        0,
        1,
        3,
        3,
        4,
    ]


def test_camera_keeps_the_place_under_the_pointer() -> None:
    body = """
      const camera = new Camera();
      camera.fit([0, 0, 1000, 500], 800, 600);
      const before = camera.view(800, 600);
      const [x, y] = [before.wx(650), before.wy(120)];
      camera.zoomAt(3, 650 - 400, 120 - 300);
      const after = camera.view(800, 600);
      return [after.sx(x), after.sy(y), after.scale / before.scale];
    """
    assert evaluate(body) == pytest.approx([650.0, 120.0, 3.0])


def test_simplified_track_stays_within_its_tolerance() -> None:
    """Every dropped point is as near to what is drawn as the tolerance says."""
    body = """
      const n = 3000;
      const x = Float64Array.from({ length: n }, (_, k) => k + 3 * Math.sin(k / 40));
      const y = Float64Array.from({ length: n }, (_, k) => 90 * Math.sin(k / 300) + Math.cos(k));
      const track = { x, y, weight: weights(x, y), levels: new Map() };
      return [1, 8, 64].map((tolerance) => {
        const kept = simplified(track, tolerance);
        let worst = 0;
        for (let i = 1; i < kept.length; i += 1) {
          const [a, b] = [kept[i - 1], kept[i]];
          for (let k = a + 1; k < b; k += 1) {
            worst = Math.max(worst, distanceToLeg(x[k], y[k], x[a], y[a], x[b], y[b]));
          }
        }
        return [worst <= tolerance, kept.length, kept[0], kept[kept.length - 1]];
      });
    """
    levels = evaluate(body)
    assert [level[0] for level in levels] == [True] * 3
    assert [level[2:] for level in levels] == [[0, 2999]] * 3
    counts = [level[1] for level in levels]
    assert 2999 > counts[0] > counts[1] > counts[2]


def test_a_hundred_thousand_points_are_drawn_as_a_few_thousand() -> None:
    """At 4 km on 800 pixels, with the tolerance of the map."""
    body = """
      const n = 100000;
      const x = Float64Array.from({ length: n }, (_, k) => 4000 * k / n);
      const y = Float64Array.from({ length: n }, (_, k) => 300 * Math.sin(k / 900));
      const track = { x, y, weight: weights(x, y), levels: new Map() };
      return simplified(track, 0.4 / (800 / 4000)).length;
    """
    assert 100 < evaluate(body) < 5000


def test_position_goes_along_the_track_and_waits() -> None:
    body = """
      const shapes = { first: [0, 3], points: [0, 0, 0, 6, 8, 0.25, 10, 0, 1] };
      const legs = [[1, 0, 20, 30, 0], [2, 30, 40, 40, -1]];
      const track = trackOf(legs, shapes, [0, 0, 10, 0, 10, 10]);
      return [-1, 2.5, 5, 25, 35, 99].map((t) => {
        const { x, y } = positionAt(track, t);
        return [x, y];
      });
    """
    assert evaluate(body) == [[0, 0], [3, 4], [6, 8], [10, 0], [10, 5], [10, 10]]


def of_log(plan: PlanFile, log_path: Path, body: str) -> Any:
    data = embedded(document_of([scene_of(plan, runs=read_events(log_path, plan))]))
    return evaluate(f"const scene = unpackScene({data}.scenes[0]); {body}")


def test_states_of_nodes_follow_the_log(plan: PlanFile, log_path: Path) -> None:
    body = """
      const run = timelineOf(scene, 1);
      const short = ({ state, auv }) => [state, auv];
      const times = [0, 1160, 1500, 2800, 4000];
      return times.map((t) => run.changes.map((own) => short(stateAt(own, t))));
    """
    unplanned = ["unplanned", -1]
    assert of_log(plan, log_path, body) == [
        [["planned", 0], ["planned", 0], ["planned", 1], unplanned],
        [["collected", 0], ["dropped", 0], ["planned", 1], unplanned],
        [["collected", 0], ["planned", 1], ["planned", 1], unplanned],
        [["collected", 0], ["collected", 1], ["planned", 1], unplanned],
        [["collected", 0], ["collected", 1], ["idle", 1], unplanned],
    ]


def test_data_and_doings_follow_the_clock(plan: PlanFile, log_path: Path) -> None:
    body = """
      const run = timelineOf(scene, 1);
      const doing = (auv, t) => Object.values(doingAt(scene, run, auv, t));
      return [
        [0, 1100, 3000].map((t) => collectedAt(run, t)),
        [[0, 0], [0, 1070], [0, 1101], [0, 5000], [1, 3000], [1, 3600]].map((one) => doing(...one)),
        collectedAt(timelineOf(scene, -1), Infinity),
      ];
    """
    data, doings, planned = of_log(plan, log_path, body)
    assert data == [0, 2, 5]
    assert doings == [
        ["sailing to", 1],
        ["collecting", 1],
        ["going home", 0],
        ["home", 0],
        ["under way", 0],
        ["failed", 0],
    ]
    assert planned == 9


def test_runs_go_where_they_were_sailed(plan: PlanFile, log_path: Path) -> None:
    """An AUV that failed lies where it failed; one without a track follows its legs."""
    track = np.array([[0.0, 0.0, 0.0], [300.0, 400.0, 1000.0], [300.0, 900.0, 3500.0]])
    _, run = read_events(log_path, plan)
    run = replace(run, tracks=(np.zeros((0, 3)), track))
    data = embedded(document_of([scene_of(plan, runs=(run,))]))
    body = """
      const { tracks } = timelineOf(scene, 0);
      return [[1, 500], [1, 4500], [0, 0], [0, 1040]].map(([auv, t]) => {
        const { x, y } = positionAt(tracks[auv], t);
        return [x, y];
      });
    """
    places = evaluate(f"const scene = unpackScene({data}.scenes[0]); {body}")
    assert places == [[150, 200], [300, 900], [0, 0], [1000, 0]]


def test_current_is_interpolated_as_it_was_charted(plan: PlanFile, log_path: Path) -> None:
    from fiveroute.ocean.stated import stated_current

    u, v = stated_current(plan.instance)(1234.0, 567.0, 0.0)
    shown = of_log(plan, log_path, "return velocityAt(scene.chart, 1234, 567, 0)")
    assert shown == pytest.approx([float(u), float(v)], abs=2e-3)
    assert of_log(plan, log_path, "return velocityAt(scene.chart, 1e9, 0, 0)") is None


def test_colours_run_along_their_ramp() -> None:
    body = "return [-1, 0, 0.5, 1, 2].map((share) => rampColour([[0, 0, 0], [10, 20, 30]], share))"
    assert evaluate(body) == [[0, 0, 0], [0, 0, 0], [5, 10, 15], [10, 20, 30], [10, 20, 30]]


def test_auvs_of_one_colour_differ_in_their_dashes() -> None:
    body = """
      const theme = THEMES.light;
      return Array.from({ length: 28 }, (_, auv) => auvColour(theme, auv) + auvDash(theme, auv));
    """
    assert len(set(evaluate(body))) == 28


def test_names_hide_no_node_where_there_is_room_and_never_each_other() -> None:
    body = """
      const at = (x, y, text) => ({ x, y, radius: 5, text, width: 20 });
      const free = placedNames([at(0, 0, "a"), at(20, 0, "b"), at(200, 0, "c")], [[220, 0]]);
      const crowd = Array.from({ length: 40 }, (_, k) => at(3 * k, 0, `${k}`));
      const boxes = placedNames(crowd, []).map(([, box]) => box);
      const isHidden = (one) => boxes.some((other) => one !== other && isOver(one, other));
      const places = free.map(([text, [left, top]]) => [text, left, top]);
      return [places, boxes.length, boxes.some(isHidden)];
    """
    free, shown, hidden = evaluate(body)
    assert free == [["a", -28, -6], ["b", 28, -6], ["c", 172, -6]]
    assert 5 < shown < 40
    assert not hidden


def test_stamps_are_laid_over_what_is_there() -> None:
    """A half transparent pixel mixes, an opaque one covers; beyond the rim nothing happens."""
    body = """
      const bytes = (pixels) => [...new Uint8Array(Uint32Array.from(pixels).buffer)];
      const [red, grey] = [0xff0000ff, 0x80c86432];
      const picture = { width: 3, height: 2, pixels: new Uint32Array(6) };
      const square = { size: 3, pixels: new Uint32Array(9).fill(red) };
      stamp(picture, square, 0, 2);
      stamp(picture, { size: 1, pixels: Uint32Array.of(0x80000000) }, 0, 1);
      return [bytes(picture.pixels), bytes([blended(grey, grey), blended(grey, 0xff000000)])];
    """
    pixels, mixed = evaluate(body)
    assert pixels == [0] * 12 + [127, 0, 0, 255, 255, 0, 0, 255, 0, 0, 0, 0]
    assert mixed == [50, 100, 200, 192, 25, 50, 100, 255]
