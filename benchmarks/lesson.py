"""The lesson in a browser tab: weight, load, restart, frames a second."""

from __future__ import annotations

import functools
import http.server
import json
import shutil
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator
from pathlib import Path

from benchmarks.figures import Figure, Row

TITLE = "the lesson in a browser tab (Chromium, without a graphics card)"
SCRIPT = Path(__file__).parents[1] / "tools" / "lesson.py"
RESTARTS = 9
SECONDS = 10
LONG_MS = 300_000

#: Animation frames in so many seconds, and the seconds that passed in the simulation.
WATCH = """(seconds) => new Promise((resolve) => {
    const simulated = () => parseFloat(document.getElementById("clock").textContent);
    const [begin, before] = [performance.now(), simulated()];
    let frames = 0;
    const frame = (now) => {
        frames += 1;
        if (now - begin < 1000 * seconds) requestAnimationFrame(frame);
        else resolve([frames, (now - begin) / 1000, simulated() - before]);
    };
    requestAnimationFrame(frame);
})"""


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_: object) -> None:
        """No line for each file."""


def rows() -> Iterator[Row]:
    from playwright.sync_api import sync_playwright

    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "lesson"
        subprocess.run([sys.executable, SCRIPT, "--output", output], check=True, stdout=2)
        weight = json.loads((output / "manifest.json").read_text(encoding="utf-8"))["compressed"]
        yield Row("weight, gzipped", Figure.of([weight / 1e6], "MB"), {}, "<= 15 MB")
        handler = functools.partial(Quiet, directory=output)
        with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
            threading.Thread(target=server.serve_forever, daemon=True).start()
            with sync_playwright() as playwright:
                browser = playwright.chromium.launch(
                    executable_path=shutil.which("chromium"), args=["--no-sandbox"]
                )
                page = browser.new_page()
                yield from measured(page, f"http://localhost:{server.server_address[1]}/#listener")
                browser.close()
            server.shutdown()


def measured(page, url: str) -> Iterator[Row]:
    def load() -> Figure:
        page.wait_for_function("document.body.dataset.loadedMs", timeout=LONG_MS)
        return Figure.of([1e6 * float(page.evaluate("document.body.dataset.loadedMs"))])

    page.goto(url)
    yield Row("first load, from this host, until turtles move", load())
    page.reload()
    yield Row("load again, from the service worker's cache", load())
    restarts = []
    for _ in range(RESTARTS):
        page.evaluate("delete document.getElementById('run').dataset.milliseconds")
        page.click("#run")
        page.wait_for_function(
            "document.getElementById('run').dataset.milliseconds", timeout=LONG_MS
        )
        restarts.append(float(page.get_attribute("#run", "data-milliseconds")) * 1e6)
    yield Row("Run: restart", Figure.of(restarts), {}, "<= 1000 ms")
    frames, seconds, simulated = page.evaluate(WATCH, SECONDS)
    yield Row("frames a second, two turtles", Figure.of([frames / seconds], "/s"), {}, "60 /s")
    speed = Figure.of([100 * simulated / seconds], "%")
    yield Row("simulated time of real time", speed, {}, "100 %")
