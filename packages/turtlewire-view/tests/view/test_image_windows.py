"""Windows of pictures over the scene: their places, names, and how they are moved and closed."""

# ruff: noqa: F811 - fixtures are imported
from __future__ import annotations

import numpy as np
import pytest

from .looking_down import (  # noqa: F401 - fixtures
    ADD,
    LIMIT_MS,
    REMOVE_ALL,
    scene,
    shown_page,
    stamped,
)

#: Boxes [left, top, right, bottom] of the windows that are seen, and of the viewport.
BOXES = """() => {
    const box = (element) => {
        const { left, top, right, bottom } = element.getBoundingClientRect();
        return [left, top, right, bottom];
    };
    const seen = [...document.querySelectorAll(".image-window")].filter((each) => !each.hidden);
    return [seen.map(box), box(document.getElementById("viewport"))];
}"""
HEIGHTS = "() => [...document.querySelectorAll('.image-window')].map((e) => +e.style.zIndex)"
COUNT = "(n) => document.querySelectorAll('.image-window:not([hidden])').length === n"


def picture():
    message = stamped("sensor_msgs/msg/Image", "lens", height=6, width=8, step=24)
    message.encoding = "rgb8"
    message.data = np.full((6, 8, 3), (10, 200, 30), np.uint8).tobytes()
    return message


@pytest.fixture
def show(scene):
    """Show pictures of so many cameras, and give the page."""

    def show(count):
        topics = [f"{scene.topic}_{number}" for number in range(count)]
        for topic in topics:
            scene.source.offer(topic, picture())
            scene.page.evaluate(ADD, ["image", topic, {}])
        scene.page.wait_for_function(COUNT, arg=count, timeout=LIMIT_MS)
        return scene.page

    yield show
    scene.page.evaluate(REMOVE_ALL)


def overlap(a, b):
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def is_inside(box, around):
    return (
        box[0] >= around[0] - 1
        and box[1] >= around[1] - 1
        and box[2] <= around[2] + 1
        and box[3] <= around[3] + 1
    )


def drag(page, start, end):
    page.mouse.move(*start)
    page.mouse.down()
    page.mouse.move(*end, steps=3)
    page.mouse.up()


def test_windows_open_side_by_side(show):
    page = show(2)
    (first, second), around = page.evaluate(BOXES)
    assert not overlap(first, second)
    assert is_inside(first, around)
    assert is_inside(second, around)
    names = page.locator(".image-window b").all_inner_texts()
    assert [name[-2:] for name in names] == ["_0", "_1"]


def test_captions_stay_below_the_buttons_of_a_low_scene(show):
    page = show(1)
    page.evaluate(REMOVE_ALL)
    page.set_viewport_size({"width": 844, "height": 390})
    show(2)
    (first, second), room = page.evaluate(BOXES)
    assert not overlap(first, second)
    assert is_inside(second, room)
    drag(page, (first[0] + 20, first[1] + 8), (first[0] + 20, -500))
    caption = page.locator(".image-window figcaption").first
    box = caption.bounding_box()
    at = [box["x"] + 20, box["y"] + 4]
    found = "([x, y]) => document.elementFromPoint(x, y).closest('figcaption')?.textContent"
    assert page.evaluate(found, at) == caption.text_content()
    page.set_viewport_size({"width": 900, "height": 700})


def test_when_all_is_taken_the_next_ones_are_a_cascade(show):
    page = show(1)
    (small,), room = page.evaluate(BOXES)
    width, height = small[2] - small[0], small[3] - small[1]
    count = int((room[2] - room[0]) / width) * int((room[3] - room[1]) / height)
    page.evaluate(REMOVE_ALL)
    show(count + 3)
    boxes, room = page.evaluate(BOXES)
    assert all(is_inside(box, room) for box in boxes)
    heights = page.evaluate(HEIGHTS)
    last = sorted(range(count + 3), key=lambda k: heights[k])[-2:]  # in the order of their coming
    (left, top, *_), (second_left, second_top, *_) = (boxes[k] for k in last)
    assert (second_left - left, second_top - top) == (28, 28)
    for k in last:
        caption = page.locator(".image-window figcaption").nth(k)
        box = caption.bounding_box()
        at = [box["x"] + 20, box["y"] + box["height"] / 2]
        found = "([x, y]) => document.elementFromPoint(x, y).closest('figcaption').textContent"
        assert page.evaluate(found, at) == caption.text_content()


def test_a_window_stays_in_the_picture_however_far_it_is_dragged(show):
    page = show(1)
    (box,), around = page.evaluate(BOXES)
    for end in ((5000, -3000), (-4000, 4000)):
        (box,), around = page.evaluate(BOXES)
        drag(page, (box[0] + 20, box[1] + 8), end)
        (moved,), around = page.evaluate(BOXES)
        assert moved != box
        assert is_inside(moved, around)


def test_a_window_is_moved_with_keys(show):
    page = show(1)
    ((left, top, *_),), _ = page.evaluate(BOXES)
    page.focus(".image-window figcaption")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowUp")
    ((now_left, now_top, *_),), _ = page.evaluate(BOXES)
    assert (now_left - left, now_top - top) == (20, -20)


def test_a_pressed_window_comes_to_the_front(show):
    page = show(2)
    (first, second), _ = page.evaluate(BOXES)
    drag(page, (second[0] + 20, second[1] + 8), (first[0] + 60, first[1] + 40))
    page.mouse.click(first[0] + 10, first[1] + 60)
    top = "([x, y]) => document.elementFromPoint(x, y).closest('.image-window').textContent"
    assert "_0" in page.evaluate(top, [first[0] + 70, first[1] + 60])


def test_a_closed_window_is_hidden_and_comes_back(show):
    page = show(1)
    page.click(".image-window button")
    page.wait_for_function(COUNT, arg=0, timeout=LIMIT_MS)
    eye = page.locator("#display-list .eye")
    assert eye.get_attribute("aria-pressed") == "true"
    eye.click()
    page.wait_for_function(COUNT, arg=1, timeout=LIMIT_MS)
