"""The layout: the field stays visible and in place when elements appear next to or over it."""

from __future__ import annotations

import pytest

from turtlesim.model import Pen

from .seen import pixel, wait_for_pixel, wait_for_text

PHONE = {"has_touch": True, "is_mobile": True}


def box(page, selector: str) -> tuple[float, float, float, float]:
    """Left, top, right, bottom in the window."""
    found = page.locator(selector).first.bounding_box()
    left, top = found["x"], found["y"]
    return left, top, left + found["width"], top + found["height"]


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


def test_names_are_in_their_natural_order_and_found_by_a_search(simulator, open_page):
    page = open_page(simulator.screen.url)
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
