"""The built lesson, served to this machine, and pages of it that report their errors."""

from __future__ import annotations

import importlib.util
import subprocess
import sys
import threading

import pytest
from tests.places import SCRIPTS

#: Loading Python takes seconds, and the machine may be busy.
LONG_MS = 100_000


def static_server(folder):
    """The server of `scripts/docs --serve` and `scripts/lesson --serve`."""
    path = SCRIPTS / "static_server.py"
    spec = importlib.util.spec_from_file_location("static_server", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    module.StaticPages.log_message = lambda *_: None
    return module.static_server(folder, 0)


class Host:
    """A static host, which can be switched off."""

    def __init__(self, folder):
        self._server = static_server(folder)
        self.url = f"http://localhost:{self._server.server_address[1]}/"
        self._thread = threading.Thread(target=self._server.serve_forever)
        self._thread.start()
        self.is_open = True

    def close(self):
        if self.is_open:
            self.is_open = False
            self._server.shutdown()
            self._thread.join()
            self._server.server_close()


@pytest.fixture(scope="session")
def built(tmp_path_factory):
    """The lesson as `scripts/lesson` builds it."""
    folder = tmp_path_factory.mktemp("site") / "lesson"
    script = SCRIPTS / "lesson.py"
    done = subprocess.run(
        [sys.executable, str(script), "--output", str(folder)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return folder


@pytest.fixture
def host(built):
    host = Host(built)
    yield host
    host.close()


@pytest.fixture
def open_page(browser, host):
    """Opens the lesson in a fresh browser profile and waits until it runs."""
    contexts, errors = [], []

    def open_page(lesson="", **options):
        context = browser.new_context(**{"viewport": {"width": 1500, "height": 950}, **options})
        contexts.append(context)
        context.set_default_timeout(LONG_MS)
        page = context.new_page()
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.on(
            "request",
            lambda request: (
                errors.append(request.url)
                if not request.url.startswith((host.url, "blob:", "data:"))
                else None
            ),
        )
        page.goto(f"{host.url}#{lesson}")
        wait_until_loaded(page)
        return page

    yield open_page
    for context in contexts:
        context.close()
    assert errors == []


def wait_until_loaded(page):
    page.wait_for_function("() => document.body?.dataset.loadedMs !== undefined", timeout=LONG_MS)
