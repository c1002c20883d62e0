"""The built lesson, served to this machine, and pages of it that report their errors."""

import subprocess
import sys

import pytest
from tests.places import TOOLS
from tests.plain_server import LONG_MS, Host


@pytest.fixture(scope="session")
def built(tmp_path_factory):
    """The lesson as `scripts/lesson` builds it."""
    folder = tmp_path_factory.mktemp("site") / "lesson"
    script = TOOLS / "lesson.py"
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
