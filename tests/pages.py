"""Waits for a page in a real browser, and comparisons of its pictures."""

from __future__ import annotations

import base64
import os
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from pathlib import Path

LIMIT_MS = 120_000
#: Two PNG files, both scaled to a width of 200, in cells of 10 x 10 pixels: mean difference of all
#: colour channels in the worst cell.
DIFFERENCE_OF_PICTURES = """async (pictures) => {
    const WIDTH = 200, CELL = 10;
    const [a, b] = await Promise.all(pictures.map(async (png) => {
        const image = new Image();
        image.src = `data:image/png;base64,${png}`;
        await image.decode();
        const height = Math.round((WIDTH * image.height) / image.width);
        const ctx = new OffscreenCanvas(WIDTH, height).getContext('2d');
        ctx.drawImage(image, 0, 0, WIDTH, height);
        return ctx.getImageData(0, 0, WIDTH, height).data;
    }));
    if (a.length !== b.length) return Infinity;
    const cells = new Map();
    a.forEach((value, k) => {
        const pixel = k >> 2;
        const cell = `${Math.floor((pixel % WIDTH) / CELL)} ${Math.floor(pixel / WIDTH / CELL)}`;
        cells.set(cell, (cells.get(cell) ?? 0) + Math.abs(value - b[k]) / (4 * CELL * CELL));
    });
    return Math.max(...cells.values());
}"""
#: Where a place [x, y, z] of the 3D view is on its page [CSS pixels].
PROJECT = """async (place) => {
    const { stage } = await import("./js/main.js");
    const { Vector3 } = await import("three");
    const { x, y } = stage.view.project(new Vector3(...place));
    const { left, top } = stage.view.canvas.getBoundingClientRect();
    return [left + x, top + y];
}"""
#: Width of a text in the page's font, plain and bold [pixels], and what it is with DejaVu Sans,
#: which the golden pictures show.
FONT_WIDTHS = """() => ['', '600 '].map((weight) => {
    const ctx = document.createElement('canvas').getContext('2d');
    ctx.font = `${weight}100px system-ui, sans-serif`;
    return Math.round(ctx.measureText('turtle1 is 2.16 m ahead').width);
})"""
DEJAVU_WIDTHS = [1174, 1317]


def wait_until(page, check, arg=None):
    """Wait until ``check(arg)``, an async function of the page, is true; False after a timeout.

    It may return null when it is sure that it never will. A check that never ends counts as false:
    Playwright's ``evaluate`` knows no limit, and its ``wait_for_function`` takes the promise itself
    for true.
    """
    return page.evaluate(
        f"""async (arg) => {{
            const check = {check};
            const over = new Promise((done) => setTimeout(done, {LIMIT_MS}, null));
            for (;;) {{
                const found = await Promise.race([check(arg), over]);
                if (found) return true;
                const goesOn = new Promise((done) => setTimeout(done, 30, true));
                if (found === null || !(await Promise.race([over, goesOn]))) return false;
            }}
        }}""",
        arg,
    )


def difference(page, golden: Path, picture: bytes) -> float:
    """How far a picture is from the golden one in the worst place, of 255.

    With TURTLEWIRE_WRITE_GOLDEN in the environment, it becomes the golden one.
    """
    if "TURTLEWIRE_WRITE_GOLDEN" in os.environ:
        golden.write_bytes(picture)
    both = (picture, golden.read_bytes())
    return page.evaluate(DIFFERENCE_OF_PICTURES, [base64.b64encode(png).decode() for png in both])


def skip_with_other_fonts(page) -> None:
    widths = page.evaluate(FONT_WIDTHS)
    if widths != DEJAVU_WIDTHS:
        pytest.skip(
            "the golden pictures show DejaVu Sans, which this machine has not or does not prefer "
            f"(text widths {widths})"
        )


def after_two_frames(page) -> None:
    """Wait until what the page knows is painted."""
    page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
