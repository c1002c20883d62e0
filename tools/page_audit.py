"""Audits the pages that turtlewire serves, with Lighthouse and axe, and prints a table.

Lighthouse looks at 1280x800 for accessibility, best practices and performance; axe looks at that
size and at a phone's, light and dark. The score of the performance depends on how busy the machine
is: no test asserts it.
"""

from __future__ import annotations

import contextlib
import json
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import early_options
from playwright.sync_api import sync_playwright
from served_pages import PAGES, ServedPage

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

ROOT = Path(__file__).resolve().parent.parent
TOOLS = ROOT / "build" / "npm-tools" / "audit"
DRIVER = ROOT / "tests" / "audit" / "npm" / "audit.mjs"
#: WebGL without a graphics card, and no way to another machine.
CHROMIUM_FLAGS = [
    "--headless=new",
    "--no-sandbox",
    "--disable-quic",
    "--disable-background-networking",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE localhost, EXCLUDE 127.0.0.1",
]
DESKTOP = {"width": 1280, "height": 800}
PHONE = {"width": 390, "height": 844}
SERIOUS = ("serious", "critical")
#: Loading Python takes seconds, and the machine may be busy.
PATIENCE_MS = 120_000
#: Adds up how far the page moves what it has drawn, except right after an input.
WATCH_SHIFTS = """
globalThis.shifts = [];
new PerformanceObserver((list) => shifts.push(...list.getEntries().filter(
    (entry) => !entry.hadRecentInput
))).observe({ type: "layout-shift", buffered: true });
"""
#: A colour half-way to another has the contrast of neither.
TRANSITIONS_END = """() => Promise.allSettled(
    document.getAnimations().filter((each) => each instanceof CSSTransition)
        .map((each) => each.finished)
)"""
#: The shifts that were watched, with the elements that moved.
SHIFTS = """() => shifts.map(({ value, sources }) => ({
    value,
    nodes: sources.map(({ node }) => node?.id || node?.localName || node?.nodeName || "?"),
}))"""


class Audit(NamedTuple):
    """The findings of Lighthouse.

    Attributes:
        scores: Points of 100, by category.
        faults: The audits that cost points, with the places.
        shift: The cumulative layout shift while the page loads.
        bytes: How much was transferred.
        requests: The addresses that were asked.
    """

    scores: dict[str, int]
    faults: list[str]
    shift: float
    bytes: int
    requests: list[str]


def missing() -> str:
    """Return what is missing for audits and what installs it; an empty string if nothing is."""
    if shutil.which("chromium") is None:
        return "no chromium in PATH (Debian: apt install chromium)"
    if shutil.which("node") is None or not (TOOLS / "node_modules").is_dir():
        return "Lighthouse and axe are missing: scripts/npm-tools fetches them (needs node, npm)"
    return ""


def lighthouse(url: str) -> Audit:
    """Audit a page with Lighthouse."""
    command = ["node", str(DRIVER), str(TOOLS), str(shutil.which("chromium")), url]
    done = subprocess.run([*command, *CHROMIUM_FLAGS], capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"Lighthouse failed at {url}:\n{done.stderr}")
    return Audit(**json.loads(done.stdout))


@contextlib.contextmanager
def opened(browser: Browser, page: ServedPage, url: str, **options: Any) -> Iterator[Page]:
    """Open a page in its own profile and wait until it shows its content."""
    with contextlib.closing(browser.new_context(**options)) as context:
        shown = context.new_page()
        shown.set_default_timeout(PATIENCE_MS)
        shown.add_init_script(WATCH_SHIFTS)
        shown.goto(url)
        shown.wait_for_function(f"() => {page.ready}")
        yield shown


def axe_findings(shown: Page) -> list[str]:
    """Return the rules that an open page breaks seriously, with the places."""
    shown.evaluate(TRANSITIONS_END)
    shown.evaluate((TOOLS / "node_modules" / "axe-core" / "axe.min.js").read_text(encoding="utf-8"))
    found = shown.evaluate("() => axe.run({ resultTypes: ['violations'] })")
    return [
        f"{rule['id']}: {' '.join(place['target'][0] for place in rule['nodes'])}"
        for rule in found["violations"]
        if rule["impact"] in SERIOUS
    ]


def main() -> int:
    """Audit the pages that the command line names, or all; the exit status."""
    names = early_options.page_audit(sys.argv[1:]).pages or list(PAGES)
    if text := missing():
        print(f"scripts/page-audit: {text}", file=sys.stderr)
        return 1
    print("page         accessibility  best practices  performance  shift      kB  axe")
    for name in names:
        print_audit(name, PAGES[name])
    return 0


def print_audit(name: str, page: ServedPage) -> None:
    """Audit a page and print its line, and below it what was found."""
    with page.served() as url, sync_playwright() as playwright:
        audit = lighthouse(url)
        with contextlib.closing(
            playwright.chromium.launch(
                executable_path=shutil.which("chromium"), args=CHROMIUM_FLAGS
            )
        ) as browser:
            findings = [
                f"{scheme}, {size['width']}x{size['height']}: {finding}"
                for size in (DESKTOP, PHONE)
                for scheme in ("light", "dark")
                for finding in _findings(browser, page, url, size, scheme)
            ]
    access, practices, performance = (
        audit.scores[key] for key in ("accessibility", "best-practices", "performance")
    )
    print(
        f"{name:<12} {access:>13}  {practices:>14}  {performance:>11}  {audit.shift:>5.3f}"
        f"  {audit.bytes / 1000:>6.0f}  {len(findings):>3}",
        flush=True,
    )
    for line in (*audit.faults, *findings):
        print(f"    {line}")


def _findings(
    browser: Browser, page: ServedPage, url: str, size: dict[str, int], scheme: str
) -> Iterator[str]:
    with opened(browser, page, url, viewport=size, color_scheme=scheme) as shown:
        yield from axe_findings(shown)
        shifts = shown.evaluate(SHIFTS)
    if (shift := sum(entry["value"] for entry in shifts)) > 0.1:
        yield f"shift {shift:.3f} by {shifts}"


if __name__ == "__main__":
    sys.exit(main())
