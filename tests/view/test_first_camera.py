"""The first picture of a page shows frames and displays, until the user takes the camera."""

from __future__ import annotations

import contextlib

import pytest
from tests.view.looking_down import get, stamped, wait_until
from tests.view.still_source import StillSource

from turtlewire.view import Viewer

ADD = """async (topic) => {
    const { displays } = await import("./js/main.js");
    await displays.add({ id: topic, kind: "occupancy_grid", topic });
}"""
#: Whether places are within the picture.
SEEN = """async (places) => {
    const { stage } = await import("./js/main.js");
    const { Vector3 } = await import("three");
    const { width, height } = stage.view.viewport;
    return places.every((place) => {
        const at = stage.view.project(new Vector3(...place)); // null behind the camera
        return at && at.x >= 0 && at.y >= 0 && at.x <= width && at.y <= height;
    });
}"""
DRAWN = """async (topic) => {
    const { displays } = await import("./js/main.js");
    return displays.list.some(({ id, partNames }) => id === topic && partNames?.size > 0);
}"""


def grid(cells, resolution, corner):
    message = stamped("nav_msgs/msg/OccupancyGrid", frame="map")
    message.info = get("nav_msgs/msg/MapMetaData")(width=cells, height=cells, resolution=resolution)
    message.info.origin.position.x, message.info.origin.position.y = corner
    message.info.origin.orientation.w = 1.0
    message.data = [100] * cells**2
    return message


@pytest.fixture
def source():
    source = StillSource()
    with contextlib.closing(Viewer(source, "map", port=0)) as viewer:
        source.url = viewer.url
        yield source


def shown(page, source, topic, message):
    source.offer(topic, message)
    page.evaluate(ADD, topic)
    assert wait_until(page, DRAWN, topic)


def test_a_map_larger_than_the_frames_is_seen_whole(source, open_view):
    page = open_view(source.url)
    corners = [[-20, -20, 0], [20, -20, 0], [20, 20, 0], [-20, 20, 0]]
    page.wait_for_selector("#tree .row:has-text('tip')")
    shown(page, source, "/map", grid(40, 1.0, (-20.0, -20.0)))
    assert wait_until(page, SEEN, corners)
    assert wait_until(page, SEEN, [[0, 0, 0], [1, 1, 0]])


def test_what_is_far_away_and_a_camera_that_was_moved_change_nothing(source, open_view):
    page = open_view(source.url)
    page.wait_for_selector("#tree .row:has-text('tip')")
    shown(page, source, "/far", grid(2, 1.0, (5000.0, 0.0)))
    frames, middle = [[0, 0, 0], [1, 0, 0], [1, 1, 0]], [[20, 20, 0]]
    assert page.evaluate(SEEN, frames)
    assert not page.evaluate(SEEN, middle)
    page.focus("#scene")
    page.keyboard.press("+")
    shown(page, source, "/map", grid(40, 1.0, (-20.0, -20.0)))
    assert not page.evaluate(SEEN, middle)
