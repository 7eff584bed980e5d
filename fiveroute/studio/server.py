"""The server of a studio: this computer's browser may ask, and nobody else.

It listens on the loopback address only. Every request must carry the secret of this run, which
only who started the studio was told, and must be addressed to this computer by name, so that a
page from elsewhere can neither guess it nor reach it under a name of its own (DNS rebinding). It
serves one page and a table of requests, and no files at all.
"""

from __future__ import annotations

import hmac
import json
import secrets
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any
from urllib.parse import parse_qs, urlsplit

import fiveroute
from fiveroute.errors import FiverouteError, InputError
from fiveroute.studio.page import studio_page
from fiveroute.studio.project import ExistsError
from fiveroute.studio.requests import READS, WRITES, answer
from fiveroute.studio.session import Session

__all__ = ["HEADER", "LOOPBACK", "MAX_BODY", "Studio"]

LOOPBACK = "127.0.0.1"
"""The only address that a studio listens on."""

HEADER = "X-Fiveroute-Token"
"""Header that carries the secret."""

MAX_BODY = 2**20
"""Largest body of a request in bytes."""

_PATIENCE = 20.0  # seconds for a request to arrive

_ALWAYS = {
    "Cache-Control": "no-store",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
}

_NOTHING_ELSE = "default-src 'none'; frame-ancestors 'none'"


class _RefusedError(Exception):
    """A request that is not answered, and why."""

    def __init__(self, status: HTTPStatus, sentence: str) -> None:
        self.status = status
        super().__init__(sentence)


class Studio(ThreadingHTTPServer):
    """A session, served.

    Parameters
    ----------
    session
        What is being edited.
    port
        Port on the loopback address; 0 takes a free one.

    Raises
    ------
    InputError
        If the port cannot be had.
    """

    daemon_threads = True
    allow_reuse_address = True

    def __init__(self, session: Session, port: int = 0) -> None:
        self.session = session
        self.token = secrets.token_urlsafe(32)
        self.page = studio_page()
        try:
            super().__init__((LOOPBACK, port), _Handler)
        except OSError as error:
            raise InputError(
                f"cannot be listened on ({error.strerror}); choose another one with --port, or "
                "0 for any",
                field="port",
                value=port,
            ) from None
        self.hosts = tuple(f"{name}:{self.server_port}" for name in (LOOPBACK, "localhost"))

    @property
    def url(self) -> str:
        """Address of the page, with the secret."""
        return f"http://{self.hosts[0]}/?token={self.token}"

    def server_bind(self) -> None:
        """Bind without looking up a name, which could ask the network."""
        self.socket.bind(self.server_address)
        self.server_address = self.socket.getsockname()
        self.server_name, self.server_port = LOOPBACK, self.server_address[1]

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Leave a connection that broke."""


class _Handler(BaseHTTPRequestHandler):
    server: Studio
    timeout = _PATIENCE
    server_version = f"fiveroute/{fiveroute.__version__}"
    sys_version = ""

    def do_GET(self) -> None:
        self._respond(self._read)

    def do_POST(self) -> None:
        self._respond(self._write)

    def _respond(self, produce: Any) -> None:
        try:
            produce()
        except _RefusedError as refusal:
            self._tell(refusal.status, {"error": str(refusal)})
        except ExistsError as error:
            self._tell(HTTPStatus.CONFLICT, {"error": str(error), "exists": error.names})
        except FiverouteError as error:
            self._tell(HTTPStatus.BAD_REQUEST, {"error": str(error)})

    def _read(self) -> None:
        self._require_host()
        address = urlsplit(self.path)
        if address.path == "/":
            self._require_token(parse_qs(address.query).get("token", [""])[0])
            self._send(HTTPStatus.OK, "text/html", self.server.page.text, self.server.page.policy)
            return
        self._require_token(self.headers.get(HEADER, ""))
        if address.path not in READS:
            raise _RefusedError(HTTPStatus.NOT_FOUND, "there is nothing at this address")
        self._tell(HTTPStatus.OK, READS[address.path](self.server.session))

    def _write(self) -> None:
        self._require_host()
        if self.headers.get("Origin") not in [f"http://{host}" for host in self.server.hosts]:
            raise _RefusedError(HTTPStatus.FORBIDDEN, "the request comes from another page")
        self._require_token(self.headers.get(HEADER, ""))
        address = urlsplit(self.path).path
        if address not in WRITES:
            raise _RefusedError(HTTPStatus.NOT_FOUND, "there is nothing at this address")
        self._tell(HTTPStatus.OK, answer(self.server.session, address, self._body()))

    def _require_host(self) -> None:
        if self.headers.get_all("Host", []) not in [[host] for host in self.server.hosts]:
            raise _RefusedError(HTTPStatus.FORBIDDEN, "the request is addressed to another host")

    def _require_token(self, token: str) -> None:
        if not hmac.compare_digest(token.encode(), self.server.token.encode()):
            raise _RefusedError(
                HTTPStatus.FORBIDDEN,
                "the address lacks the secret of this studio; open the one that it printed",
            )

    def _body(self) -> bytes:
        kind = self.headers.get("Content-Type", "").partition(";")[0].strip().lower()
        if kind != "application/json":
            raise _RefusedError(HTTPStatus.UNSUPPORTED_MEDIA_TYPE, "the request must be JSON")
        length = self.headers.get("Content-Length", "")
        if not (length.isascii() and length.isdigit()):
            raise _RefusedError(HTTPStatus.LENGTH_REQUIRED, "the request must state its length")
        if len(length) > len(str(MAX_BODY)) or int(length) > MAX_BODY:
            raise _RefusedError(
                HTTPStatus.REQUEST_ENTITY_TOO_LARGE, f"a request has at most {MAX_BODY} bytes"
            )
        return self.rfile.read(int(length))

    def _tell(self, status: HTTPStatus, document: dict[str, Any]) -> None:
        self._send(status, "application/json", json.dumps(document, allow_nan=False))

    def _send(self, status: HTTPStatus, kind: str, text: str, policy: str = _NOTHING_ELSE) -> None:
        data = text.encode()
        self.send_response(status)
        headers = _ALWAYS | {"Content-Security-Policy": policy}
        headers |= {"Content-Type": f"{kind}; charset=utf-8", "Content-Length": str(len(data))}
        for name, value in headers.items():
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(data)

    def send_error(self, code: int, message: str | None = None, explain: str | None = None) -> None:
        """Tell what the library refuses as we tell our own refusals."""
        self._tell(HTTPStatus(code), {"error": message or HTTPStatus(code).phrase})

    def log_message(self, _format: str, *_values: Any) -> None:
        """Say nothing: the terminal is for the user."""
