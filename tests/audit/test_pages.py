"""Each page with Lighthouse, with axe, and with what neither measures: `looks.js`.

The score of the performance, which depends on how busy the machine is, is printed and not
asserted (`scripts/page-audit` shows it, too); what it is made of and does not depend on that is:
the bytes, and that nothing moves while a page loads.
"""

import contextlib
from pathlib import Path

import page_audit
import pytest
from tests.places import ROOT

PAGES = ["view", "graph", "turtlesim", "sliders", "class", "lesson", "site", "site's page"]
BUILT = {"lesson": "lesson", "site": "site", "site's page": "site"}


@pytest.fixture(scope="session")
def audit():
    """The module `tools/page_audit.py`."""
    assert list(page_audit.PAGES) == PAGES
    if text := page_audit.missing():
        pytest.skip(text)
    return page_audit


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


pytestmark = [pytest.mark.slow, pytest.mark.timeout(600)]
LOOKS = (Path(__file__).parent / "looks.js").read_text(encoding="utf-8")
LEAST_SCORE = 95
MOST_SHIFT = 0.1
#: What a first visit may transfer; the static pages are served without compression here.
MOST_KB = {
    "view": 400,
    "graph": 60,
    "turtlesim": 60,
    "sliders": 30,
    "class": 20,
    "lesson": 1500,
    "site": 700,
    "site's page": 400,
}
DESKTOP = {"width": 1280, "height": 800}
PHONE = {"width": 390, "height": 844}


def test_lighthouse_finds_nothing_that_matters(audit, name, url):
    found = audit.lighthouse(url)
    print(f"{name}: performance {found.scores['performance']}")
    assert found.scores["accessibility"] >= LEAST_SCORE, found.faults
    assert found.scores["best-practices"] >= LEAST_SCORE, found.faults
    assert found.shift <= MOST_SHIFT
    assert 0 < found.bytes <= 1000 * MOST_KB[name]
    ours = (url, "data:", "blob:")
    origin = url.rpartition("/")[0]
    assert [asked for asked in found.requests if not asked.startswith((origin, *ours))] == []


@pytest.mark.parametrize("size", [DESKTOP, PHONE], ids=["desktop", "phone"])
def test_axe_finds_nothing_serious_and_nothing_moves(audit, open_page, size):
    with open_page(viewport=size) as page:
        page.keyboard.press("Tab")  # a keyboard is in use: focus rings are drawn
        for scheme in ("light", "dark"):
            page.emulate_media(color_scheme=scheme)
            assert audit.axe_findings(page) == [], scheme
            assert page.evaluate(LOOKS) == [], scheme
        shifts = page.evaluate(audit.SHIFTS)
    assert sum(shift["value"] for shift in shifts) <= MOST_SHIFT, shifts


def test_texts_grow_with_the_size_that_the_browser_is_set_to(open_page):
    size = "parseFloat(getComputedStyle(document.body).fontSize)"
    with open_page(viewport=DESKTOP) as page:
        normal = page.evaluate(size)
    with open_page("--blink-settings=defaultFontSize=32", viewport=DESKTOP) as page:
        assert page.evaluate(size) == pytest.approx(2 * normal)
