"""Answers of the command line: one JSON document, or a short table for people."""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import click

from fiveroute.cli.notes import tell
from fiveroute.instance import Instance
from fiveroute.result import GiantRouteResult, Status
from fiveroute.routes import Route
from fiveroute.words import ENDLESS, clock, printable

if TYPE_CHECKING:
    from fiveroute.fleet_plan import FleetPlan
    from fiveroute.fleet_runs import FleetRuns
    from fiveroute.formats.plan_file import PlanFile
    from fiveroute.mission import MissionPlan
    from fiveroute.tiers.pathing import PlannedPath
    from fiveroute.verdict import Verdict

__all__ = [
    "exit_code",
    "fleet_plan_answer",
    "gap_text",
    "giant_route_answer",
    "named",
    "path_answer",
    "print_giant_route",
    "print_json",
    "print_path",
    "print_routes",
    "print_table",
    "print_verdict",
    "simulation_answer",
    "verify_answer",
]

_WIDE = 160
"""Characters in a line of a table where there is no terminal that has a width of its own."""

_CODES = {Status.OPTIMAL: 0, Status.FEASIBLE: 0, Status.INFEASIBLE: 1, Status.NO_SOLUTION: 3}


def exit_code(status: Status, interrupted: bool) -> int:
    """Exit code of a run: 0 done, 1 no plan exists, 3 nothing found, 130 interrupted."""
    return 130 if interrupted else _CODES[status]


def named(instance: Instance, route: Route) -> list[str]:
    """Ids of the nodes of a route."""
    return [instance.nodes[vertex - 1].id for vertex in route]


def fleet_plan_answer(plan: FleetPlan) -> dict[str, Any]:
    """The keys of `solve`; `plan` adds how the paper's pipeline came to its routes."""
    answer = {
        "instance": plan.instance.name,
        "method": plan.result.method,
        "status": plan.status.value,
        "objective": plan.objective,
        "bound": plan.bound,
        "gap": plan.gap,
        "completion_rate": plan.completion_rate,
        "fleet_size": plan.fleet_size,
        "routes": plan.routes,
        "durations": plan.durations,
        "seconds": plan.result.seconds,
        "seed": plan.result.seed,
        "straight_lines": plan.voyage.legs is None,
        "unreachable": list(plan.unreachable),
    }
    return answer if plan.pipeline is None else answer | _pipeline_answer(plan.pipeline)


def _pipeline_answer(planned: MissionPlan) -> dict[str, Any]:
    instance = planned.instance
    return {
        "search": planned.search,
        "allocation": planned.allocation,
        "fleet_estimate": planned.fleet_estimate,
        "giant_route": {
            "order": named(instance, planned.giant_route),
            "duration": planned.giant_route_duration,
        },
        "segments": [named(instance, segment) for segment in planned.segments],
    }


def giant_route_answer(instance: Instance, result: GiantRouteResult, seed: int) -> dict[str, Any]:
    """The keys of `giant-route`; a closed tour begins with the start's own id."""
    order = named(instance, result.order)
    if instance.start == instance.destination:
        order = [_start_id(instance), *order]
    return {
        "instance": instance.name,
        "method": result.method,
        "status": result.status.value,
        "order": order,
        "duration": result.duration,
        "bound": result.bound,
        "gap": result.gap,
        "seconds": result.seconds,
        "seed": seed,
    }


def path_answer(
    instance: Instance, ends: tuple[str, str], planned: PlannedPath, seconds: float
) -> dict[str, Any]:
    """The keys of `path`; a path that does not exist has no duration, and says why."""
    path = planned.path
    found = path.is_found
    return {
        "instance": instance.name,
        "from": ends[0],
        "to": ends[1],
        "status": path.status.value,
        "duration": path.duration if found else None,
        "reference_duration": _finite(planned.reference),
        "gap": planned.gap,
        "waypoints": path.waypoints.tolist(),
        "min_clearance": _finite(path.min_clearance),
        "max_curvature": path.max_curvature if found else None,
        "seconds": seconds,
    }


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def print_path(answer: Mapping[str, Any]) -> None:
    """Print a path for people."""
    where = f"{answer['instance']}: {answer['from']} to {answer['to']}"
    if answer["duration"] is None:
        tell(f"{where} {answer['status']}")
        return
    tell(where)
    figures = [
        ("duration", f"{clock(answer['duration'])} ({answer['duration']:.1f} s)"),
        ("waypoints", str(len(answer["waypoints"]))),
        ("tightest turn", _radius(answer["max_curvature"])),
    ]
    if answer["reference_duration"] is not None:
        text = f"{answer['reference_duration']:.1f} s (gap {100 * answer['gap']:.3f} %)"
        figures.insert(1, ("reference", text))
    if answer["min_clearance"] is not None:
        figures.append(("clearance", f"{answer['min_clearance']:.1f} m"))
    for name, text in figures:
        tell(f"{name:<16}{text}")


def _radius(curvature: float) -> str:
    return f"radius {1.0 / curvature:.0f} m" if curvature > 0.0 else "none"


def simulation_answer(runs: FleetRuns) -> dict[str, Any]:
    """The keys of `simulate`; completion is that of the whole mission."""
    import numpy as np

    voyage, result = runs.plan.voyage, runs.result
    rates = result.completions
    least, low, middle, high, most = np.percentile(rates, (0, 25, 50, 75, 100)).tolist()
    sent, delivered = result.messages
    return {
        "instance": voyage.mission.name,
        "planner": result.planner,
        "runs": len(result.runs),
        "fleet_size": result.fleet_size,
        "completion": {
            "mean": float(rates.mean()),
            "std": float(rates.std(ddof=1)) if len(rates) > 1 else 0.0,
            "min": least,
            "p25": low,
            "median": middle,
            "p75": high,
            "max": most,
        },
        "planned_completion": result.planned_completion,
        "online_gap": result.online_gap,
        "late_returns": result.late_returns,
        "double_visits": result.double_visits,
        "messages": {"sent": sent, "delivered": delivered},
        "min_clearance": result.min_clearance,
        "collisions": result.collisions,
        "lost": result.lost,
        "unreachable": list(voyage.unreachable),
        "straight_lines": voyage.legs is None,
        "seconds": result.seconds,
        "seed": runs.seed,
    }


def verify_answer(instance: Instance, filed: PlanFile, verdict: Verdict) -> dict[str, Any]:
    """The keys of `verify`: AUVs are counted from 0, nodes go by their ids."""
    return {
        "instance": instance.name,
        "feasible": verdict.feasible,
        "objective": verdict.objective,
        "completion_rate": verdict.completion_rate,
        "durations": list(verdict.durations),
        "violations": [
            {
                "kind": violation.kind,
                "auv": violation.auv,
                "node": None if violation.node is None else filed.vertex_names[violation.node],
                "amount": violation.amount,
            }
            for violation in verdict.violations
        ],
    }


def _start_id(instance: Instance) -> str:
    """Formats without ids number the start as 1; a native file does not name it."""
    numbered = all(node.id == str(i) for i, node in enumerate(instance.nodes, start=2))
    return "1" if numbered else "start"


def print_json(answer: Mapping[str, Any]) -> None:
    """Print one JSON document on standard output."""
    click.echo(json.dumps(answer, allow_nan=False))


def print_routes(answer: Mapping[str, Any]) -> None:
    """Print a plan for people: a row an AUV, and the figures that matter."""
    rows = [
        (f"AUV {auv}", len(route), clock(duration), " ".join(route) or "straight home")
        for auv, (route, duration) in enumerate(
            zip(answer["routes"], answer["durations"], strict=True), start=1
        )
    ]
    print_table(answer["instance"], ("", "nodes", "time", "route"), rows, words=(0, 3))
    for name, text in _figures(answer):
        tell(f"{name:<16}{text}")


def print_giant_route(answer: Mapping[str, Any]) -> None:
    """Print a giant route for people."""
    tell(" ".join(answer["order"]))
    tell(f"{'duration':<16}{answer['duration']:.10g} ({clock(answer['duration'])})")
    if answer["bound"] is not None:
        tell(f"{'proven bound':<16}{answer['bound']:.10g}")
    tell(f"{'optimality gap':<16}{gap_text(answer['gap'])}")


def print_verdict(answer: Mapping[str, Any]) -> None:
    """Print the judge's verdict for people."""
    verdict = "feasible" if answer["feasible"] else "NOT feasible"
    rate = 100 * answer["completion_rate"]
    tell(f"{answer['instance']}: {verdict}, {rate:.1f} % of all data collected")
    for violation in answer["violations"]:
        auv, node = violation["auv"], violation["node"]
        places = [f"AUV {auv + 1}"] if auv is not None else []
        places += [f"node {node}"] if node is not None else []
        what = ", ".join([violation["kind"].replace("_", " "), *places])
        tell(f"  {what}: {violation['amount']:.6g}")


def _figures(answer: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    yield "status", f"{answer['status']} ({answer['method']}, {answer['seconds']:.1f} s)"
    if answer["objective"] is not None:
        rate = answer["completion_rate"]
        yield "collected", f"{answer['objective']:.6g} ({100 * rate:.1f} % of all data)"
    if answer["bound"] is not None:
        yield "proven bound", f"{answer['bound']:.6g}"
    yield "optimality gap", gap_text(answer["gap"])
    if answer.get("fleet_estimate") is not None:
        yield "fleet estimate", f"{answer['fleet_estimate']:.2f} AUVs"


def print_table(
    title: str, header: Sequence[str], rows: Iterable[Sequence[object]], *, words: Sequence[int]
) -> None:
    """Print a table for people; columns of `words` are flush left, figures flush right."""
    from rich.console import Console
    from rich.table import Table

    table = Table(title=printable(title), title_justify="left", box=None, pad_edge=False)
    for column, name in enumerate(header):
        table.add_column(name, justify="left" if column in words else "right", overflow="fold")
    for row in rows:
        table.add_row(*(printable(str(cell)) for cell in row))
    width = None if sys.stdout.isatty() else _WIDE
    console = Console(soft_wrap=False, highlight=False, markup=False, emoji=False, width=width)
    console.print(table)


def gap_text(gap: float | None) -> str:
    """A gap as people read it."""
    if gap is None:
        return "unknown"
    if gap > ENDLESS:
        return "endless (nothing collected)"
    return "0 (optimal)" if gap == 0.0 else f"{100 * gap:.2f} %"
