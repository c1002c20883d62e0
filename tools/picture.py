"""Runs the follow demo, drives turtle1 in the page, and takes the README's pictures."""

from __future__ import annotations

import itertools
import os
import re
import shutil
import struct
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from playwright.sync_api import sync_playwright
from served_pages import address_of, program, running

if TYPE_CHECKING:
    from playwright.sync_api import Page

IMAGES = Path(__file__).resolve().parent.parent / "docs" / "images"
#: What a person presses: key, and how many frames pass before the next one.
KEYS = [
    ("ArrowUp", 5),
    ("ArrowLeft", 4),
    ("ArrowUp", 5),
    ("ArrowLeft", 4),
    ("ArrowUp", 6),
    ("ArrowRight", 4),
    ("ArrowUp", 8),
]
FRAME_MS = 160
#: The still is taken when turtle2 sees turtle1 this many metres ahead and to a side, so that the
#: arrow and both of its components are seen. These keys lead to that, pressed again and again.
AHEAD, ASIDE = 2.0, 1.3
STILL_KEYS = ["ArrowLeft", "ArrowUp", "ArrowUp", "ArrowUp", "ArrowUp"]
CHROMIUM_FLAGS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-sync",
]


def main() -> None:
    """Make both pictures."""
    command = ("launch", "learning_tf2_py", "turtle_tf2_demo.launch.py")
    with running(program("ros2"), *command, domain=1 + os.getpid() % 101) as launch:
        address = address_of(launch)
        for line in launch.stdout or ():
            if "Successfully spawned turtle2" in line:
                take_pictures(address)
                return
    raise RuntimeError("the launch ended before turtle2 was there")


def take_pictures(address: str) -> None:
    """Drive in the page, and save what it shows."""
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=shutil.which("chromium"), args=CHROMIUM_FLAGS
        )
        page, small_page = (
            browser.new_page(viewport={"width": 1160, "height": 860}, device_scale_factor=scale)
            for scale in (1, 0.4)
        )
        for opened in (page, small_page):
            opened.goto(address)
            opened.locator("#roster").get_by_text("turtle2").wait_for()
        IMAGES.mkdir(exist_ok=True)
        for key in itertools.islice(itertools.cycle(STILL_KEYS), 100):
            page.keyboard.press(key)
            page.wait_for_timeout(FRAME_MS)
            if is_good_view(page):
                break
        (IMAGES / "demo.png").write_bytes(page.screenshot())
        page.click("#reset")
        page.click("#hint button")
        frames = list(drive(small_page))
        (IMAGES / "demo-animated.png").write_bytes(animated_png(frames, FRAME_MS))
        browser.close()


def is_good_view(page: Page) -> bool:
    """Return True if turtle2 sees turtle1 ahead and to a side."""
    numbers = re.match(r"translation ([-\d.]+), ([-\d.]+)", page.inner_text("#relation-detail"))
    return numbers is not None and float(numbers[1]) > AHEAD and abs(float(numbers[2])) > ASIDE


def drive(page: Page) -> Iterator[bytes]:
    """Press the keys; yields small pictures of the field alone."""
    field = page.locator("canvas").first
    for key, frames in KEYS:
        page.keyboard.press(key)
        for _ in range(frames):
            page.wait_for_timeout(FRAME_MS)
            yield field.screenshot()


def animated_png(frames: list[bytes], frame_ms: int) -> bytes:
    """Return an endless APNG of PNG pictures of one size (PNG specification, third edition)."""
    out = b"\x89PNG\r\n\x1a\n"
    sequence = 0
    for index, frame in enumerate(frames):
        chunks = list(png_chunks(frame))
        header = next(data for kind, data in chunks if kind == b"IHDR")
        if index == 0:
            out += png_chunk(b"IHDR", header) + png_chunk(
                b"acTL", struct.pack(">II", len(frames), 0)
            )
        width, height = struct.unpack(">II", header[:8])
        out += png_chunk(
            b"fcTL", struct.pack(">IIIIIHHBB", sequence, width, height, 0, 0, frame_ms, 1000, 0, 0)
        )
        sequence += 1
        for data in (data for kind, data in chunks if kind == b"IDAT"):
            if index == 0:
                out += png_chunk(b"IDAT", data)
            else:
                out += png_chunk(b"fdAT", struct.pack(">I", sequence) + data)
                sequence += 1
    return out + png_chunk(b"IEND", b"")


def png_chunks(png: bytes) -> Iterator[tuple[bytes, bytes]]:
    """Yield the chunks of a PNG file as (kind, data)."""
    position = 8
    while position < len(png):
        (length,) = struct.unpack_from(">I", png, position)
        yield png[position + 4 : position + 8], png[position + 8 : position + 8 + length]
        position += 12 + length


def png_chunk(kind: bytes, data: bytes) -> bytes:
    """One chunk with its length and checksum."""
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


if __name__ == "__main__":
    main()
