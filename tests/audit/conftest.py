"""The modules of `scripts` that serve and audit pages, and each page that turtlewire serves."""

from __future__ import annotations

import contextlib
import importlib
import sys

import pytest
from tests.places import ROOT, TOOLS

PAGES = ["view", "graph", "turtlesim", "sliders", "class", "lesson", "site", "site's page"]
BUILT = {"lesson": "lesson", "site": "site", "site's page": "site"}


@pytest.fixture(scope="session")
def audit():
    """The module `tools/page_audit.py`."""
    sys.path.insert(0, str(TOOLS))
    try:
        module = importlib.import_module("page_audit")
    finally:
        sys.path.remove(str(TOOLS))
    assert list(module.PAGES) == PAGES
    if text := module.missing():
        pytest.skip(text)
    return module


@pytest.fixture(scope="module", params=PAGES)
def name(request):
    """The name of a page; all tests of one come before those of the next."""
    if folder := BUILT.get(request.param):
        script = {"lesson": "scripts/lesson", "site": "scripts/docs"}[folder]
        if not (ROOT / "build" / folder / "index.html").exists():
            pytest.skip(f"build/{folder} is missing: {script} builds it")
    return request.param


@pytest.fixture(scope="module")
def url(audit, name):
    """The address of the page while it is served."""
    with audit.PAGES[name].served() as url:
        yield url


@pytest.fixture(scope="module")
def open_page(audit, name, url, chromium):
    """Opens the page and waits until it shows its content; `flags` are for Chromium."""
    stack = contextlib.ExitStack()
    browsers = {}

    def open_page(*flags, **options):
        if flags not in browsers:
            closing = contextlib.closing(chromium([*audit.CHROMIUM_FLAGS, *flags]))
            browsers[flags] = stack.enter_context(closing)
        return audit.opened(browsers[flags], audit.PAGES[name], url, **options)

    with stack:
        yield open_page
