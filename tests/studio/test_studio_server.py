"""Who may ask a studio, and what it answers."""

import socket
import urllib.error
import urllib.request
from typing import Any

import pytest

from fiveroute.errors import InputError
from fiveroute.studio.server import HEADER, LOOPBACK, MAX_BODY, Studio
from fiveroute.studio.session import Session

READ, EDIT = "/api/state", "/api/edit"


def test_the_page_is_for_who_knows_the_secret(studio: Studio, caller: Any) -> None:
    with urllib.request.urlopen(studio.url, timeout=10) as reply:
        text, headers = reply.read().decode(), reply.headers
    assert studio.token not in text
    assert "bay" not in text
    assert headers["Cache-Control"] == "no-store"
    policy = headers["Content-Security-Policy"]
    assert "default-src 'none'; script-src 'sha256-" in policy
    assert "unsafe" not in policy
    assert "connect-src 'self'; frame-ancestors 'none'" in policy
    wrong = f"http://{studio.hosts[0]}/?token={'x' * len(studio.token)}"
    for url in (wrong, f"http://{studio.hosts[0]}/"):
        with pytest.raises(urllib.error.HTTPError, match="403") as refusal:
            urllib.request.urlopen(url, timeout=10)
        refusal.value.close()
    assert caller("GET", f"/?token={studio.token}", Host="evil.example").status == 403


def test_it_listens_to_this_computer_alone(studio: Studio, session: Session) -> None:
    assert studio.server_address[0] == LOOPBACK
    with pytest.raises(InputError, match=r"port: .* cannot be listened on .*--port"):
        Studio(session, studio.server_port)


def test_every_run_has_a_secret_of_its_own(session: Session) -> None:
    with Studio(session) as one, Studio(session) as other:
        assert one.token != other.token
        assert len(one.token) >= 32


@pytest.mark.parametrize(("method", "address"), [("GET", READ), ("POST", EDIT)])
@pytest.mark.parametrize(
    ("without", "changed"),
    [
        ((HEADER,), {}),
        ((), {"X_Fiveroute_Token": "wrong"}),
        ((), {"X_Fiveroute_Token": "\xe4"}),
        (("Host",), {}),
        ((), {"Host": "evil.example"}),
        ((), {"Host": "127.0.0.1:1"}),
    ],
)
def test_strangers_are_refused(
    caller: Any, method: str, address: str, without: tuple[str, ...], changed: dict[str, str]
) -> None:
    reply = caller(method, address, without=without, **changed)
    assert reply.status == 403
    assert list(reply.doc) == ["error"]


@pytest.mark.parametrize("origin", [None, "null", "http://evil.example", "http://127.0.0.1:1"])
def test_other_pages_cannot_write(caller: Any, origin: str | None) -> None:
    changed = {} if origin is None else {"Origin": origin}
    without = ("Origin",) if origin is None else ()
    assert caller("POST", "/api/undo", without=without, **changed).status == 403
    localhost = caller.studio.hosts[1]
    assert caller("POST", "/api/undo", Host=localhost, Origin=f"http://{localhost}").status == 200


@pytest.mark.parametrize(
    "address",
    ["/bay.json", "/../bay.json", "/%2e%2e/bay.json", "/api/../../etc/passwd", "//etc/passwd"],
)
def test_there_are_no_files(caller: Any, address: str) -> None:
    assert caller("GET", address).status == 404
    assert caller("POST", address).status == 404


def test_bodies_are_small_json(caller: Any) -> None:
    assert caller("POST", EDIT, Content_Length=str(MAX_BODY + 1), raw=b"").status == 413
    assert caller("POST", EDIT, Content_Length="9" * 5000, raw=b"").status == 413
    assert caller("POST", EDIT, Content_Length="-1", raw=b"").status == 411
    assert caller("POST", EDIT, Content_Type="text/plain").status == 415
    broken = caller("POST", EDIT, raw=b"{")
    assert broken.status == 400
    assert "is no JSON" in broken.doc["error"]
    assert caller("POST", EDIT, raw=b"[" * 100_000).status == 400
    unknown = caller("POST", EDIT, {"revision": 0, "edit": {"do": "undress"}})
    assert unknown.status == 400
    assert caller("PUT", EDIT).status == 501


def test_silent_connections_hold_nobody_up(studio: Studio, caller: Any) -> None:
    with socket.create_connection(("127.0.0.1", studio.server_port)) as silent:
        silent.sendall(b"POST /api/edit HTTP/1.1\r\n")
        assert caller.read()["undo"] is False
