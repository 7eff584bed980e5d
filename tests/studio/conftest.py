import http.client
import json
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from fiveroute.studio.server import HEADER, Studio
from fiveroute.studio.session import Session

MISSION = {
    "format": "fiveroute-instance/1",
    "name": "bay",
    "nodes": [
        {"id": "a", "x": 400.0, "y": 300.0, "data": 2.0},
        {"id": "b", "x": 900.0, "y": -300.0, "data": 3.0},
        {"id": "far", "x": 1000.0, "y": 2600.0, "data": 4.0},
    ],
    "start": {"x": 0.0, "y": 0.0},
    "destination": {"x": 2000.0, "y": 0.0},
    "fleet": {"size": 1, "speed": 1.0, "endurance": 3200.0},
    "crs": "+proj=aeqd +lat_0=44.0 +lon_0=9.0",
}


@pytest.fixture
def mission_path(tmp_path: Path) -> Path:
    """Three nodes; one AUV collects two of them at the most."""
    path = tmp_path / "bay.json"
    path.write_text(json.dumps(MISSION), encoding="utf-8")
    return path


@pytest.fixture
def session(mission_path: Path) -> Iterator[Session]:
    session = Session.opened(mission_path)
    yield session
    session.close()


@dataclass(frozen=True)
class Reply:
    status: int
    headers: dict[str, str]
    text: str

    @property
    def doc(self) -> dict[str, Any]:
        document: dict[str, Any] = json.loads(self.text)
        return document


class Caller:
    """Asks a studio as its page does, or as it must not be asked."""

    def __init__(self, studio: Studio) -> None:
        self.studio = studio
        self.usual = {
            "Host": studio.hosts[0],
            "Origin": f"http://{studio.hosts[0]}",
            "Content-Type": "application/json",
            HEADER: studio.token,
        }

    def __call__(
        self,
        method: str,
        address: str,
        body: object = None,
        *,
        raw: bytes | None = None,
        without: tuple[str, ...] = (),
        **headers: str,
    ) -> Reply:
        """Send a request; a header's name has _ for -, and those in `without` are left out."""
        sent = self.usual | {name.replace("_", "-"): value for name, value in headers.items()}
        data = json.dumps({} if body is None else body).encode() if raw is None else raw
        if method == "POST":
            sent.setdefault("Content-Length", str(len(data)))
        link = http.client.HTTPConnection("127.0.0.1", self.studio.server_port, timeout=30)
        try:
            link.putrequest(method, address, skip_host=True, skip_accept_encoding=True)
            for name, value in sent.items():
                if name not in without:
                    link.putheader(name, value)
            link.endheaders(data if method == "POST" else None)
            reply = link.getresponse()
            return Reply(reply.status, dict(reply.headers), reply.read().decode())
        finally:
            link.close()

    def read(self, address: str = "/api/state") -> dict[str, Any]:
        reply = self("GET", address)
        assert reply.status == 200, reply.text
        return reply.doc

    def write(self, address: str, body: object = None) -> dict[str, Any]:
        reply = self("POST", address, body)
        assert reply.status == 200, reply.text
        return reply.doc

    def edit(self, **edit: object) -> dict[str, Any]:
        revision = self.read("/api/progress")["revision"]
        return self.write("/api/edit", {"revision": revision, "edit": edit})

    def planned(self, **wish: object) -> dict[str, Any]:
        """The state after planning anew."""
        self.write("/api/plan", wish)
        wait_until(lambda: self.read("/api/progress")["job"]["state"] != "running")
        return self.read()


def wait_until(holds: Callable[[], bool]) -> None:
    """Wait until something holds."""
    end = time.monotonic() + 600.0
    while not holds():
        assert time.monotonic() < end, "it never came true"
        time.sleep(0.02)


@pytest.fixture
def until() -> Callable[[Callable[[], bool]], None]:
    """Wait until something holds."""
    return wait_until


@pytest.fixture
def studio(session: Session) -> Iterator[Studio]:
    with Studio(session) as studio:
        thread = threading.Thread(target=studio.serve_forever, kwargs={"poll_interval": 0.02})
        thread.start()
        yield studio
        studio.shutdown()
        thread.join()


@pytest.fixture
def caller(studio: Studio) -> Caller:
    return Caller(studio)
