import pytest
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from fiveroute.plots import plot_gap


def test_bars_are_data_and_what_is_open() -> None:
    own = Figure().subplots()
    ax = plot_gap({"ours": (8.0, 10.0), "theirs": (6.0, None)}, own)
    assert ax is own
    bars = [patch for patch in ax.patches if isinstance(patch, Rectangle)]
    assert [bar.get_width() for bar in bars] == pytest.approx([8.0, 2.0, 6.0])
    assert [text.get_text().strip() for text in ax.texts] == ["8, gap 25.0%", "6"]
    assert [label.get_text() for label in ax.get_yticklabels()] == ["ours", "theirs"]
