"""The first picture of a page shows frames and displays, until the user takes the camera."""

from __future__ import annotations

import contextlib
import itertools
import struct

import pytest
from tests.pages import wait_until

from turtlewire.tf.buffer import Buffer
from turtlewire_view import Viewer

from .looking_down import get, stamped
from .still_source import StillSource

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


def test_distant_frames_and_a_moved_camera_change_nothing(source, open_view):
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


TALL = """<robot name="tall">
  <link name="base"><visual><origin xyz="0 0 1"/><geometry><box size="0.3 0.4 2"/></geometry>
    </visual></link>
  <link name="tip"><visual>{visual}</visual></link>
  <joint name="j" type="fixed"><parent link="base"/><child link="tip"/></joint>
</robot>"""
SMALL = '<geometry><sphere radius="0.05"/></geometry>'
#: Whether places are within the picture, and no row of buttons lies above them.
IN_FULL_VIEW = f"""async (places) => {{
    if (!(await ({SEEN})(places))) return false;
    const {{ stage }} = await import("./js/main.js");
    const {{ Vector3 }} = await import("three");
    const picture = document.querySelector("#scene").getBoundingClientRect();
    const bars = [...document.querySelectorAll(".bar")].map((bar) => bar.getBoundingClientRect());
    return places.every((place) => {{
        const at = stage.view.project(new Vector3(...place));
        const [x, y] = [at.x + picture.left, at.y + picture.top];
        return bars.every((bar) => x < bar.left || x > bar.right || y > bar.bottom);
    }});
}}"""
SIZES = {"desktop": (1280, 800), "phone": (390, 844), "small": (320, 640), "landscape": (844, 390)}


def corners(low, high):
    """The corners of a box."""
    return [list(corner) for corner in itertools.product(*zip(low, high, strict=True))]


def describe(source, text):
    source.offer("/robot_description", get("std_msgs/msg/String")(data=text))


@pytest.mark.parametrize("size", SIZES)
def test_a_tall_robot_is_seen_whole(source, open_view, size):
    describe(source, TALL.format(visual=SMALL))
    width, height = SIZES[size]
    page = open_view(source.url, viewport={"width": width, "height": height})
    body = corners((0.85, -0.2, 0), (1.15, 0.2, 2))  # base is at (1, 0, 0)
    assert wait_until(page, IN_FULL_VIEW, body)


def test_a_robot_is_seen_whole_when_its_frames_come_after_its_description(open_view):
    source = StillSource()
    source.buffer = Buffer()
    describe(source, TALL.format(visual=SMALL))
    with contextlib.closing(Viewer(source, "map", port=0)) as viewer:
        page = open_view(viewer.url)
        page.wait_for_selector(".display .status:has-text('No transform')")
        source.put_frame("map", "base", (0, 0, 0))
        source.put_frame("base", "tip", (0, 0, 0.1))
        assert wait_until(page, IN_FULL_VIEW, corners((-0.15, -0.2, 0), (0.15, 0.2, 2)))


def test_a_robot_is_seen_whole_when_the_picture_gets_another_size(source, open_view):
    describe(source, TALL.format(visual=SMALL))
    page = open_view(source.url, viewport={"width": 844, "height": 390})
    body = corners((0.85, -0.2, 0), (1.15, 0.2, 2))
    assert wait_until(page, IN_FULL_VIEW, body)
    page.set_viewport_size({"width": 390, "height": 844})
    assert wait_until(page, IN_FULL_VIEW, body)


def stl_of_a_pole(height):
    """A triangle that stands upright, as a binary STL file."""
    places = [(0, 0, 0), (0.1, 0, 0), (0, 0, height)]
    numbers = [0.0, 1.0, 0.0, *(float(value) for place in places for value in place)]
    return bytes(80) + struct.pack("<I12fH", 1, *numbers, 0)


def test_a_robot_is_seen_whole_when_its_mesh_comes_late(source, open_view, tmp_path, monkeypatch):
    markers = tmp_path / "share/ament_index/resource_index/packages"
    markers.mkdir(parents=True)
    (markers / "pole").touch()
    (tmp_path / "share/pole").mkdir()
    (tmp_path / "share/pole/pole.stl").write_bytes(stl_of_a_pole(6.0))
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    mesh = '<geometry><mesh filename="package://pole/pole.stl"/></geometry>'
    describe(source, TALL.format(visual=mesh))
    page = open_view(source.url)
    assert wait_until(page, IN_FULL_VIEW, [[1, 1, 0], [1, 1, 6]])  # tip is at (1, 1, 0)
