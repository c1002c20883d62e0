"""`turtlewire view` of a running robot: time from the command to the first picture with frames.

The browser is open already (headless Chromium without a graphics card) and gets the address as
soon as the command prints it. The first row is until the address is printed; the second until the
page has drawn frames. The rival is a Python that imports numpy and ends.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from typing import Any

from benchmarks.figures import Figure, Row
from benchmarks.view_growth import robot, running_view
from benchmarks.view_page import FLAGS

TITLE = "3D view: from the command to the first picture"
ROUNDS = 5
#: When the first picture with frames was drawn [ms since the epoch].
DRAWN = """async () => {
    const { frames, stage } = await import("./js/main.js");
    return new Promise((done) => stage.view.afterDraw(() => {
        if (frames.known.some((known) => known)) done(performance.timeOrigin + performance.now());
    }));
}"""


def rows() -> Iterator[Row]:
    from playwright.sync_api import sync_playwright

    chromium = shutil.which("chromium")
    if chromium is None:
        return
    told: list[float] = []
    drawn: list[float] = []
    python: list[float] = []
    with robot(), sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=FLAGS)
        for _ in range(ROUNDS):
            python.append(time_of_python())
            page = browser.new_page(viewport={"width": 1280, "height": 720})
            for times, value in zip((told, drawn), time_of_view(page), strict=True):
                times.append(value)
            page.close()
        browser.close()
    rival = {"python, numpy": Figure.of(python, factor=1e9)}
    yield Row("until the address is told", Figure.of(told, factor=1e9), rival)
    yield Row("until frames are drawn", Figure.of(drawn, factor=1e9), rival, "<= 1 s")


def time_of_python() -> float:
    begin = time.monotonic()
    subprocess.run([sys.executable, "-c", "import numpy"], check=True)
    return time.monotonic() - begin


def time_of_view(page: Any) -> tuple[float, float]:
    """Seconds until the address is told, and until frames are drawn."""
    begin = time.time()
    with running_view() as (url, _):
        told = time.time() - begin
        page.goto(url, wait_until="commit")
        return told, page.evaluate(DRAWN) / 1000 - begin
