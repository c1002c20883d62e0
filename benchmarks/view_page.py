"""The page of the 3D view with 1,000 frames that all move: time of one picture in the browser.

Headless Chromium without a graphics card, about 1280 x 720 pixels. Each picture takes new poses,
writes axes, arrows and names, and is drawn until its first pixel can be read. By then the
browser has shown the previous picture, so the cost of compositing is not counted. The rival is
the empty picture, which is cleared as well.

Two scenes: one tree whose arrows cross the whole picture, and a hundred robots of ten frames each.
"""

from __future__ import annotations

import contextlib
import shutil
from collections.abc import Iterator
from importlib.resources import files
from typing import TYPE_CHECKING, Any

import numpy as np

from benchmarks.figures import Figure, Row
from turtlewire.web import Server
from turtlewire.web.packets import encode_packet

if TYPE_CHECKING:
    from pathlib import Path

TITLE = "3D view: one picture of 1,000 moving frames, without a graphics card"
FRAMES, PICTURES = 1000, 150
FLAGS = ["--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
#: Milliseconds of each picture: until it is handed over, and until it is drawn.
DRAW = """async ([count, empty]) => {
    const { stage, frames } = await import("./js/main.js");
    const pixel = new Uint8Array(4);
    const gl = stage.view.canvas.getContext("webgl2");
    stage.drawing.object.visible = stage.labels.object.visible = !empty;
    const times = [[], []];
    for (let n = 0; n < count; n += 1) {
        const poses = Float32Array.from(frames.poses, (value, k) =>
            k % 7 === 0 ? value + 0.002 * Math.sin(n / 9 + k) : value);
        const stamps = Float64Array.from(frames.stamps, (stamp) => stamp + 1 / 30);
        const arrays = { poses, stamps, known: frames.known };
        await new Promise(requestAnimationFrame);
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel); // nothing else is to be drawn
        const start = performance.now();
        if (!empty) {
            frames.takePoses({ version: frames.version, stamp: n, origin: [0, 0, 0], arrays });
            stage.takePoses();
        }
        stage.view.draw(start);
        times[0].push(performance.now() - start);
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
        times[1].push(performance.now() - start);
    }
    return times;
}"""


def rows() -> Iterator[Row]:
    from playwright.sync_api import sync_playwright

    chromium = shutil.which("chromium")
    if chromium is None:
        return
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=FLAGS)
        for name, parents in (("one tree", tree()), ("robots", robots())):
            yield from measure(browser, name, parents)
        browser.close()


def measure(browser: Any, name: str, parents: list[int]) -> Iterator[Row]:
    """Two rows for a scene."""
    server = Server(page_folder(), lambda: StillSession(packets(parents)))
    with contextlib.closing(server):
        page = browser.new_page(viewport={"width": 1680, "height": 840})
        page.goto(server.url)
        page.wait_for_selector("#tree .row:has-text('frame_1')")
        _, empty = page.evaluate(DRAW, [PICTURES, True])
        handed, drawn = page.evaluate(DRAW, [PICTURES, False])
        page.close()
    empty, handed, drawn = (Figure.of(each, factor=1e6) for each in (empty, handed, drawn))
    yield Row(f"{name}: the page's own code", handed, {})
    yield Row(f"{name}: until it is drawn", drawn, {"empty": empty}, "<= 12 ms")


def page_folder() -> Path:
    return files("turtlewire_view") / "page"  # type: ignore[return-value]


class StillSession:
    """Tells a page once which frames there are."""

    def __init__(self, packets: list[bytes]) -> None:
        self._packets = packets

    def outgoing(self) -> list[str | bytes]:
        packets, self._packets = self._packets, []
        return list(packets)

    def receive(self, message: str | bytes) -> None:
        pass

    def closed(self) -> None:
        pass


def tree() -> list[int]:
    """Parents of a tree that is ten frames wide and three deep."""
    return [-1, *(k // 10 for k in range(1, FRAMES))]


def robots() -> list[int]:
    """Parents of a hundred robots, whose frames are beside each other."""
    return [-1, *(0 if k % 10 == 0 else k - 1 for k in range(1, FRAMES))]


def packets(parents: list[int]) -> list[bytes]:
    """All frames, on a square of 10 m."""
    names = ["map", *(f"frame_{k}" for k in range(1, FRAMES))]
    poses = np.zeros((FRAMES, 7), np.float32)
    poses[:, 0], poses[:, 1] = np.divmod(np.arange(FRAMES), 32)
    poses[:, :2] *= 0.3
    poses[:, 2] = np.arange(FRAMES) % 5 / 10
    poses[:, 6] = 1
    stamps, known = np.ones(FRAMES), np.ones(FRAMES, np.uint8)
    head = {"version": 1, "fixed": "map", "roots": ["map"], "trees": [0] * FRAMES}
    return [
        encode_packet({"type": "hello", "source": {"kind": "live", "name": "benchmark"}}),
        encode_packet({"type": "names", "names": names, "parents": parents, "loops": [], **head}),
        encode_packet(
            {"type": "frames", "version": 1, "stamp": 1.0, "origin": [0, 0, 0]},
            {"poses": poses, "stamps": stamps, "known": known},
        ),
    ]
