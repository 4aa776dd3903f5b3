"""A server of files for the page of `make page`, and Chromium."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from threading import Thread

import pytest

from tests.browser.conftest import chromium  # noqa: F401 -- a fixture
from tests.browser.machine import ROOT

PAGE = ROOT / "build" / "page"


class _Silent(SimpleHTTPRequestHandler):
    def log_message(self, *_: object) -> None:
        pass


@pytest.fixture(scope="session")
def address() -> Iterator[str]:
    """Where the page is."""
    assert (PAGE / "index.html").is_file(), "make page builds it"
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(_Silent, directory=PAGE))
    Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}/"
    server.shutdown()
    server.server_close()
