"""The report on coordination: the paper's cases beside ours, pictures, and the ablations."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from fiveroute.experiments.ablations import FLEET, Ablation, ablation_table, slack_plan
from fiveroute.experiments.coordination_cases import Case, Sailed, busiest_auction
from fiveroute.experiments.published import COORDINATED, COORDINATION_GAIN
from fiveroute.formats.files import require_writable, write_text_atomically

__all__ = ["FILES", "report", "summary", "write_report"]

FILES = ("report.md", "coordination-3.png", "coordination-4.png", "timeline.png", "auction.png")
"""What `write_report` writes."""

_SLACK = 1.2  # of the plan whose auction is shown
_RUNS = 10  # listened to for it


def summary(cases: Sequence[Case], rows: Sequence[Ablation]) -> dict[str, Any]:
    """The figures as one JSON document."""
    return {
        "cases": [
            {
                "scenario": case.scenario,
                "fleet_size": len(case.plan.routes),
                "runs": len(case.gains),
                "planned": case.planned,
                "without": _mean(case.alone),
                "with": _mean(case.together),
                "greatest_gain": float(case.gains.max()),
            }
            for case in cases
        ],
        "ablations": [
            {
                "group": row.variant.group,
                "name": row.variant.name,
                "completion": float(np.mean(row.completions)),
                "late_share": row.late_share,
            }
            for row in rows
        ],
    }


def report(cases: Sequence[Case], rows: Sequence[Ablation], runs: int) -> str:
    """The report as Markdown text."""
    parts = [
        "# Coordination (Section IV-C)",
        "One plan each, sailed with and without tier 5 in the same oceans. The pictures show the "
        "run whose gain is nearest to the mean; the paper shows one run, and does not say which. "
        "The plans are the five-tiered planner's; without tier 5 a fleet does better with a more "
        "cautious one, see the ablations.",
        _case_table(cases),
    ]
    if rows:
        scenarios = len(rows[0].completions)
        parts += [
            "## Ablations",
            f"{scenarios} scenarios, {runs} oceans each, M = {FLEET}. Differences to the first row "
            "are paired; intervals: 95 %, scenarios resampled.",
            ablation_table(rows),
        ]
    return "\n\n".join(parts) + "\n"


def write_report(
    cases: Sequence[Case],
    rows: Sequence[Ablation],
    runs: int,
    folder: Path,
    force: bool = False,
) -> None:
    """Write all of `FILES` into a folder."""
    from fiveroute.experiments.sea_pictures import auction_rounds, coordination_case, timeline
    from fiveroute.plots.saving import save_figure

    for name in FILES:
        require_writable(folder / name, force)
    for case in cases:
        save_figure(coordination_case(case), folder / f"coordination-{len(case.plan.routes)}.png")
    case = cases[-1]
    run = case.together[case.typical]
    title = f"Scenario {case.scenario}: a run with coordination, hour by hour"
    save_figure(timeline(case.world.problem, run.events, title), folder / "timeline.png")
    loose = slack_plan(case.instance, _SLACK, fleet_size=len(case.plan.routes))
    title = f"Scenario {case.scenario}: an auction among AUVs with time to spare"
    rounds = busiest_auction(case.world, loose, _RUNS)
    save_figure(auction_rounds(rounds, title), folder / "auction.png")
    write_text_atomically(folder / "report.md", report(cases, rows, runs), force)


def _mean(runs: Sequence[Any]) -> float:
    return float(np.mean([run.completion for run in runs]))


def _case_table(cases: Sequence[Case]) -> str:
    lines = [
        "| | plan | without | with | gain | in the run shown | greatest gain | paper: with, gain |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for case in cases:
        fleet, without, with_it = len(case.plan.routes), _mean(case.alone), _mean(case.together)
        shown = [Sailed.of(runs[case.typical], case.plan) for runs in (case.alone, case.together)]
        paper = f"{COORDINATED[fleet]:.3f}" if fleet in COORDINATED else "-"
        if fleet in COORDINATION_GAIN:
            paper += f", {100.0 * COORDINATION_GAIN[fleet]:+.1f} %"
        lines.append(
            f"| scenario {case.scenario}, M = {fleet} | {case.planned:.3f} | {without:.3f} | "
            f"{with_it:.3f} | {100.0 * (with_it / without - 1.0):+.1f} % | "
            f"{shown[0].completion:.3f} to {shown[1].completion:.3f} | "
            f"{100.0 * case.gains.max():+.1f} points | {paper} |"
        )
    return "\n".join(lines)
