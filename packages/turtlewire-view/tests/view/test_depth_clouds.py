"""Depth images as points: where they lie, how they are coloured, and images that are none.

Depth clouds in a real browser: the points are as large as their pixels.
"""

import math

import numpy as np
import pytest

from turtlewire import msg
from turtlewire_view.displays import displays_of, further_kinds
from turtlewire_view.displays.content import Content
from turtlewire_view.displays.depth_cloud import DepthCloudDisplay

from .looking_down import BLUE, RED, stamped

get = msg.get_message
IMAGE, INFO, COLOR = "/eye/depth", "/eye/camera_info", "/eye/color"
NO_INFO = f"No CameraInfo received on [{INFO}]"


def image(pixels, encoding, stamp_s=1):
    pixels = np.asarray(pixels)
    height, width = pixels.shape[:2]
    message = get("sensor_msgs/msg/Image")(encoding=encoding, height=height, width=width)
    message.step, message.data = pixels.strides[0], pixels.tobytes()
    message.header.frame_id = "eye"
    message.header.stamp.sec = stamp_s
    return message


def depth(values, stamp_s=1):
    return image(np.array(values, np.uint16), "16UC1", stamp_s)


def colors(*rows, stamp_s=1):
    return image(np.array(rows, np.uint8), "rgb8", stamp_s)


def info(width=2, height=1, fx=1.0, **values):
    k = [fx, 0.0, 0.5, 0.0, 2.0, 0.0, 0.0, 0.0, 1.0]
    return get("sensor_msgs/msg/CameraInfo")(k=k, width=width, height=height, **values)


def make(**options):
    display = DepthCloudDisplay(options)
    display.topic = IMAGE
    return display


def make_with_info(**options):
    display = make(**options)
    display.take(INFO, info())
    return display


def points_of(outputs):
    content = next(each for each in outputs if isinstance(each, Content))
    return content.arrays["points"].round(4).tolist()


def colors_of(outputs):
    content = next(each for each in outputs if isinstance(each, Content))
    return content.arrays["rgba"][:, :3].tolist()


def test_millimetres_and_metres_give_the_same_points():
    metres = image(np.array([[2.0, 4.0]], np.float32), "32FC1")
    for message in (depth([[2000, 4000]]), metres):
        display = make()
        (status,) = display.take(IMAGE, message)
        assert status.text == NO_INFO
        outputs = display.take(INFO, info())
        assert points_of(outputs) == [[-1, 0, 2], [2, 0, 4]]
        content, status = outputs
        assert (content.frame_id, content.stamp_ns, status.text) == ("eye", 10**9, "")
        assert content.header["pixel"] == 1.0


def test_pixels_without_a_depth_have_no_point():
    display = make()
    display.take(INFO, info(width=6))
    row = [1.0, math.nan, 0.0, -1.0, math.inf, 2.0]
    content, status = display.take(IMAGE, image(np.array([row], np.float32), "32FC1"))
    assert len(content.arrays["points"]) == 2
    assert status.text == "2 of 6 depths are negative or not finite"
    content, status = display.take(IMAGE, depth([[0] * 6]))
    assert (len(content.arrays["points"]), status.level) == (0, "warn")
    assert status.text == "no pixel has a depth"


@pytest.mark.parametrize(
    ("values", "scale", "shift"),
    [
        ({"width": 4}, 0.5, 0.0),  # the image is half as wide as the sensor
        ({"width": 0, "height": 0, "binning_x": 2, "binning_y": 1}, 0.5, 0.0),
        ({"width": 8, "roi": {"width": 2, "height": 1, "x_offset": 3}}, 1.0, 3.0),
    ],
)
def test_a_part_of_the_sensor_or_a_coarser_image(values, scale, shift):
    roi = values.pop("roi", {})
    message = info(**values)
    for name, value in roi.items():
        setattr(message.roi, name, value)
    display = make()
    display.take(INFO, message)
    found = points_of(display.take(IMAGE, depth([[1000, 1000]])))
    center = (0.5 - shift) * scale
    assert [point[0] for point in found] == [-center / scale, (1 - center) / scale]


def test_many_pixels_are_thinned_to_a_grid():
    display = make()
    display.budget = 100
    display.take(INFO, info(width=100, height=50))
    content, _ = display.take(IMAGE, depth(np.full((50, 100), 1000)))
    assert len(content.arrays["points"]) == 91  # each eighth pixel of both sides
    assert content.header["pixel"] == 8.0
    assert (content.header["count"], content.header["shown"]) == (5000, 91)


def test_points_have_the_colours_of_the_image_of_their_time():
    display = make(color_topic=COLOR)
    assert set(display.topics("sensor_msgs/msg/Image")) == {IMAGE, INFO, COLOR}
    display.take(INFO, info())
    (status,) = display.take(IMAGE, depth([[1000, 1000]], 5))
    assert status.text == f"No image received on [{COLOR}]"
    assert display.take(COLOR, colors([[9, 9, 9], [9, 9, 9]], stamp_s=4)) == []
    outputs = display.take(COLOR, colors([[1, 2, 3], [4, 5, 6]], stamp_s=5))
    assert colors_of(outputs) == [[1, 2, 3], [4, 5, 6]]
    assert display.take(COLOR, colors([[7, 7, 7], [7, 7, 7]], stamp_s=9)) == []
    outputs = display.take(IMAGE, depth([[1000, 1000]], 8))
    assert colors_of(outputs) == [[7, 7, 7], [7, 7, 7]]


def test_a_slow_colour_image_delays_no_points():
    display = make_with_info(color_topic=COLOR)
    display.take(COLOR, colors([[1, 2, 3], [4, 5, 6]], stamp_s=1))
    assert display.take(IMAGE, depth([[1000, 1000]], 2)) == []
    outputs = display.take(IMAGE, depth([[1000, 1000]], 3))
    assert colors_of(outputs) == [[1, 2, 3], [4, 5, 6]]


def test_a_finer_colour_image_is_sampled():
    display = make_with_info(color_topic=COLOR)
    fine = [[[1, 1, 1], [2, 2, 2], [3, 3, 3], [4, 4, 4]]] * 2
    display.take(COLOR, colors(*fine))
    assert colors_of(display.take(IMAGE, depth([[1000, 1000]]))) == [[1, 1, 1], [3, 3, 3]]


@pytest.mark.parametrize(
    ("color", "line"),
    [
        (colors([[1, 1, 1]]), "the colour image of 1 x 1 pixels does not have the shape of the "),
        (image([[[1, 1, 1]] * 2], "jpeg"), "the colour image cannot be read: the encoding 'jpeg'"),
        (get("sensor_msgs/msg/Image")(encoding="rgb8"), "the colour image cannot be read: the im"),
    ],
)
def test_a_wrong_colour_image_is_named(color, line):
    display = make_with_info(color_topic=COLOR)
    color.header.stamp.sec = 9
    display.take(COLOR, color)
    (status,) = display.take(IMAGE, depth([[1000, 1000]]))
    assert (status.level, status.text[: len(line)]) == ("error", line)


@pytest.mark.parametrize(
    ("message", "line"),
    [
        (colors([[1, 1, 1]]), "the encoding 'rgb8' is not supported for depths; choose from 16UC1"),
        (get("sensor_msgs/msg/Image")(encoding="16UC1"), "the image has no pixels: 0 x 0"),
    ],
)
def test_images_without_depths_are_refused(message, line):
    display = make_with_info()
    (status,) = display.take(IMAGE, message)
    assert (status.level, status.text[: len(line)]) == ("error", line)


@pytest.mark.parametrize(
    ("fx", "line"),
    [
        (0.0, "the camera is not calibrated: a focal length in k of the CameraInfo is 0"),
        (math.nan, "k of the CameraInfo holds a number that is not finite or too large"),
        (1e-300, "no point is finite"),
    ],
)
def test_wrong_numbers_of_a_camera_are_named(fx, line):
    display = make()
    display.take(INFO, info(fx=fx))
    (status,) = display.take(IMAGE, depth([[1000, 1000]]))
    assert (status.level, status.text) == ("error", line)


def test_a_short_depth_image_is_named():
    display = make_with_info()
    short = depth([[1000, 1000]])
    short.data = b"12"
    (status,) = display.take(IMAGE, short)
    assert status.text == "2 x 1 pixels of 16UC1 need 4 bytes, the image holds 2"


def test_points_stay_for_the_decay_time_and_are_coloured_by_the_axis():
    display = make_with_info(decay_time=5, color="axis")
    parts = [display.take(IMAGE, depth([[1000, 2000]]))[0].part for _ in range(2)]
    assert parts == ["0", "1"]
    content, _ = make_with_info(color="flat", flat_color=[1, 2, 3]).take(IMAGE, depth([[1, 2]]))
    assert content.arrays["rgba"].tolist() == [[1, 2, 3, 255]] * 2


def test_a_depth_cloud_is_offered_for_depths_with_a_camera():
    kinds = further_kinds("/eye/depth/image", "sensor_msgs/msg/Image", ["/eye/depth/camera_info"])
    assert kinds == ["camera", "depth_cloud"]
    kinds = further_kinds("/eye/image", "sensor_msgs/msg/Image", ["/eye/camera_info"])
    assert kinds == ["camera"]
    assert list(displays_of("depth_cloud")) == ["sensor_msgs/msg/Image"]


def test_a_topic_of_colours_that_cannot_be_subscribed_is_named(viewer, page):
    page.send("add", id="a", kind="depth_cloud", topic=IMAGE, options={})
    page.wait_for("status", lambda packet: packet["id"] == "a")
    page.send("options", id="a", options={"color_topic": "not a topic"})
    assert "not a topic" in page.wait_for("error")["text"]
    page.send("options", id="a", options={"color_topic": COLOR})
    page.send("remove", id="a")
    page.send("add", id="a", kind="depth_cloud", topic=IMAGE, options={})
    page.send("seek", stamp=-1)  # an answer to all that was sent before
    page.wait_for("error", lambda packet: "stamp" in packet["text"])


LEFT, RIGHT = (-1, 0, 0), (1, 0, 0)


@pytest.fixture
def eye(scene):
    """A camera 4 m above the ground that looks down at it, with an image of two pixels."""
    scene.source.buffer.set_static_transform("map", "eye", (0, 0, 4), (1, 0, 0, 0))
    k = [2.0, 0, 0.5, 0, 2.0, 0, 0, 0, 1.0]
    info = stamped("sensor_msgs/msg/CameraInfo", "eye", width=2, height=1, k=k)
    scene.topic += "/depth"
    scene.source.offer(scene.topic.replace("/depth", "/camera_info"), info)
    colors = np.array([[[255, 0, 0], [0, 0, 255]]], np.uint8)
    color = picture_row("rgb8", colors)
    scene.source.offer(scene.topic.replace("/depth", "/color"), color)
    return scene


def picture_row(encoding, pixels):
    message = stamped("sensor_msgs/msg/Image", "eye", encoding=encoding, height=1, width=2)
    message.step, message.data = pixels.strides[0], pixels.tobytes()
    return message


def two_depths():
    return picture_row("16UC1", np.array([[4000, 4000]], np.uint16))


@pytest.mark.slow
@pytest.mark.parametrize("style", ["flat squares", "boxes"])
def test_points_are_as_wide_as_their_pixels(eye, style):
    eye.show("depth_cloud", two_depths(), style=style, color="flat", flat_color="#ff0000")
    # At 4 m with a focal length of 2 pixels, a pixel is 2 m wide.
    eye.expect_red(LEFT, RIGHT, (-1.9, 0.9, 0), (1.9, -0.9, 0))
    eye.expect_ground((0, 1.2, 0), (2.2, 0, 0))
    eye.set_option("auto_size_factor", 0.5)
    eye.expect_red(LEFT, (1.4, 0.4, 0))
    eye.expect_ground((0, 0, 0), (1.7, 0, 0))
    eye.set_option("size_metres", 0.2)
    eye.set_option("auto_size", False)
    eye.expect_red(LEFT)
    eye.expect_ground((1.4, 0, 0))


def test_points_have_the_colours_of_another_image(eye):
    eye.show("depth_cloud", two_depths(), color_topic=eye.topic.replace("/depth", "/color"))
    eye.expect((LEFT, RED), (RIGHT, BLUE))


def test_a_wrong_topic_of_colours_is_named(eye):
    eye.show("depth_cloud", two_depths(), color_topic="/nowhere")
    eye.expect_status("No image received on [/nowhere]")
    eye.set_option("color_topic", eye.topic.replace("/depth", "/color"))
    eye.expect((LEFT, RED), (RIGHT, BLUE))
    eye.set_option("color_topic", "")
    eye.set_option("color", "flat")
    eye.expect((LEFT, (255, 255, 255)))


def test_a_depth_image_of_colours_is_refused_with_one_line(eye):
    eye.show("depth_cloud", picture_row("rgb8", np.zeros((1, 2, 3), np.uint8)))
    eye.expect_status("the encoding 'rgb8' is not supported for depths")
    eye.send(two_depths())
    eye.set_option("color", "flat")
    eye.expect((LEFT, (255, 255, 255)))
