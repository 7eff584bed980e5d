"""Tables and pictures of the stochastic experiment, the paper's figures beside ours.

Differences between planners are taken scenario by scenario, since all meet the same luck; their
intervals are percentiles of 10,000 resamples of the scenarios (the bootstrap, Efron 1979,
doi 10.1214/aos/1176344552).
"""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fiveroute.experiments.preplanning_report import statistics_of
from fiveroute.experiments.published import EQUAL_FLEET_ADVANTAGE, FEWER_AUVS, FLEETS, WINS
from fiveroute.experiments.stochastic import COMPETITORS, FIXED_FLEET
from fiveroute.experiments.stochastic_cell import Outcome
from fiveroute.formats.files import require_writable, write_text_atomically

__all__ = ["FILES", "report", "summary", "write_report"]

FILES = ("report.md", "scenarios.csv", "own-fleet.png", "equal-fleet.png", "by-scenario.png")
"""What `write_report` writes."""

_RESAMPLES = 10_000

Means = Mapping[str, NDArray[np.float64]]
"""By planner: the mean completion on every scenario; ``, M = 4`` for the fixed fleet."""


def summary(outcomes: Sequence[Outcome]) -> dict[str, Any]:
    """The figures as one JSON document."""
    means = _means(outcomes)
    equal = _advantage(means, COMPETITORS)
    return {
        "scenarios": len(means["five-tier"]),
        "runs": len(outcomes[0].completions),
        "completion": {name: float(values.mean()) for name, values in means.items()},
        "mean_fleet_size": _mean_fleet(outcomes),
        "wins_at_own_fleet": _wins(means, _fixed()),
        "wins_at_equal_fleet": _wins(means, COMPETITORS),
        "advantage_at_equal_fleet": equal[0],
        "advantage_interval": list(equal[1:]),
        "online_gap": {name: gap for name, gap in _gaps(outcomes).items() if gap is not None},
        "late_share": _late(outcomes),
        "double_visits": sum(outcome.double_visits for outcome in outcomes),
        "actuation": outcomes[0].cell.actuation,
        "min_clearance": _clearance(outcomes),
        "collisions": sum(outcome.collisions for outcome in outcomes),
        "lost": sum(outcome.lost for outcome in outcomes),
    }


def report(outcomes: Sequence[Outcome]) -> str:
    """The report as Markdown text."""
    means, scenarios = _means(outcomes), len(_means(outcomes)["five-tier"])
    equal, low, high = _advantage(means, COMPETITORS)
    worth, worth_low, worth_high = _advantage(means, ("no-coordination",))
    fleet, fleets = _mean_fleet(outcomes), _fleets(outcomes)
    fewer = 1.0 - fleet / FIXED_FLEET
    late = ", ".join(f"{name} {100 * share:.2f} %" for name, share in _late(outcomes).items())
    parts = [
        "# Fleets in an uncertain ocean (Section IV-C and D)",
        f"{scenarios} scenarios, {len(outcomes[0].completions)} oceans each, the same for all "
        "planners. FTCMP and RMMP are reconstructions from what their authors and the paper tell.",
        _table(means),
        "## The paper's figures beside ours",
        "| | paper | ours |\n|---|---|---|\n"
        f"| best of three, M as estimated against 4 and 4 | {WINS['five-tier']} of 20 | "
        f"{_wins(means, _fixed())} of {scenarios} |\n"
        f"| scenarios with 3 and with 4 AUVs | {FLEETS[3]} and {FLEETS[4]} of 20 | "
        f"{fleets.count(3)} and {fleets.count(4)} of {scenarios} |\n"
        f"| fewer AUVs than 4 | {100 * FEWER_AUVS:.1f} % | {100 * fewer:.1f} % |\n"
        f"| more data than the mean of both at equal M | {100 * EQUAL_FLEET_ADVANTAGE:.1f} % | "
        f"{100 * equal:.1f} % ({100 * low:.1f} to {100 * high:.1f}) |\n"
        f"| more data by coordination | 7.6 % in one case | {100 * worth:.1f} % on average "
        f"({100 * worth_low:.1f} to {100 * worth_high:.1f}) |",
        f"At equal M the five-tiered planner is best in {_wins(means, COMPETITORS)} of "
        f"{scenarios} scenarios. Intervals: 95 %, scenarios resampled.",
        "## What the paper does not have",
        _about_gaps(outcomes),
        f"AUVs that came home late: {late}. Double collections: "
        f"{sum(outcome.double_visits for outcome in outcomes)}.",
        *_about_tracks(outcomes),
    ]
    return "\n\n".join(parts) + "\n"


def _about_gaps(outcomes: Sequence[Outcome]) -> str:
    gaps = ", ".join(
        f"{name} {100 * gap:.1f} %" for name, gap in _gaps(outcomes).items() if gap is not None
    )
    if not gaps:
        return "No gap to a clairvoyant plan: a vehicle would have to sail all legs of every run."
    return f"Online gap to the clairvoyant plan: {gaps}."


def _about_tracks(outcomes: Sequence[Outcome]) -> list[str]:
    """What the tracks prove, where a vehicle sailed."""
    clearance = _clearance(outcomes)
    if clearance is None:
        return []
    collisions, lost = (sum(getattr(o, name) for o in outcomes) for name in ("collisions", "lost"))
    return [
        f"Every leg was sailed by a vehicle: {clearance:.1f} m from the nearest obstacle at the "
        f"least, {collisions} collisions, {lost} AUVs that did not arrive."
    ]


def _clearance(outcomes: Sequence[Outcome]) -> float | None:
    """Least clearance in metres of all tracks; None where no vehicle sailed."""
    known = [outcome.min_clearance for outcome in outcomes if outcome.min_clearance is not None]
    return min(known, default=None)


def write_report(outcomes: Sequence[Outcome], folder: Path, force: bool = False) -> None:
    """Write all of `FILES` into a folder."""
    from fiveroute.experiments.pictures import completion_boxes
    from fiveroute.experiments.sea_pictures import scenario_chart
    from fiveroute.plots.saving import save_figure

    for name in FILES:
        require_writable(folder / name, force)
    means = _means(outcomes)
    for file, title, names in (
        ("own-fleet.png", "M as estimated against four AUVs", ("five-tier", *_fixed())),
        ("equal-fleet.png", "The same number of AUVs", ("five-tier", *COMPETITORS)),
    ):
        samples = {_words(name): means[name].tolist() for name in names}
        boxes = completion_boxes(title, samples, {})
        boxes.axes[0].set_ylabel("mean completion rate of a scenario")
        save_figure(boxes, folder / file)
    names, errors = ("five-tier", *_fixed()), _errors(outcomes)
    chart = scenario_chart(
        {_words(name): means[name].tolist() for name in names},
        {_words(name): errors[name].tolist() for name in names},
        _fleets(outcomes),
        FIXED_FLEET,
    )
    save_figure(chart, folder / "by-scenario.png")
    write_text_atomically(folder / "scenarios.csv", _scenario_table(outcomes), force)
    write_text_atomically(folder / "report.md", report(outcomes), force)


def _fixed() -> tuple[str, ...]:
    return tuple(f"{name}, M = {FIXED_FLEET}" for name in COMPETITORS)


def _words(name: str) -> str:
    """The name of a planner as people write it."""
    for planner in COMPETITORS:
        name = name.replace(planner, planner.upper())
    return name


def _name(outcome: Outcome) -> str:
    fleet = outcome.cell.fleet_size
    return outcome.cell.planner + ("" if fleet is None else f", M = {fleet}")


def _means(outcomes: Sequence[Outcome]) -> Means:
    return _by_planner(outcomes, lambda outcome: outcome.mean)


def _errors(outcomes: Sequence[Outcome]) -> Means:
    """Half the widths of the 95 % intervals of the means, over the oceans of a scenario."""

    def error(outcome: Outcome) -> float:
        runs = len(outcome.completions)
        return 1.96 * float(np.std(outcome.completions, ddof=1)) / runs**0.5 if runs > 1 else 0.0

    return _by_planner(outcomes, error)


def _fleets(outcomes: Sequence[Outcome]) -> list[int]:
    """AUVs of the five-tiered planner on every scenario."""
    sizes = _by_planner(outcomes, lambda outcome: float(outcome.fleet_size))["five-tier"]
    return [int(size) for size in sizes]


def _by_planner(outcomes: Sequence[Outcome], figure: Callable[[Outcome], float]) -> Means:
    """In the order of the scenarios, those only that all planners have sailed."""
    table: dict[str, dict[int, float]] = {}
    for outcome in outcomes:
        table.setdefault(_name(outcome), {})[outcome.cell.scenario] = figure(outcome)
    whole = sorted(set.intersection(*(set(row) for row in table.values())))
    return {name: np.array([row[scenario] for scenario in whole]) for name, row in table.items()}


def _wins(means: Means, others: Sequence[str]) -> int:
    rivals = np.max([means[name] for name in others], axis=0)
    return int((means["five-tier"] >= rivals).sum())


def _advantage(means: Means, others: Sequence[str]) -> tuple[float, float, float]:
    """Relative to the mean of others, and its 95 % interval."""
    ours, theirs = means["five-tier"], np.mean([means[name] for name in others], axis=0)
    rng = np.random.default_rng(0)
    picks = rng.integers(len(ours), size=(_RESAMPLES, len(ours)))
    resampled = ours[picks].mean(axis=1) / theirs[picks].mean(axis=1) - 1.0
    low, high = np.percentile(resampled, (2.5, 97.5)).tolist()
    return float(ours.mean() / theirs.mean() - 1.0), low, high


def _mean_fleet(outcomes: Sequence[Outcome]) -> float:
    return float(np.mean([o.fleet_size for o in outcomes if _name(o) == "five-tier"]))


def _gaps(outcomes: Sequence[Outcome]) -> dict[str, float | None]:
    gaps: dict[str, list[float]] = {}
    for outcome in outcomes:
        if outcome.online_gap is not None:
            gaps.setdefault(_name(outcome), []).append(outcome.online_gap)
    return {name: float(np.mean(values)) for name, values in gaps.items()}


def _late(outcomes: Sequence[Outcome]) -> dict[str, float]:
    late: dict[str, list[int]] = {}
    for outcome in outcomes:
        counts = late.setdefault(_name(outcome), [0, 0])
        counts[0] += outcome.late_returns
        counts[1] += outcome.fleet_size * len(outcome.completions)
    return {name: returns / max(auvs, 1) for name, (returns, auvs) in late.items()}


def _table(means: Means) -> str:
    lines = ["| planner | mean | std | min | median | max |", "|---|---|---|---|---|---|"]
    for name, values in means.items():
        box = statistics_of(values)
        figures = (box.mean, box.std, box.min, box.median, box.max)
        lines.append(f"| {name} | " + " | ".join(f"{figure:.3f}" for figure in figures) + " |")
    return "\n".join(lines)


def _scenario_table(outcomes: Sequence[Outcome]) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["scenario", "planner", "fleet_size", "planned", "mean", "online_gap", "late"])
    for outcome in sorted(outcomes, key=lambda o: (o.cell.scenario, _name(o))):
        gap = "" if outcome.online_gap is None else outcome.online_gap
        writer.writerow(
            [
                outcome.cell.scenario,
                outcome.cell.planner,
                outcome.fleet_size,
                outcome.planned,
                outcome.mean,
                gap,
                outcome.late_returns,
            ]
        )
    return text.getvalue()
