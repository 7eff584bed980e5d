"""A command that is killed leaves the old file or the new one; `benchmarks/kill.py` goes on."""

import subprocess
import sys
from pathlib import Path

import pytest

SOURCE = Path(__file__).parents[2] / "benchmarks" / "kill.py"


@pytest.mark.parametrize("command", ["generate", "export-folder"])
def test_a_killed_command_leaves_nothing_half(command: str) -> None:
    if not SOURCE.is_file():
        pytest.skip("the long run is not shipped here")
    done = subprocess.run(
        [sys.executable, str(SOURCE), command, "--count", "6"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "0 findings" in done.stdout
