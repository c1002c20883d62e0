"""The lesson in Firefox: each lesson is solved by its solution, served and opened as a file."""

from __future__ import annotations

import json
import shutil

import pytest

from turtle_lesson.lesson import load_lesson

from .firefox import Firefox
from .test_in_browser import CHECK, HAND_IN, LESSONS, ORDER

pytestmark = [pytest.mark.slow, pytest.mark.timeout(600)]
FIREFOX = shutil.which("firefox-esr") or shutil.which("firefox")


@pytest.fixture
def firefox(tmp_path):
    if FIREFOX is None:
        pytest.skip("no firefox in PATH (Debian: apt install firefox-esr)")
    firefox = Firefox(FIREFOX, tmp_path)
    yield firefox
    firefox.close()
    assert firefox.errors == []


@pytest.mark.parametrize("kind", ["served", "file"])
def test_the_lessons_are_solved(firefox, kind, host, built):
    firefox.open(host.url if kind == "served" else (built / "index.html").as_uri())
    firefox.wait_for("document.body?.dataset.loadedMs !== undefined")
    assert firefox.evaluate("crossOriginIsolated") == (kind == "served")
    for name in ORDER if kind == "served" else ORDER[:1]:
        files = load_lesson(LESSONS / name).solution()
        firefox.evaluate(f"({HAND_IN})({json.dumps([name, files])})")
        results = firefox.evaluate(CHECK)
        assert len(results) >= 3
        assert all(passed == "yes" for passed, _ in results), results
