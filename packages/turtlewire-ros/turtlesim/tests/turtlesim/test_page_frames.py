"""Frames on the field: axes and the arrow where TF has them; the question and its one answer."""

from __future__ import annotations

import math
import time

import pytest

from turtlesim.transform_view import Frame, field_frames

from .seen import pixel, publish_transform, wait_for_pixel, wait_for_text

RED, GREEN, WHITE = (255, 107, 120), (93, 240, 162), (255, 255, 255)


def is_near(wanted: tuple[int, ...]):
    """The lines are thin, so that their dark edge is mixed in; red and green are 230 apart."""
    return lambda colour: colour[3] > 150 and math.dist(colour[:3], wanted) < 110


#: All transforms of a test are of this time, so that any two of them have a time in common.
STAMP_NS = time.time_ns()


def publish_now(simulator, *transforms: tuple[str, str, float, float]) -> None:
    """Transforms without a rotation: parent, child, x, y."""
    for transform in transforms:
        publish_transform(simulator, *transform[:2], STAMP_NS, *transform[2:])


@pytest.fixture
def page(simulator, open_page):
    """Two turtles at the lower edge, and their frames elsewhere: what is drawn there is TF's."""
    simulator.turtle1.teleport_absolute(1.0, 1.0, 0.0)
    simulator.world.spawn(10.0, 1.0, 0.0, "turtle2")
    page = open_page(simulator.screen.url)
    publish_now(simulator, ("world", "turtle1", 8.0, 7.0), ("world", "turtle2", 4.0, 4.0))
    wait_for_text(page, "#relation-words", "turtle1 is 4.00 m ahead and 3.00 m to the left")
    return page


def test_axes_are_drawn_where_tf_has_the_frames(simulator, page):
    for x, y in ((8.0, 7.0), (4.0, 4.0)):
        wait_for_pixel(page, "turtles", x + 0.4, y, is_near(RED))
        wait_for_pixel(page, "turtles", x, y + 0.4, is_near(GREEN))
        assert is_near(WHITE)(pixel(page, "turtles", x, y))
    assert is_near(RED)(pixel(page, "turtles", 0.4, 0.0))  # the world's
    publish_now(simulator, ("turtle1", "carrot1", -3.0, 2.0))  # it came later, and has a name
    wait_for_pixel(page, "turtles", 5.4, 9.0, is_near(RED))
    wait_for_pixel(page, "turtles", 5.0, 8.45, lambda colour: colour[3] > 100)  # its label


def test_the_arrow_goes_from_the_one_that_sees_with_its_components(page):
    wait_for_pixel(page, "turtles", 6.0, 5.5, is_near(WHITE))  # halfway from (4, 4) to (8, 7)
    # Four metres ahead along y = 4, then three to the left along x = 8, dashed, with a number each.
    for along in ([(5.0 + k / 20, 4.0) for k in range(8)], [(8.0, 4.5 + k / 20) for k in range(8)]):
        colour = RED if along[0][1] == 4.0 else GREEN
        assert any(is_near(colour)(pixel(page, "turtles", *place)) for place in along)
        assert any(pixel(page, "turtles", *place)[3] == 0 for place in along)
    for x, y in ((6.0, 4.0), (8.0, 5.5)):
        assert pixel(page, "turtles", x - 0.3, y)[3] > 150
    page.select_option("#target", "world")
    wait_for_pixel(page, "turtles", 2.8, 2.45, is_near(WHITE))  # from (0, 0) to (8, 7)


def test_the_frames_can_be_hidden(simulator, page):
    wait_for_pixel(page, "turtles", 6.0, 5.5, is_near(WHITE))
    page.click("#axes")
    assert page.get_attribute("#axes", "aria-pressed") == "false"
    for place in ((6.0, 5.5), (8.4, 7.0), (4.0, 4.4)):
        wait_for_pixel(page, "turtles", *place, lambda colour: colour[3] == 0)
    wait_for_text(page, "#relation-words", "turtle1 is 4.00 m ahead")  # the panel still knows them
    page.click("#axes")
    wait_for_pixel(page, "turtles", 6.0, 5.5, is_near(WHITE))


def test_the_sentence_is_said_once(page):
    assert not page.is_visible("#words")
    assert page.inner_text("body").count("turtle1 is 4.00 m ahead") == 1
    page.click("#frames summary")  # without TF, the poses tell it
    wait_for_text(page, "#words", "behind turtle2")
    page.wait_for_selector("#words:visible")
    assert not page.is_visible("#relation")


def asked(page) -> tuple[str, str]:
    return page.input_value("#source"), page.input_value("#target")


def test_a_proposal_is_no_choice(simulator, open_page):
    """turtle1 is there first; asking where it is as it sees itself helps nobody."""
    page = open_page(simulator.screen.url)
    publish_now(simulator, ("world", "turtle1", 1.0, 1.0))
    wait_for_text(page, "#relation-words", "of world")
    assert asked(page) == ("turtle1", "world")
    publish_now(simulator, ("world", "turtle2", 4.0, 2.0))
    wait_for_text(page, "#relation-words", "of turtle2")
    assert asked(page) == ("turtle1", "turtle2")


def test_a_choice_stays_when_frames_come(simulator, page):
    page.select_option("#target", "world")
    page.select_option("#source", "turtle2")
    publish_now(simulator, ("turtle1", "carrot1", 0.0, 2.0))
    wait_for_text(page, "#tree", "carrot1")
    assert asked(page) == ("turtle2", "world")
    wait_for_text(
        page, "#relation-words", "turtle2 is 4.00 m ahead and 4.00 m to the left of world"
    )


def test_many_frames_are_in_their_natural_order_and_found_by_a_search(simulator, page):
    publish_now(
        simulator, *(("turtle1", f"carrot{k}", 0.1 * k, 0.0) for k in range(1, 31) if k != 3)
    )
    wait_for_text(page, "#tree", "carrot30")
    names = page.locator("#tree li li li > span").all_inner_texts()
    assert names == [f"carrot{k}" for k in range(1, 31) if k != 3]
    assert page.locator("#source option").all_inner_texts()[:3] == ["carrot1", "carrot2", "carrot4"]
    box = page.locator("#frames .scroll").bounding_box()
    assert box["height"] < 250  # the list scrolls, the page does not grow
    page.fill("#find-frame", "ROT12")
    page.wait_for_function("() => document.querySelectorAll('#tree li li li').length === 1")
    assert page.locator("#tree li > span").all_inner_texts() == ["world", "turtle1", "carrot12"]
    assert "hidden" in page.inner_text("#more-frames")
    page.keyboard.press("ArrowUp")  # in the search, it drives nobody
    page.keyboard.type("d")
    assert simulator.commands == []


@pytest.mark.parametrize(
    ("links", "turtles", "expected"),
    [
        ([], ["turtle1"], ("", [])),
        ([("a", "world"), ("b", "a")], [], ("world", ["a", "b", "world"])),
        ([("world", "map"), ("a", "world")], [], ("world", ["a", "map", "world"])),
        ([("turtle1", "odom"), ("x", "y")], ["turtle1"], ("odom", ["odom", "turtle1"])),
        ([("x", "y")], ["turtle1"], ("", [])),
        ([("a", "b"), ("b", "a")], ["a"], None),  # a loop: whatever, but an end
    ],
)
def test_which_frames_are_in_the_field(links, turtles, expected):
    found = field_frames([Frame(child, parent, 1.0, 0.0) for child, parent in links], turtles)
    assert expected is None or found == expected


def test_axes_of_a_tilted_and_of_an_endless_frame(simulator):
    """Seen from above, a frame on its side shows one axis only."""
    view = simulator.screen.transforms
    view.join()
    half = math.sqrt(0.5)
    view._buffer.set_static_transform("world", "turned", (1.0, 2.0, 5.0), (0.0, 0.0, half, half))
    view._buffer.set_static_transform("world", "upright", (1.0, 2.0, 0.0), (half, 0.0, 0.0, half))
    axes = view.axes("world", ["world", "turned", "upright", "nowhere"])
    assert axes.keys() == {"world", "turned", "upright"}
    assert axes["turned"] == pytest.approx([1.0, 2.0, 0.0, 1.0, -1.0, 0.0])
    assert axes["upright"] == pytest.approx([1.0, 2.0, 1.0, 0.0, 0.0, 0.0])
    view.leave()
