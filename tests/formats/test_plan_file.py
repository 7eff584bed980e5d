import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import fiveroute
from fiveroute.check import check
from fiveroute.errors import InputError
from fiveroute.formats import PlanFile, instance_hash, read_plan, write_plan
from fiveroute.instance import Currents, Fleet, Instance, Node, Ocean, Point
from fiveroute.result import Result, Status
from fiveroute.routes import Plan

# Two AUVs along a line; three nodes of which the last one is out of reach.
LINE = Instance(
    name="line",
    nodes=(Node("a", 1.0, 0.0, 2.0), Node("b", 2.0, 0.0, 3.0), Node("c", 99.0, 0.0, 4.0)),
    start=Point(0.0, 0.0),
    destination=Point(4.0, 0.0),
    fleet=Fleet(2, 1.0, 5.0),
)


@pytest.fixture
def plan() -> PlanFile:
    problem = LINE.problem()
    result = Result.judged(
        problem, Plan.of([[2], [1]]), method="by-hand", seconds=0.1, bound=5.0, seed=7
    )
    return PlanFile.of(LINE, problem, result)


@pytest.fixture
def file(plan: PlanFile, tmp_path: Path) -> Path:
    path = tmp_path / "plan.json"
    write_plan(plan, path)
    return path


def edit(file: Path, **changes: Any) -> None:
    document = json.loads(file.read_text())
    file.write_text(json.dumps(document | changes))


def test_plan_holds_what_the_method_found(plan: PlanFile) -> None:
    assert plan.routes == (("b",), ("a",))
    assert plan.durations == (4.0, 4.0)
    assert (plan.objective, plan.bound, plan.status) == (5.0, 5.0, Status.OPTIMAL)
    assert (plan.method, plan.seed, plan.version) == ("by-hand", 7, fiveroute.__version__)


def test_plan_comes_back(plan: PlanFile, file: Path) -> None:
    assert read_plan(file) == plan
    assert read_plan(file, LINE).plan == Plan.of([[2], [1]])


def test_file_stands_alone(file: Path) -> None:
    document = json.loads(file.read_text())
    assert list(document) == [
        "format",
        "instance",
        "instance_hash",
        "routes",
        "durations",
        "objective",
        "status",
        "bound",
        "method",
        "seed",
        "version",
    ]
    assert document["format"] == "fiveroute-plan/1"
    assert document["instance"]["format"] == "fiveroute-instance/1"
    assert document["instance_hash"] == instance_hash(LINE)
    assert document["routes"] == [["b"], ["a"]]


def test_plan_for_another_instance_is_refused_by_both_names(file: Path) -> None:
    read_plan(file, replace(LINE, name="renamed"))
    other = replace(LINE, name="other", fleet=Fleet(3, 1.0, 5.0))
    with pytest.raises(InputError, match=r"plan.json.*is a plan for 'line'.*not for 'other'"):
        read_plan(file, other)


def test_edited_instance_is_noticed(file: Path) -> None:
    document = json.loads(file.read_text())["instance"]
    document["nodes"][0]["data"] = 2000
    edit(file, instance=document)
    with pytest.raises(InputError, match=r"instance_hash: .*does not fit the instance"):
        read_plan(file)


def test_strange_ids_are_left_to_the_judge(file: Path) -> None:
    edit(file, routes=[["b", "moon"], ["", "a", "moon"]])
    filed = read_plan(file, LINE)
    violations = check(LINE.problem(), filed.plan)
    assert [v.kind for v in violations].count("unknown_node") == 3
    named = {filed.vertex_names[v.node] for v in violations if v.node is not None}
    assert named == {"moon", ""}


def test_no_plan_cannot_be_written() -> None:
    problem = LINE.problem()
    nothing = Result.judged(problem, None, method="by-hand", seconds=0.1)
    with pytest.raises(InputError, match="there is no plan to write"):
        PlanFile.of(LINE, problem, nothing)


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"format": "fiveroute-instance/1"}, "a fiveroute plan says"),
        ({"routes": [["a"]]}, "durations: 2: must have 1 entries"),
        ({"routes": [[1], []]}, r"routes\[0\]\[0\]: 1: must be text"),
        ({"routes": None}, "routes: must be a valid array"),
        ({"durations": [1, -1]}, r"durations\[1\]: -1: must be greater than or equal to 0"),
        ({"objective": float("nan")}, "objective: nan: must be a finite number"),
        ({"status": "perfect"}, "status: 'perfect': must be 'optimal', 'feasible'"),
        ({"seed": 1.5}, "seed: 1.5: must be a valid integer"),
        (
            {"seconds": 1},
            "seconds: 1: is no key of this format; known are bound, currents_hash, durations",
        ),
        ({"instance": {}}, "instance.name: is missing"),
        ({"instance": []}, "instance: .*must be an object"),
    ],
)
def test_faults_are_named(file: Path, changes: dict[str, Any], sentence: str) -> None:
    edit(file, **changes)
    with pytest.raises(InputError, match=f"plan.json.*{sentence}"):
        read_plan(file)


def test_plan_in_another_folder_keeps_the_currents(plan: PlanFile, tmp_path: Path) -> None:
    instance = replace(LINE, ocean=Ocean(Currents(file="sea.nc")))
    target = tmp_path / "plans" / "plan.json"
    target.parent.mkdir()
    write_plan(replace(plan, instance=instance), target, source=tmp_path / "line.json")
    filed = read_plan(target, instance)  # the hash does not know folders
    assert filed.instance.ocean.currents.file == "../sea.nc"


def test_existing_plans_stay_without_force(plan: PlanFile, file: Path) -> None:
    with pytest.raises(InputError, match="--force"):
        write_plan(plan, file)
    write_plan(replace(plan, seed=8), file, force=True)
    assert read_plan(file).seed == 8
