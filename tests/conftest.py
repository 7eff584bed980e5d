"""What all tests share.

Random problems are the same in every run, so that a failure is somebody's doing and can be
repeated; `HYPOTHESIS_PROFILE=explore make test` draws new ones. Public files are read where the
environment variable FIVEROUTE_DATA names their folder.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from hypothesis import settings

settings.register_profile("fixed", derandomize=True)
settings.register_profile("explore", derandomize=False)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "fixed"))


@pytest.fixture(autouse=True, scope="session")
def _own_cache(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Leg tables of tests are kept apart from those of the user."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("FIVEROUTE_CACHE", str(tmp_path_factory.mktemp("cache")))
        yield


@pytest.fixture(scope="session")
def public_file() -> Callable[[str], Path]:
    """A file in the folder of public files by its name there; a test without it is skipped."""

    def find(name: str) -> Path:
        folder = os.environ.get("FIVEROUTE_DATA")
        if not folder:
            pytest.skip("set FIVEROUTE_DATA to the folder of public files")
        path = Path(folder) / name
        if not path.is_file():
            pytest.skip(f"FIVEROUTE_DATA names a folder without {name}")
        return path

    return find
