import re
import signal
import socket
import subprocess
import sys
import urllib.request
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Call = Callable[..., Any]


@pytest.mark.skipif(sys.platform == "win32", reason="needs Ctrl-C as a signal")
def test_it_serves_until_ctrl_c(tiny: Path) -> None:
    command = [sys.executable, "-m", "fiveroute", "studio", str(tiny), "--no-browser"]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with subprocess.Popen(command, text=True, **pipes) as process:  # type: ignore[call-overload]
        try:
            url = process.stdout.readline().strip()
            assert re.fullmatch(r"http://127\.0\.0\.1:\d+/\?token=[\w-]{40,}", url)
            with urllib.request.urlopen(url, timeout=10) as reply:
                assert reply.status == 200
            process.send_signal(signal.SIGINT)
            _, err = process.communicate(timeout=20)
        finally:
            process.kill()
    assert process.returncode == 0
    assert err.splitlines()[-1] == "fiveroute: the studio is closed"


def test_wrong_calls_are_one_line(call: Call, tiny: Path, tmp_path: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        busy = call("studio", tiny, "--no-browser", "--port", port)
    assert busy.code == 2
    assert f"port: {port}: cannot be listened on" in busy.err
    missing = call("studio", tmp_path / "none.json", "--no-browser")
    assert missing.code == 2
    assert "does not exist" in missing.err
    folder = call("studio", tiny, "--no-browser", "--folder", tmp_path / "none")
    assert "is no folder" in folder.err
    assert busy.err.count("\n") == missing.err.count("\n") == folder.err.count("\n") == 1
