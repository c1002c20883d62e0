"""Images with the CameraInfo next to them: where the camera is, and what it projects.

The first picture of a page shows frames and displays, until the user takes the camera.
"""

import contextlib
import itertools
import math
import struct

import numpy as np
import pytest
from tests.needs import only_first_is_fast
from tests.pages import wait_until

from turtlewire.tf.buffer import Buffer
from turtlewire_view import Viewer
from turtlewire_view.displays import displays_of, further_kinds
from turtlewire_view.displays.camera import CameraDisplay, CompressedCameraDisplay, info_topic
from turtlewire_view.displays.content import Content

from .looking_down import get, stamped
from .still_source import StillSource

K = [100.0, 0.0, 80.0, 0.0, 110.0, 60.0, 0.0, 0.0, 1.0]
P = [100.0, 0.0, 80.0, -50.0, 0.0, 110.0, 60.0, 11.0, 0.0, 0.0, 1.0, 0.0]
NO_INFO = "No CameraInfo received on [/eye/camera_info]"


def image(**values):
    message = get("sensor_msgs/msg/Image")(encoding="rgb8", height=2, width=4, step=12, **values)
    message.header.frame_id = "lens"
    message.header.stamp.sec = 7
    message.data = np.zeros((2, 4, 3), np.uint8).tobytes()
    return message


def info(k=K, p=P, width=160, height=120):
    return get("sensor_msgs/msg/CameraInfo")(k=k, p=p, width=width, height=height)


@pytest.fixture
def camera():
    display = CameraDisplay()
    display.topic = "/eye/image_raw"
    return display


def taken(display, message):
    is_info = hasattr(message, "k")
    return display.take("/eye/camera_info" if is_info else display.topic, message)


def test_the_image_lies_in_its_frame_with_the_projection(camera):
    assert camera.topics("sensor_msgs/msg/Image") == {
        "/eye/image_raw": "sensor_msgs/msg/Image",
        "/eye/camera_info": "sensor_msgs/msg/CameraInfo",
    }
    (status,) = taken(camera, image())
    assert (status.level, status.text) == ("warn", NO_INFO)
    content, status = taken(camera, info())
    assert (content.frame_id, content.stamp_ns, status.text) == ("lens", 7 * 10**9, "")
    assert content.header["projection"] == {
        "fx": 100, "fy": 110, "cx": 80, "cy": 60, "tx": 0.5, "ty": -0.1, "width": 160, "height": 120
    }  # fmt: skip
    assert content.arrays["rgba"].shape == (2, 4, 4)


def test_the_same_numbers_show_the_image_once(camera):
    assert taken(camera, info()) == []
    assert isinstance(taken(camera, image())[0], Content)
    assert taken(camera, info()) == []
    other, _ = taken(camera, info(width=320))
    assert other.header["projection"]["width"] == 320


def test_a_camera_without_a_projection_matrix_uses_k(camera):
    taken(camera, info(p=[0.0] * 12))
    content, status = taken(camera, image())
    numbers = content.header["projection"]
    assert (numbers["fy"], numbers["tx"], status.text) == (110, 0, "")


def test_the_size_of_the_image_replaces_a_missing_one(camera):
    taken(camera, info(width=0, height=0))
    content, _ = taken(camera, image())
    numbers = content.header["projection"]
    assert (numbers["width"], numbers["height"]) == (4, 2)


@pytest.mark.parametrize(
    ("values", "line"),
    [
        ({"p": [0.0] * 12, "k": [0.0] * 9}, "the camera is not calibrated: a focal length in k"),
        ({"p": [0.0, *P[1:]]}, "the camera is not calibrated: a focal length in p"),
        ({"p": [math.nan, *P[1:]]}, "p of the CameraInfo holds a number that is not finite"),
        ({"p": [1e-300, *P[1:]]}, "p of the CameraInfo holds a number that is not finite"),
        ({"p": [0.0] * 12, "k": [math.inf, *K[1:]]}, "k of the CameraInfo holds a number that"),
    ],
)
def test_wrong_numbers_of_a_camera_are_named(camera, values, line):
    taken(camera, info(**values))
    (status,) = taken(camera, image())
    assert (status.level, status.text[: len(line)]) == ("error", line)


def test_an_image_without_a_frame_or_with_an_unknown_encoding_is_not_shown(camera):
    taken(camera, info())
    nowhere, strange = image(), image()
    nowhere.header.frame_id = ""
    strange.encoding = "jpeg2000"
    assert taken(camera, nowhere)[0].text.startswith("header.frame_id is empty")
    assert taken(camera, strange)[0].text.startswith("the encoding 'jpeg2000' is not supported")


def test_a_compressed_image_needs_the_size_of_its_camera():
    display = CompressedCameraDisplay()
    display.topic = "/eye/image_raw/compressed"
    assert "/eye/camera_info" in display.topics("sensor_msgs/msg/CompressedImage")
    message = get("sensor_msgs/msg/CompressedImage")(format="jpeg", data=b"\xff\xd8\xff\xe0")
    message.header.frame_id = "lens"
    taken(display, info(width=0))
    (status,) = taken(display, message)
    assert status.text == "the width or height of the CameraInfo is 0"
    content, _ = taken(display, info())
    assert content.header["media_type"] == "image/jpeg"
    assert content.header["projection"]["width"] == 160


def test_a_camera_is_offered_next_to_its_info():
    assert info_topic("/a/b/image_raw") == "/a/b/camera_info"
    assert info_topic("/image") == "/camera_info"
    names = ["/a/camera_info"]
    assert further_kinds("/a/image", "sensor_msgs/msg/Image", names) == ["camera"]
    assert further_kinds("/b/image", "sensor_msgs/msg/Image", names) == []
    assert set(displays_of("camera")) == {
        "sensor_msgs/msg/Image", "sensor_msgs/msg/CompressedImage"
    }  # fmt: skip


def test_a_page_gets_the_image_and_its_projection(open_view_page):
    source = StillSource()
    source.offer("/eye/image_raw", image())
    source.offer("/eye/camera_info", info())
    source.put_frame("map", "lens", (0, 0, 1))
    with Viewer(source, "map", port=0) as viewer:
        page = open_view_page(viewer)
        topics = page.wait_for("topics", lambda packet: len(packet["topics"]) == 2)["topics"]
        assert [each["others"] for each in topics] == [[], ["camera"]]
        page.send("add", id="a", kind="camera", topic="/eye/image_raw", options={})
        shown = page.wait_for("display")
        assert shown["pose"][:3] == [0, 0, 1]
        assert shown["projection"]["fx"] == 100


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


@pytest.mark.parametrize("size", only_first_is_fast(*SIZES))
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


def test_a_robot_is_seen_whole_when_its_mesh_comes_late(source, open_view, meshes):
    (meshes / "pole.stl").write_bytes(stl_of_a_pole(6.0))
    mesh = '<geometry><mesh filename="package://arm/meshes/pole.stl"/></geometry>'
    describe(source, TALL.format(visual=mesh))
    page = open_view(source.url)
    assert wait_until(page, IN_FULL_VIEW, [[1, 1, 0], [1, 1, 6]])  # tip is at (1, 1, 0)
