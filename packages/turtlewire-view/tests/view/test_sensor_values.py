"""Twists, wrenches, single numbers, cells, what a camera sees, and clouds of the old type."""

import math
import struct

import numpy as np
import pytest

from turtlewire import msg
from turtlewire_view.displays import display_types
from turtlewire_view.displays.content import Removal
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
