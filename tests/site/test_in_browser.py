"""The built site in Chromium, without a network: search, dark, a phone, and the lesson's button."""

import subprocess
import sys

import pytest
from tests.places import ROOT, TOOLS
from tests.plain_server import LONG_MS, Host

pytestmark = [pytest.mark.slow, pytest.mark.timeout(900)]
PHONE = {"viewport": {"width": 390, "height": 844}}


@pytest.fixture(scope="session")
def built():
    """The site as `scripts/docs` builds it, with the lesson that `scripts/lesson` has built."""
    output = ROOT / "build" / "site"
    done = subprocess.run(
        [sys.executable, str(TOOLS / "docs.py")], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return output


@pytest.fixture
def open_page(browser, built):
    """Opens pages of a static host; a request that leaves it fails the test."""
    host = Host(built)
    contexts, foreign = [], []

    def route(request):
        if request.request.url.startswith((host.url, "blob:", "data:")):
            request.continue_()
        else:
            foreign.append(request.request.url)
            request.abort()

    def open_page(path="", **options):
        context = browser.new_context(**{"viewport": {"width": 1280, "height": 800}, **options})
        contexts.append(context)
        context.set_default_timeout(LONG_MS)
        context.route("**/*", route)
        page = context.new_page()
        page.goto(f"{host.url}{path}")
        return page

    yield open_page
    for context in contexts:
        context.close()
    host.close()
    assert foreign == []


def test_the_front_page_leads_to_the_lesson(open_page):
    page = open_page()
    assert page.inner_text("h1").startswith("turtlewire")
    assert page.locator(".run-lesson a").get_attribute("href") == "lesson/index.html"
    page.click(".hero-buttons a >> nth=0")
    page.wait_for_url("**/lesson/index.html")
    if (ROOT / "build" / "lesson" / "manifest.json").exists():
        page.wait_for_function("() => document.body?.dataset.loadedMs !== undefined")
    else:
        assert "not in this build" in page.inner_text("h1")


def test_the_search_finds_a_method(open_page):
    page = open_page()
    page.fill("input[name=q]", "lookup_transform")
    page.keyboard.press("Enter")
    page.locator("#search-results li a", has_text="lookup_transform").first.wait_for()
    page.locator("#search-results li a", has_text="lookup_transform").first.click()
    page.wait_for_url("**/reference/**")


def test_the_search_finds_an_error(open_page):
    page = open_page("search.html?q=extrapolation+into+the+past")
    page.locator(
        "#search-results li a", has_text="Troubleshooting: error messages"
    ).first.wait_for()


def test_dark_follows_the_system_and_the_button(open_page):
    page = open_page("glossary.html", color_scheme="dark")
    ground = "getComputedStyle(document.body).backgroundColor"
    dark = page.evaluate(ground)
    page.locator(".theme-toggle:visible").first.click()
    page.wait_for_function(f"() => {ground} !== {dark!r}")
    assert sum(map(int, dark[4:-1].split(","))) < 150


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_no_page_is_wider_than_a_phone(open_page, built, scheme):
    page = open_page(**PHONE, color_scheme=scheme)
    base = page.url
    for path in sorted(built.rglob("*.html")):
        name = path.relative_to(built).as_posix()
        if not name.startswith("lesson/"):
            page.goto(f"{base}{name}", wait_until="domcontentloaded")
            assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), name


def test_a_wrong_address_shows_a_page_whose_links_work(open_page, built):
    page = open_page()
    front = page.url
    text = (built / "404.html").read_text(encoding="utf-8")
    page.context.route("**/no/such/page", lambda route: route.fulfill(status=404, body=text))
    page.goto(f"{front}no/such/page")
    assert page.inner_text("h1").startswith("Page not found")
    page.get_by_role("link", name="the front page").click()
    page.wait_for_url(f"{front}index.html")
