"""The appearance of the page, compared with reviewed pictures and boxes.

``TURTLEWIRE_WRITE_GOLDEN=1`` rewrites them.

Pictures are compared after they were made small, boxes with a tolerance; where the page has another
font than in the golden pictures, only what must be so with any font is looked at.
"""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest
from tests.pages import after_two_frames, difference, skip_with_other_fonts

from tests import places

GOLDEN = places.GOLDEN / "page"
WRITES = "TURTLEWIRE_WRITE_GOLDEN" in os.environ
#: 0 on the machine where the pictures were made; with one part of the page missing 15 and more on
#: the phone, 4 to 30 on the desktop.
WORST_CELL = 6
PARTS = {
    "h1": "the page's title",
    "#connection": "the state of the connection",
    "#turtles": "the field",
    "#tools": "follow and picture",
    "#roster": "names and velocities",
    "#pad": "the arrows",
    "#compass": "the headings",
    ".actions": "what is done to the world",
    "#tree": "the frames",
}
#: Left, right, top, bottom of each part in CSS pixels.
BOXES = """(parts) => Object.fromEntries(parts.map((part) => {
    const { left, right, top, bottom } = document.querySelector(part).getBoundingClientRect();
    return [part, [left, right, top, bottom].map(Math.round)];
}))"""
SIZES = {"desktop": (1200, 800), "phone": (360, 740)}


def pose_is_shown(page, text: str) -> None:
    page.wait_for_function(
        "(text) => document.querySelector('#roster').textContent.includes(text)", arg=text
    )


@pytest.fixture
def scene(simulator):
    """Two turtles and a drawing."""
    simulator.world.spawn(4.0, 2.0, 1.0, "turtle2")
    simulator.turtle1.teleport_absolute(8.0, 3.0, 2.0)
    simulator.turtle1.teleport_absolute(8.0, 9.0, 2.0)
    return simulator


def test_the_picture_is_what_is_seen(scene, open_page):
    page = open_page(
        scene.screen.url, reduced_motion="reduce", viewport={"width": 1200, "height": 500}
    )
    pose_is_shown(page, "9.00")
    after_two_frames(page)
    with page.expect_download() as download:
        page.click("#picture")
    assert download.value.suggested_filename.startswith("turtlesim-20")
    skip_with_other_fonts(page)
    assert (
        difference(page, GOLDEN / "field.png", Path(download.value.path()).read_bytes())
        < WORST_CELL
    )


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("size", SIZES)
def test_every_size_and_scheme(scene, open_page, size, scheme):
    width, height = SIZES[size]
    options = {"viewport": {"width": width, "height": height}, "device_scale_factor": 0.5}
    page = open_page(scene.screen.url, color_scheme=scheme, reduced_motion="reduce", **options)
    pose_is_shown(page, "9.00")
    page.wait_for_function("() => document.querySelector('#words').textContent.includes('turtle2')")
    after_two_frames(page)
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    boxes = page.evaluate(BOXES, list(PARTS))
    left, right, top, bottom = boxes["#turtles"]
    assert right - left == pytest.approx(bottom - top, abs=1)
    assert right - left >= 300
    skip_with_other_fonts(page)
    check_boxes(size, boxes)
    assert difference(page, GOLDEN / f"{size}-{scheme}.png", page.screenshot()) < WORST_CELL


@pytest.mark.parametrize("width", [360, 1200])
def test_long_names_and_many_turtles_fit(simulator, open_page, width):
    for k in range(30):
        simulator.world.spawn(1.0 + k / 4, 2.0, 0.5, f"a_turtle_with_a_very_long_name_indeed_{k}")
    simulator.missing = ("a_turtle_with_a_very_long_name_that_somebody_waits_for",)
    page = open_page(simulator.screen.url, viewport={"width": width, "height": 800})
    page.wait_for_selector("#hint button")
    page.evaluate("""async () => {
        const { FramesPanel } = await import('/js/frames_panel.js');
        const name = (k) => `a_frame_with_a_very_long_name_as_${k}_optical_link`;
        const frames = [0, 1, 2, 3].map((k) => [name(k + 1), name(k), 10, k]);
        const argument = `"${name(1)}" passed to lookupTransform argument source_frame`;
        const error = `${argument} does not exist. `;
        const relation = { error, hint: name(2) };
        new FramesPanel(() => null).show({ frames, target: name(0), source: name(1), relation });
    }""")
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    aside, header = (page.locator(part).bounding_box() for part in ("aside", "header"))
    assert aside["x"] + aside["width"] <= header["x"] + header["width"]
    assert not page.is_visible("#more")
    assert page.locator("#tree li[data-kind=stale]").count() == 2
    red = page.evaluate(
        "getComputedStyle(document.querySelector('#tree li[data-kind=stale] > small')).color"
    )
    assert red == "rgb(194, 51, 77)"


def check_boxes(size: str, boxes: dict[str, list[int]]) -> None:
    """Each part where it was, as wide and as high as it was, but for a line of text more or less in
    a part above it.
    """
    file = GOLDEN / f"{size}-boxes.json"
    if WRITES:
        file.write_text(json.dumps(boxes, indent=1) + "\n")
    golden = json.loads(file.read_text())
    assert boxes.keys() == golden.keys()
    for part, (left, right, top, bottom) in boxes.items():
        old_left, old_right, old_top, old_bottom = golden[part]
        assert (left, right) == (
            pytest.approx(old_left, abs=16),
            pytest.approx(old_right, abs=16),
        ), PARTS[part]
        assert top == pytest.approx(old_top, abs=60), PARTS[part]
        assert bottom - top == pytest.approx(old_bottom - old_top, abs=16), PARTS[part]
