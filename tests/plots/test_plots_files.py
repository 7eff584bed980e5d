from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import pytest
from PIL import Image

from fiveroute.errors import InputError
from fiveroute.plots.files import write_film, write_picture
from fiveroute.view.scene import Scene


def test_film_has_its_frames(pond: Scene, tmp_path: Path) -> None:
    path = tmp_path / "film.gif"
    write_film([pond, pond], path, frames=4)
    with Image.open(path) as film:
        assert getattr(film, "n_frames", 1) == 4


def test_two_scenes_are_side_by_side(pond: Scene, bay: Scene, tmp_path: Path) -> None:
    one, two = tmp_path / "one.png", tmp_path / "two.png"
    write_picture([pond], one, run=3)
    write_picture([pond, bay], two)
    with Image.open(one) as narrow, Image.open(two) as wide:
        assert wide.width == 2 * narrow.width


def test_folder_that_cannot_be_written_to(pond: Scene, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="cannot be written"):
        write_picture([pond], tmp_path / "missing" / "plan.png")


def test_titles_are_no_mathematics(pond: Scene, tmp_path: Path) -> None:
    scene = replace(pond, title="\u5e73 $\\frac{$ \x1b")
    write_picture([scene], tmp_path / "plan.svg")
    ElementTree.parse(tmp_path / "plan.svg")
    write_picture([scene], tmp_path / "run.png", run=3)
    write_film([scene], tmp_path / "film.gif", frames=2)
