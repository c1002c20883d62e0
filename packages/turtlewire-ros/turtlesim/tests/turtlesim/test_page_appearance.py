"""The appearance of the page, compared with reviewed pictures and boxes, and its layout.

``TURTLEWIRE_WRITE_GOLDEN=1`` rewrites them.

Pictures are compared after they were made small, boxes with a tolerance; where the page has another
font than in the golden pictures, only what must be so with any font is looked at.
"""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest
from tests.needs import only_first_is_fast
from tests.pages import after_two_frames, difference, skip_with_other_fonts

from tests import places
from turtlesim.model import Pen

from .seen import pixel, wait_for_pixel, wait_for_text

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
    wait_for_text(page, "#roster", "9.00")
    after_two_frames(page)
    with page.expect_download() as download:
        page.click("#picture")
    assert download.value.suggested_filename.startswith("turtlesim-20")
    skip_with_other_fonts(page)
    assert (
        difference(page, GOLDEN / "field.png", Path(download.value.path()).read_bytes())
        < WORST_CELL
    )


@pytest.mark.parametrize("scheme", only_first_is_fast("light", "dark"))
@pytest.mark.parametrize("size", only_first_is_fast(*SIZES))
def test_every_size_and_scheme(scene, open_page, size, scheme):
    width, height = SIZES[size]
    options = {"viewport": {"width": width, "height": height}, "device_scale_factor": 0.5}
    page = open_page(scene.screen.url, color_scheme=scheme, reduced_motion="reduce", **options)
    wait_for_text(page, "#roster", "9.00")
    wait_for_text(page, "#words", "turtle2")
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


PHONE = {"has_touch": True, "is_mobile": True}


def box(page, selector: str) -> tuple[float, float, float, float]:
    """Left, top, right, bottom in the window."""
    found = page.locator(selector).first.bounding_box()
    left, top = found["x"], found["y"]
    return left, top, left + found["width"], top + found["height"]


@pytest.mark.slow
def test_a_phone_on_its_side_shows_pad_and_field_side_by_side(simulator, open_page):
    for width, height in ((667, 375), (740, 360), (932, 430)):
        size = {"width": width, "height": height}
        page = open_page(simulator.screen.url, viewport=size, **PHONE)
        left, top, right, bottom = box(page, "#field")
        assert 0 <= left < right <= width
        assert 0 <= top < bottom <= height
        assert right - left == pytest.approx(bottom - top, abs=1)
        assert bottom - top >= height - 40
        pad = box(page, "#pad")
        assert pad[0] >= right
        assert pad[3] <= height
        assert page.evaluate("document.documentElement.scrollWidth") <= width
        page.evaluate("scrollTo(0, 10000)")
        assert box(page, "#field")[:2] == pytest.approx((left, top), abs=2)


@pytest.mark.parametrize("size", [(390, 844), (1200, 700)])
def test_the_field_stays_in_view_however_much_there_is_beside_it(simulator, open_page, size):
    for k in range(2, 40):
        simulator.world.spawn(1.0, 2.0, 0.5, f"turtle{k}")
    width, height = size
    phone = PHONE if width < 600 else {}
    page = open_page(simulator.screen.url, viewport={"width": width, "height": height}, **phone)
    page.wait_for_selector("#roster tr:nth-child(39)")
    list_height = box(page, ".scroll")[3] - box(page, ".scroll")[1]
    assert list_height <= 200
    page.evaluate("scrollTo(0, 10000)")
    _, top, _, bottom = box(page, "#field")
    assert top >= 0
    assert bottom <= height


def test_notices_do_not_move_the_field(simulator, open_page):
    page = open_page(simulator.screen.url, viewport={"width": 390, "height": 844})
    places = {name: box(page, name) for name in ("#field", "#pad", "#roster")}
    simulator.missing = ("turtle2",)
    page.wait_for_selector("#hint:visible")
    page.click("#spawn")
    page.wait_for_selector("#placing:visible")
    page.evaluate("scrollTo(0, 0)")
    assert {name: box(page, name) for name in places} == places
    left, top, right, bottom = box(page, "#hint")
    field = places["#field"]
    assert field[0] <= left < right <= field[2]
    assert field[1] <= top < bottom <= field[3]
    assert box(page, "#placing")[3] <= top


def test_names_are_in_their_natural_order_and_found_by_a_search(simulator, page):
    assert not page.is_visible("#find-turtle")
    for k in range(2, 13):
        simulator.world.spawn(1.0 + k / 2, 2.0, 0.5, f"turtle{k}")
    page.wait_for_selector("#roster tr:nth-child(12)")
    rows = page.locator("#roster button").all_inner_texts()
    assert rows == [f"turtle{k}" for k in range(1, 13)]
    wait_for_text(page, "#roster tr:nth-child(10)", "6.00")  # numbers stay with their names
    page.fill("#find-turtle", "TLE1")
    found = ["turtle1", "turtle10", "turtle11", "turtle12"]
    assert page.locator("#roster button").all_inner_texts() == found
    wait_for_text(page, "#roster tr:nth-child(2)", "6.00")
    page.fill("#find-turtle", "nobody")
    assert page.inner_text("#more") == "no turtle with this name"
    page.fill("#find-turtle", "")
    assert page.locator("#roster tr").count() == 12
    page.get_by_role("button", name="turtle12").click()
    assert page.inner_text("#driven") == "turtle12"
    assert simulator.commands == []  # letters in the search turn nobody


def test_the_driven_turtle_is_on_top_and_nothing_covers_its_name(simulator, open_page):
    """Of two at the same place, the one that is driven is seen."""
    simulator.turtle1.set_pen(Pen(0, 0, 0, 1), off=True)
    simulator.turtle1.teleport_absolute(4.0, 4.0, 0.0)
    simulator.world.spawn(4.0, 4.0, 0.0, "turtle2")
    page = open_page(simulator.screen.url, reduced_motion="reduce")
    wait_for_pixel(page, "turtles", 4.0, 4.0, lambda colour: colour[1] > colour[0])  # green
    page.get_by_role("button", name="turtle2").click()
    wait_for_pixel(page, "turtles", 4.0, 4.0, lambda colour: colour[0] > colour[1])  # orange
    alone = label_of(page)
    simulator.world.kill("turtle1")
    page.wait_for_function("() => document.querySelectorAll('#roster tr').length === 1")
    wait_for_pixel(page, "turtles", 4.0, 4.0, lambda colour: colour[0] > colour[1])
    assert label_of(page) == pytest.approx(alone, abs=60)  # the other's shines through a little


def label_of(page) -> list[int]:
    """Brightness along the middle of the name below a turtle at (4, 4)."""
    return [pixel(page, "turtles", 3.5 + k / 20, 3.06)[0] for k in range(20)]
