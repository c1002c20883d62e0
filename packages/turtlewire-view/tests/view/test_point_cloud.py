"""Clouds and scans: every layout of fields, colours, budgets."""

from __future__ import annotations

import math
from array import array

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from turtlewire import msg
from turtlewire_view.displays.laser_scan import LaserScanDisplay
from turtlewire_view.displays.point_cloud import PointCloudDisplay

DATATYPES = ["", "i1", "u1", "i2", "u2", "i4", "u4", "f4", "f8"]


def cloud(values: dict[str, np.ndarray], *, width=None, order="<", padding=0, row_padding=0):
    """A PointCloud2 of fields by name, in the given order, with bytes of padding."""
    message = msg.get_message("sensor_msgs/msg/PointCloud2")()
    new_field = msg.get_message("sensor_msgs/msg/PointField")
    count = len(next(iter(values.values())))
    message.width = count if width is None else width
    message.height = count // message.width
    message.is_bigendian = order == ">"
    message.header.frame_id = "lidar"
    offset, fields = padding, []
    for name, each in values.items():
        code = each.dtype.str[1:]
        fields.append(new_field(name=name, offset=offset, datatype=DATATYPES.index(code), count=1))
        offset += each.dtype.itemsize + padding
    message.fields, message.point_step = fields, offset
    message.row_step = offset * message.width + row_padding
    records = np.zeros((message.height, message.row_step), np.uint8)
    layout = np.dtype(
        {
            "names": list(values),
            "formats": [order + each.dtype.str[1:] for each in values.values()],
            "offsets": [field.offset for field in fields],
            "itemsize": offset,
        }
    )
    table = np.ndarray(
        (message.height, message.width), layout, records.data, strides=(message.row_step, offset)
    )
    for name, each in values.items():
        table[name] = each.reshape(table.shape)
    message.data = records.tobytes()
    return msg.deserialize(type(message), msg.serialize(message))


def xyz(count: int, dtype="f4") -> dict[str, np.ndarray]:
    steps = np.arange(count)
    return {name: (steps * k).astype(dtype) for k, name in enumerate("xyz", 1)}


@given(
    st.permutations(["x", "y", "z", "intensity"]),
    st.sampled_from(["f4", "f8", "i2", "u4"]),
    st.sampled_from("<>"),
    st.integers(0, 5),
    st.integers(0, 9),
    st.sampled_from([1, 2, 3, 6]),
)
def test_every_layout_gives_the_same_points(names, dtype, order, padding, row_padding, width):
    values = {**xyz(6, dtype), "intensity": np.arange(6, dtype="u2")}
    message = cloud(
        {name: values[name] for name in names},
        width=width, order=order, padding=padding, row_padding=row_padding,
    )  # fmt: skip
    content, status = PointCloudDisplay().content(message)
    assert status.level == "ok"
    assert content.arrays["points"].tolist() == [[k, 2 * k, 3 * k] for k in range(6)]
    assert content.frame_id == "lidar"
    assert content.arrays["rgba"][0].tolist() == [255, 0, 0, 255]  # least intensity: red
    assert content.arrays["rgba"][5].tolist() == [255, 0, 255, 255]  # greatest: violet


@pytest.mark.parametrize("order", "<>")
@pytest.mark.parametrize(("name", "alpha"), [("rgb", 255), ("rgba", 0x7F)])
def test_packed_colors(order, name, alpha):
    packed = np.array([0x7F102030, 0x7F000001], "u4")
    for bits in (packed, packed.view("f4")):
        message = cloud({**xyz(2), name: bits}, order=order)
        content, status = PointCloudDisplay().content(message)
        assert status.level == "ok"
        assert content.arrays["rgba"].tolist() == [[0x10, 0x20, 0x30, alpha], [0, 0, 1, alpha]]


def test_the_budget_keeps_the_ends_and_spreads():
    display = PointCloudDisplay()
    display.budget = 11
    content, status = display.content(cloud(xyz(1001), width=143))
    assert content.header == {"count": 1001, "shown": 11}
    assert content.arrays["points"][:, 0].tolist() == [100.0 * k for k in range(11)]
    assert status.level == "ok"


def test_points_that_are_not_finite_are_left_out():
    values = xyz(4)
    values["y"][1] = math.nan
    values["z"][2] = math.inf
    content, status = PointCloudDisplay().content(cloud(values))
    assert content.arrays["points"][:, 0].tolist() == [0, 3]
    values["x"][:] = math.nan
    (status,) = PointCloudDisplay().content(cloud(values))
    assert (status.level, status.text) == ("error", "no point is finite")


def test_far_from_the_origin_the_anchor_keeps_millimetres():
    far = {"x": 5e6 + np.array([0.0, 0.001]), "y": np.zeros(2), "z": np.zeros(2)}
    content, _ = PointCloudDisplay().content(cloud(far))
    exact = content.anchor[0] + content.arrays["points"][:, 0].astype(float)
    assert exact == pytest.approx(far["x"], abs=1e-6)


def test_missing_bytes_and_fields_are_said():
    message = cloud(xyz(10))
    message.data = message.data[: 12 * 4 + 3]
    content, status = PointCloudDisplay().content(message)
    assert len(content.arrays["points"]) == 4
    assert status.level == "warn"
    assert "10 x 1 points of 12 bytes, which are 120 bytes, and holds 51" in status.text
    (status,) = PointCloudDisplay().content(cloud({"x": np.zeros(2, "f4"), "y": np.zeros(2, "f4")}))
    assert status.text == "the cloud has no field z for positions; its fields: x, y"


def test_a_claim_of_billions_of_points_takes_no_memory():
    message = cloud(xyz(3))
    message.width = message.height = 2**32 - 1
    message.row_step = 2**32 - 1
    (status,) = PointCloudDisplay().content(message)
    assert status.level == "error"
    message.height = 1
    content, status = PointCloudDisplay().content(message)
    assert len(content.arrays["points"]) == 3
    message.fields[0].offset = 2**32 - 1
    (status,) = PointCloudDisplay().content(message)
    assert status.text == "field 'x' at 4294967295 lies outside the point of 12 bytes"
    message.fields[0].datatype = 99
    (status,) = PointCloudDisplay().content(message)
    assert status.text == "field 'x' at 4294967295 has the unknown datatype 99"
    message.point_step = 2**32 - 1
    (status,) = PointCloudDisplay().content(message)
    assert status.text == "a point_step of 4294967295 bytes is too large"


def test_options_choose_colors():
    message = cloud({**xyz(3), "ring": np.array([7, 8, 9], "u2")})
    flat = PointCloudDisplay({"color": "flat", "flat_color": [1, 2, 3]})
    assert flat.content(message)[0].arrays["rgba"].tolist() == [[1, 2, 3, 255]] * 3
    ramp = PointCloudDisplay({"color": "intensity", "channel": "ring", "rainbow": False})
    assert ramp.content(message)[0].arrays["rgba"][:, 0].tolist() == [0, 128, 255]
    _, status = PointCloudDisplay({"color": "rgb"}).content(message)
    assert status.level == "warn"
    assert "no field rgb" in status.text


def scan(ranges, intensities=(), **values):
    message = msg.get_message("sensor_msgs/msg/LaserScan")()
    message.header.frame_id = "laser"
    message.angle_min, message.angle_increment = 0.0, math.pi / 2
    message.angle_max = math.pi / 2 * (len(ranges) - 1)
    message.range_min, message.range_max = 0.5, 10.0
    message.ranges, message.intensities = list(ranges), list(intensities)
    for name, value in values.items():
        setattr(message, name, value)
    return msg.deserialize(type(message), msg.serialize(message))


def test_a_scan_hits_along_its_beams():
    content, status = LaserScanDisplay().content(scan([1.0, 2.0, math.inf, 0.1]))
    assert content.arrays["points"] == pytest.approx(np.array([[1, 0, 0], [0, 2, 0]]), abs=1e-6)
    assert status.level == "ok"
    assert content.arrays["rgba"].tolist() == [[255, 60, 40, 255]] * 2


#: A float of 32 bits that traps where it is converted; Python's own floats cannot hold it.
SIGNALLING_NAN = np.array([0x7FA00000], "u4").view("f4")


def test_signalling_nans_are_no_hits_and_no_warnings():
    message = scan([1.0, 2.0], [3.0, 4.0])
    message.ranges = array("f", np.append(np.float32(1.0), SIGNALLING_NAN).tobytes())
    message.intensities = array("f", SIGNALLING_NAN.tobytes() * 2)
    content, _ = LaserScanDisplay().content(message)
    assert content.arrays["points"].tolist() == [[1.0, 0.0, 0.0]]
    x, same = np.append(np.float32([1, 2]), SIGNALLING_NAN), np.zeros(3, "f4")
    content, _ = PointCloudDisplay().content(cloud({"x": x, "y": same, "z": same}))
    assert content.arrays["points"].tolist() == [[1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]


def test_intensities_color_a_scan():
    content, _ = LaserScanDisplay().content(scan([1.0, 2.0], [3.0, 4.0]))
    assert content.arrays["rgba"].tolist() == [[255, 0, 0, 255], [255, 0, 255, 255]]


def test_invalid_scans_are_reported():
    assert "no range lies between" in LaserScanDisplay().content(scan([math.nan, 90.0]))[-1].text
    (status,) = LaserScanDisplay().content(scan([1.0], angle_increment=math.nan))
    assert status.level == "error"
    short = LaserScanDisplay().content(scan([1.0, 1.0, 1.0], angle_max=math.pi / 2))[-1]
    assert short.text == "3 ranges, but angle_min, angle_max and angle_increment say 2"
