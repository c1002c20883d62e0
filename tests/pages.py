"""Waits for a page in a real browser, comparisons of its pictures, and accessibility checks."""

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


#: Functions of the page: colours as [red, green, blue, alpha], 0 to 255 and 0 to 1.
COLORS = """
const parse = (css) => {
    const numbers = css.match(/-?[\\d.]+(e-?\\d+)?/g).map(Number);
    const scale = css.startsWith("color(") ? 255 : 1;
    const [r, g, b, alpha = 1] = css.startsWith("color(") ? numbers.slice(-4 + (
        css.includes("/") ? 0 : 1)) : numbers;
    return [scale * r, scale * g, scale * b, alpha];
};
const over = ([r, g, b, alpha], below) => {
    return [r, g, b].map((value, k) => alpha * value + (1 - alpha) * below[k]).concat(1);
};
/** What is seen behind an element's content. */
const groundOf = (element) => {
    if (!element) return [255, 255, 255, 1];
    const own = parse(getComputedStyle(element).backgroundColor);
    return own[3] === 1 ? own : over(own, groundOf(element.parentElement));
};
const luminance = (color) => color.slice(0, 3).map((byte) => {
    const share = byte / 255;
    return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
}).reduce((sum, value, k) => sum + value * [0.2126, 0.7152, 0.0722][k], 0);
const contrast = (a, b) => {
    const [low, high] = [luminance(a), luminance(b)].sort((x, y) => x - y);
    return (high + 0.05) / (low + 0.05);
};
const nameOf = (element) => element.id || element.className || element.tagName;
"""
#: Name, width [px] and contrast of the ring around what has the focus.
RING = f"""() => {{
    {COLORS}
    const element = document.activeElement;
    const style = getComputedStyle(element);
    const ground = groundOf(element.parentElement);
    const ring = over(parse(style.outlineColor), ground);
    const width = style.outlineStyle === "none" ? 0 : parseFloat(style.outlineWidth);
    return [nameOf(element), width, contrast(ring, ground)];
}}"""
BORDERS = f"""() => {{
    {COLORS}
    const typed = "input:not([type=checkbox], [type=range], [type=file]), select";
    return [...document.querySelectorAll(typed)].filter((each) => each.checkVisibility())
        .map((each) => {{
            const ground = groundOf(each.parentElement);
            const border = over(parse(getComputedStyle(each).borderTopColor), ground);
            return [nameOf(each), contrast(border, ground)];
        }});
}}"""
SMALL_TEXTS = """() => {
    const found = [];
    const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    while (texts.nextNode()) {
        const { parentElement: element, textContent: text } = texts.currentNode;
        const size = parseFloat(getComputedStyle(element).fontSize);
        if (size < 12 && text.trim() && element.checkVisibility()) found.push([text.trim(), size]);
    }
    return found;
}"""

#: Visible texts whose colour has a contrast below 4.5:1 to their ground.
WEAK_TEXTS = f"""() => {{
    {COLORS}
    const found = [];
    const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    while (texts.nextNode()) {{
        const {{ parentElement: element, textContent: text }} = texts.currentNode;
        if (!text.trim() || !element.checkVisibility() || element.closest(":disabled")) continue;
        const ground = groundOf(element);
        const ratio = contrast(over(parse(getComputedStyle(element).color), ground), ground);
        if (ratio < 4.5) found.push([text.trim(), ratio]);
    }}
    return found;
}}"""

#: Elements whose name a screen reader does not read: those without a role may have none.
UNREAD_NAMES = """() => [...document.querySelectorAll("[aria-label]:not([role])")]
    .filter((each) => each.matches("b, code, div, i, p, small, span"))
    .map((each) => each.getAttribute("aria-label"))"""


def focus_rings(page, most: int = 200) -> dict[str, tuple[float, float]]:
    """Return the width [px] and the contrast of each ring that is met on the way with Tab."""
    rings: dict[str, tuple[float, float]] = {}
    page.evaluate("document.activeElement.blur()")
    for _ in range(most):
        page.keyboard.press("Tab")
        if page.evaluate("document.activeElement === document.body"):
            break
        name, width, contrast = page.evaluate(RING)
        rings[name] = min(rings.get(name, (99.0, 99.0)), (width, contrast))
    return rings


def weak_rings(page) -> dict[str, tuple[float, float]]:
    """Return the rings that WCAG 2.2 refuses: below 2 px or a contrast of 3:1."""
    rings = focus_rings(page)
    assert len(rings) > 5, rings
    return {name: ring for name, ring in rings.items() if ring[0] < 2 or ring[1] < 3}


def weak_borders(page) -> dict[str, float]:
    """Return the borders of inputs and lists that have less contrast than 3:1."""
    borders = dict(page.evaluate(BORDERS))
    assert len(borders) > 2, borders
    return {name: contrast for name, contrast in borders.items() if contrast < 3}


def weak_texts(page) -> list[list[str | float]]:
    """Return the visible texts of less contrast than 4.5:1, but no disabled ones."""
    return page.evaluate(WEAK_TEXTS)


def small_texts(page) -> list[list[str | float]]:
    """Return the visible texts below 12 px, with their size."""
    return page.evaluate(SMALL_TEXTS)


def root_size_with(page, standard: int) -> float:
    """Return the root's font size [px] in a browser whose setting is ``standard`` px."""
    session = page.context.new_cdp_session(page)
    session.send("Page.setFontSizes", {"fontSizes": {"standard": standard, "fixed": standard}})
    size = page.evaluate("parseFloat(getComputedStyle(document.documentElement).fontSize)")
    session.detach()
    return size
