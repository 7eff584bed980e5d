"""The Python example of README.md prints what README.md says."""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parent.parent


def test_the_example_prints_its_answer(tmp_path: Path) -> None:
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    found = re.search(r"```python\n(.*?)```\n\n```text\n(.*?)```", text, re.DOTALL)
    assert found is not None
    code, answer = found.groups()
    (tmp_path / "instances").symlink_to(ROOT / "instances")
    call = [sys.executable, "-c", code]
    assert subprocess.check_output(call, text=True, cwd=tmp_path) == answer
    assert (tmp_path / "plan.json").exists()
    assert (tmp_path / "plan.html").exists()


def test_every_file_that_it_names_is_there() -> None:
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    for target in re.findall(r"\]\(([^)#]+)\)", text):
        assert (ROOT / target).exists(), target
