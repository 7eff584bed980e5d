"""What all tests share.

Random problems are the same in every run, so that a failure is somebody's doing and can be
repeated; `HYPOTHESIS_PROFILE=explore make test` draws new ones.
"""

from __future__ import annotations

import os
from collections.abc import Iterator

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
