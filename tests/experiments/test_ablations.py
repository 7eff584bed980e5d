"""Ablations: what is paired with what, and one scenario really sailed."""

import pytest

from fiveroute.experiments.ablations import (
    VARIANTS,
    WHOLE,
    Ablation,
    Trial,
    Variant,
    ablation_table,
    gathered,
    sail_variants,
)
from fiveroute.experiments.coordination_report import report, summary

OTHER = Variant("tier 5", "none", "no-coordination")


def test_scenarios_that_were_cut_short_do_not_count() -> None:
    trials = [
        Trial(1, WHOLE, 0.9, 0.0),
        Trial(1, OTHER, 0.8, 0.1),
        Trial(2, WHOLE, 0.7, 0.0),
        Trial(2, OTHER, 0.6, 0.3),
        Trial(3, WHOLE, 0.1, 0.0),
    ]
    rows = gathered(trials)
    assert rows[0] == Ablation(WHOLE, (0.9, 0.7), 0.0)
    assert rows[1].completions == (0.8, 0.6)
    assert rows[1].late_share == pytest.approx(0.2)
    assert gathered([]) == ()


def test_differences_are_paired() -> None:
    rows = [Ablation(WHOLE, (0.9, 0.7), 0.0), Ablation(OTHER, (0.8, 0.6), 0.02)]
    table = ablation_table(rows)
    assert "-10.0 (-10.0 to -10.0)" in table
    assert "| 0.700 |" in table
    assert "2.0 %" in table
    assert "2 scenarios" in report([], rows, 7)
    assert "Ablations" not in report([], (), 7)
    assert summary([], rows)["ablations"][1]["completion"] == pytest.approx(0.7)


def test_every_variant_has_a_name_of_its_own() -> None:
    assert len({variant.name for variant in VARIANTS}) == len(VARIANTS)
    assert WHOLE not in VARIANTS


def test_a_scenario_sailed() -> None:
    slack = next(variant for variant in VARIANTS if variant.name == "slack 4 %")
    whole, alone, loose = sail_variants(1, 2, variants=[OTHER, slack])
    assert whole.variant == WHOLE
    assert 0.5 < alone.completion < whole.completion < 1.0
    assert 0.5 < loose.completion < 1.0
