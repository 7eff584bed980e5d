from pathlib import Path

import pytest
from matplotlib.figure import Figure

from fiveroute.errors import InputError
from fiveroute.plots.saving import save_figure


def test_a_picture_appears_whole_or_not_at_all(tmp_path: Path) -> None:
    save_figure(Figure(), tmp_path / "map.png")
    assert [p.name for p in tmp_path.iterdir()] == ["map.png"]
    with pytest.raises(InputError, match="cannot be written"):
        save_figure(Figure(), tmp_path / "no" / "map.png")
