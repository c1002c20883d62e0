"""Images, twists, wrenches, single numbers, cells, what a camera sees, clouds of the old type."""

import math
import struct

import numpy as np
import pytest

from turtlewire import msg
from turtlewire_view.displays import display_types
from turtlewire_view.displays.content import Removal
from turtlewire_view.displays.image import CompressedImageDisplay, ImageDisplay
from turtlewire_view.rviz_file import read_rviz

get = msg.get_message
Point32 = get("geometry_msgs/msg/Point32")


def message_of(type_name, frame="sensor", **values):
    message = get(type_name)(**values)
    message.header.frame_id = frame
    return message


def outputs_of(message, **options):
    return display_types()[msg.type_name(type(message))](options).content(message)


@pytest.mark.parametrize(
    ("name", "field", "straight", "turning"),
    [
        ("TwistStamped", "twist", "linear", "angular"),
        ("AccelStamped", "accel", "linear", "angular"),
        ("WrenchStamped", "wrench", "force", "torque"),
    ],
)
def test_a_twist_or_wrench_has_a_straight_and_a_turning_part(name, field, straight, turning):
    message = message_of(f"geometry_msgs/msg/{name}")
    getattr(getattr(message, field), straight).x = 2.0
    getattr(getattr(message, field), turning).z = -3.0
    content, status = outputs_of(message)
    assert (content.header, content.frame_id) == (
        {"linear": [2, 0, 0], "angular": [0, 0, -3]}, "sensor"
    )  # fmt: skip
    assert status.text == ""
    getattr(getattr(message, field), turning).z = math.nan
    (status,) = outputs_of(message)
    assert status.text == "the vector [0.0, 0.0, nan] is not finite"


def test_old_twists_go_beyond_the_history():
    display = display_types()["geometry_msgs/msg/TwistStamped"]({"history_length": 2})
    sent = [display.content(message_of("geometry_msgs/msg/TwistStamped")) for _ in range(3)]
    assert [each for each in sent[1] if isinstance(each, Removal)] == []
    assert [each.part for each in sent[2] if isinstance(each, Removal)] == ["0"]


@pytest.mark.parametrize(
    ("name", "values", "text", "color"),
    [
        ("Temperature", {"temperature": 100.0}, "100.0 °C", [255, 0, 0, 255]),
        ("Temperature", {"temperature": 50.0}, "50.0 °C", [0, 255, 128, 255]),
        ("Temperature", {"temperature": -5.0}, "-5.0 °C", [255, 0, 255, 255]),
        ("RelativeHumidity", {"relative_humidity": 0.5}, "50 %", [0, 255, 128, 255]),
        ("FluidPressure", {"fluid_pressure": 101_500.0}, "101500 Pa", [0, 255, 128, 255]),
        ("Illuminance", {"illuminance": 1e300}, "1e+300", [255, 0, 0, 255]),
    ],
)
def test_a_number_has_a_colour_between_the_usual_bounds(name, values, text, color):
    content, status = outputs_of(message_of(f"sensor_msgs/msg/{name}", **values))
    assert content.header["text"] == text
    assert content.header["color"] == pytest.approx(color, abs=1)
    assert status.text == ""


def test_bounds_of_ones_own_and_numbers_that_are_none():
    warm = message_of("sensor_msgs/msg/Temperature", temperature=30.0)
    options = {"usual_bounds": False, "min": 20, "max": 30, "rainbow": False}
    content, _ = outputs_of(warm, **options)
    assert content.header["color"] == [255, 255, 255, 255]
    (status,) = outputs_of(message_of("sensor_msgs/msg/Temperature", temperature=math.nan))
    assert status.text == "the temperature is nan"


def test_cells_and_cells_without_a_size():
    places = [get("geometry_msgs/msg/Point")(x=float(k)) for k in range(3)]
    places[1].y = math.inf
    cells = message_of("nav_msgs/msg/GridCells", cell_width=0.5, cell_height=0.25, cells=places)
    content, status = outputs_of(cells)
    assert content.header == {"size": [0.5, 0.25]}
    assert content.arrays["points"].tolist() == [[0, 0, 0], [2, 0, 0]]
    assert status.text == "1 of 3 cells are not finite"
    cells.cell_width = 0.0
    (status,) = outputs_of(cells)
    assert status.text == "cells of 0.0 m by 0.25 m cannot be drawn"


def test_a_camera_info_has_the_corners_of_the_image():
    k = [100.0, 0, 50.0, 0, 200.0, 40.0, 0, 0, 1.0]
    info = message_of("sensor_msgs/msg/CameraInfo", width=200, height=80, k=k)
    content, status = outputs_of(info)
    expected = [[-0.5, -0.2], [1.5, -0.2], [1.5, 0.2], [-0.5, 0.2]]
    assert np.array(content.header["corners"]) == pytest.approx(np.array(expected))
    assert status.text == ""
    (status,) = outputs_of(message_of("sensor_msgs/msg/CameraInfo", width=200, height=80))
    assert status.text.startswith("the camera is not calibrated")


def test_a_cloud_of_the_old_type():
    Channel = get("sensor_msgs/msg/ChannelFloat32")  # noqa: N806
    (red,) = struct.unpack("<f", struct.pack("<I", 0xFF0000))
    points = [Point32(x=float(k)) for k in range(3)]
    cloud = message_of("sensor_msgs/msg/PointCloud", points=points)
    cloud.channels = [
        Channel(name="rgb", values=[red, red, 0.0]),
        Channel(name="short", values=[1]),
    ]
    content, status = outputs_of(cloud)
    assert content.arrays["points"].tolist() == [[0, 0, 0], [1, 0, 0], [2, 0, 0]]
    assert content.arrays["rgba"].tolist() == [[255, 0, 0, 255]] * 2 + [[0, 0, 0, 255]]
    assert status.text == "the channel 'short' is left out: 1 values for 3 points"
    content, _ = outputs_of(cloud, color="flat", flat_color=[1, 2, 3])
    assert content.arrays["rgba"].tolist() == [[1, 2, 3, 255]] * 3


FILE = """
Visualization Manager:
  Displays:
    - {Class: rviz_default_plugins/TwistStamped, Linear Arrow Scale: 3, Topic: {Value: /twist}}
    - {Class: rviz_default_plugins/AccelStamped, Angular Color: 1; 2; 3, Topic: {Value: /accel}}
    - {Class: rviz_default_plugins/Wrench, Torque Arrow Scale: 0.5, Topic: {Value: /wrench}}
    - {Class: rviz_default_plugins/GridCells, Color: 255; 0; 0, Topic: {Value: /cells}}
    - {Class: rviz_default_plugins/CameraInfo, Far clip: 5, Topic: {Value: /info}}
    - {Class: rviz_default_plugins/PointCloud, Size (m): 0.5, Topic: {Value: /cloud}}
    - {Class: rviz_default_plugins/Temperature, Max Intensity: 40, Topic: {Value: /temperature}}
    - {Class: rviz_default_plugins/RelativeHumidity, Topic: {Value: /humidity}}
    - {Class: rviz_default_plugins/FluidPressure, Topic: {Value: /pressure}}
    - {Class: rviz_default_plugins/Illuminance, Topic: {Value: /light}}
"""


def test_ten_displays_of_rviz_are_read():
    view = read_rviz(FILE)
    assert view.unread == ""
    options = {each.topic: each.options for each in view.displays}
    assert options["/twist"] == {
        "linear_scale": 3, "message_type": "geometry_msgs/msg/TwistStamped"
    }  # fmt: skip
    assert options["/accel"]["angular_color"] == "#010203"
    assert options["/wrench"]["angular_scale"] == 0.5
    assert options["/cells"] == {"color": "#ff0000"}
    assert options["/info"] == {"far": 5}
    assert options["/cloud"]["message_type"] == "sensor_msgs/msg/PointCloud"
    assert options["/temperature"]["max"] == 40
    kinds = [each.kind for each in view.displays]
    assert (
        kinds
        == ["twist_or_wrench"] * 3
        + ["grid_cells", "camera_info", "point_cloud"]
        + ["measurement"] * 4
    )


PNG = bytes.fromhex("89504e470d0a1a0a0000000d49484452000000010000000108000000003a7e9b55")


def image(encoding, pixels, *, padding=0, big=False):
    """An Image of an array ``(height, width, bytes or numbers of a pixel)``."""
    message = msg.get_message("sensor_msgs/msg/Image")()
    pixels = np.asarray(pixels)
    message.height, message.width = pixels.shape[:2]
    message.encoding, message.is_bigendian = encoding, int(big)
    rows = [row.astype(pixels.dtype.newbyteorder(">" if big else "<")).tobytes() for row in pixels]
    message.step = len(rows[0]) + padding
    message.data = b"".join(row + bytes(padding) for row in rows)
    return msg.deserialize(type(message), msg.serialize(message))


def rgba(message, **options):
    content, status = ImageDisplay(options).content(message)
    assert status.level == "ok"
    assert content.frame_id is None
    return content.arrays["rgba"].tolist()


@pytest.mark.parametrize(
    ("encoding", "pixel"),
    [
        ("rgb8", [10, 20, 30]),
        ("bgr8", [30, 20, 10]),
        ("8UC3", [30, 20, 10]),
        ("rgba8", [10, 20, 30, 255]),
        ("bgra8", [30, 20, 10, 255]),
        ("8UC4", [30, 20, 10, 255]),
    ],
)
@pytest.mark.parametrize("padding", [0, 5])
def test_colors(encoding, pixel, padding):
    pixels = np.array([[pixel, pixel], [pixel, pixel]], np.uint8)
    assert rgba(image(encoding, pixels, padding=padding)) == [[[10, 20, 30, 255]] * 2] * 2


@pytest.mark.parametrize("big", [False, True])
def test_wide_colors_and_greys(big):
    assert rgba(image("rgb16", np.array([[[2560, 5120, 7680]]], "u2"), big=big)) == [
        [[10, 20, 30, 255]]
    ]
    assert rgba(image("mono16", np.array([[[0x1234]]], "u2"), big=big)) == [[[18, 18, 18, 255]]]
    depths = np.array([[[1000], [2000]]], "u2")
    assert rgba(image("16UC1", depths, big=big)) == [[[0, 0, 0, 255], [255, 255, 255, 255]]]
    metres = np.array([[[1.0], [np.nan], [3.0]]], "f4")
    assert [each[0] for each in rgba(image("32FC1", metres, big=big))[0]] == [0, 0, 255]
    fixed = rgba(image("32FC1", metres, big=big), normalize_range=False, min=0.0, max=2.0)
    assert [each[0] for each in fixed[0]] == [128, 0, 255]
    assert rgba(image("mono8", np.array([[[7]]], "u1"))) == [[[7, 7, 7, 255]]]


@pytest.mark.parametrize(
    ("encoding", "order"),
    [("yuv422", [128, 50, 128, 200]), ("uyvy", [128, 50, 128, 200]), ("yuyv", [50, 128, 200, 128])],
)
def test_yuv(encoding, order):
    pixels = np.array([[order[:2], order[2:]]], np.uint8)
    assert rgba(image(encoding, pixels)) == [[[50, 50, 50, 255], [200, 200, 200, 255]]]
    red = {"yuv422": [90, 76, 255, 76], "uyvy": [90, 76, 255, 76], "yuyv": [76, 90, 76, 255]}
    pixels = np.array([[red[encoding][:2], red[encoding][2:]]], np.uint8)
    level = rgba(image(encoding, pixels))[0][0]
    assert level[0] > 240
    assert max(level[1], level[2]) < 25


@pytest.mark.parametrize("pattern", ["rggb", "bggr", "gbrg", "grbg"])
def test_bayer(pattern):
    levels = {"r": 200, "g": 100, "b": 50}
    block = np.array([levels[each] for each in pattern], np.uint8).reshape(2, 2)
    pixels = np.tile(block, (2, 2))[..., None]
    assert rgba(image(f"bayer_{pattern}8", pixels)) == [[[200, 100, 50, 255]] * 2] * 2
    wide = pixels.astype("u2") * 256
    assert rgba(image(f"bayer_{pattern}16", wide)) == [[[200, 100, 50, 255]] * 2] * 2


def test_a_large_picture_is_made_coarser():
    pixels = np.zeros((10, 2000, 3), np.uint8)
    content, _ = ImageDisplay().content(image("rgb8", pixels))
    assert content.arrays["rgba"].shape == (4, 667, 4)
    assert content.header["width"] == 2000


@pytest.mark.parametrize(
    ("changes", "line"),
    [
        ({"encoding": "jpeg2000"}, "the encoding 'jpeg2000' is not supported; choose from rgb8"),
        ({"width": 5}, "step is 6, but a row of rgb8 needs 15"),
        ({"height": 9}, "2 x 9 pixels of rgb8 need 54 bytes, the image holds 12"),
        ({"width": 0}, "the image has no pixels: 0 x 2"),
        ({"width": 2**32 - 1, "height": 2**32 - 1}, "step is 6"),
        ({"encoding": "yuyv", "width": 1}, "yuyv needs two pixels in a row"),
    ],
)
def test_invalid_images(changes, line):
    message = image("rgb8", np.zeros((2, 2, 3), np.uint8))
    for name, value in changes.items():
        setattr(message, name, value)
    (status,) = ImageDisplay().content(message)
    assert (status.level, status.text[: len(line)]) == ("error", line)


def compressed(data, form="jpeg"):
    Message = msg.get_message("sensor_msgs/msg/CompressedImage")  # noqa: N806
    message = Message(format=form, data=data)
    return CompressedImageDisplay().content(msg.deserialize(Message, msg.serialize(message)))


def test_compressed_images_pass_through():
    content, status = compressed(b"\xff\xd8\xff\xe0rest")
    assert (content.header["media_type"], status.level) == ("image/jpeg", "ok")
    assert bytes(content.arrays["file"]) == b"\xff\xd8\xff\xe0rest"
    content, _ = compressed(PNG, "png")
    assert content.header["media_type"] == "image/png"
    content, _ = compressed(bytes(12) + PNG, "16UC1; compressedDepth png")
    assert bytes(content.arrays["file"]) == PNG


def test_files_that_are_no_pictures():
    (status,) = compressed(b"<svg onload=alert(1)>", "svg")
    assert status.text == "format 'svg': the 21 bytes are neither JPEG nor PNG"
    huge = PNG[:16] + (60_000).to_bytes(4, "big") * 2 + PNG[24:]
    (status,) = compressed(huge, "png")
    assert status.text == "a PNG of 60000 x 60000 pixels is too large"
