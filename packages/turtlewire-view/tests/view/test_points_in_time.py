"""Scans beam by beam, decay time, and colours along an axis of the fixed frame."""

from __future__ import annotations

import math

import numpy as np
import pytest

from turtlewire import msg
from turtlewire.tf.buffer import Buffer
from turtlewire_view.base import Base
from turtlewire_view.display_feed import DisplayFeed
from turtlewire_view.displays.content import Removal
from turtlewire_view.displays.laser_scan import LaserScanDisplay
from turtlewire_view.displays.point_cloud import PointCloudDisplay

from .packets import decode_packet

SECOND = 10**9
START = 1000 * SECOND


def scan(count=5, increment=0.25, **values):
    message = msg.get_message("sensor_msgs/msg/LaserScan")(
        **{
            "angle_max": (count - 1) * 1e-9,
            "angle_increment": 1e-9,  # all beams point ahead
            "range_max": 10.0,
            "ranges": [1.0] * count,
            "time_increment": increment,
            **values,
        }
    )
    message.header.frame_id = "lidar"
    message.header.stamp.sec = 1000
    return message


def turning_robot(until_s=2.0):
    """``lidar`` turns by a quarter each second and moves along x by one metre each second."""
    buffer = Buffer()
    for k in range(round(until_s * 20) + 1):
        seconds = k / 20
        half = seconds * math.pi / 4
        rotation = (0.0, 0.0, math.sin(half), math.cos(half))
        stamp = START + round(seconds * SECOND)
        buffer.set_transform("map", "lidar", stamp, (seconds, 0.0, 0.0), rotation)
    buffer.set_static_transform("lidar", "lens", (0, 0, 0), (0, 0, 0, 1))
    return buffer


def places(base, content):
    """Where the points of a content are drawn."""
    x, y, z, *turn = base.pose(content)
    points = base.arrays(content)["points"].astype(float)
    pose = Buffer()
    pose.set_static_transform("a", "b", (x, y, z), turn)
    matrix = pose.lookup_transform("a", "b", None).as_matrix()
    return points @ matrix[:3, :3].T + matrix[:3, 3]


@pytest.mark.parametrize("fixed", ["map", "lidar"])
def test_each_beam_is_drawn_from_where_the_scanner_was(fixed):
    content, status = LaserScanDisplay().content(scan())
    assert status.level == "ok"
    seen = places(Base(turning_robot(), fixed, (0.0, 0.0, 0.0)), content)
    times = np.arange(5) * 0.25
    turned = np.stack([np.cos(times * math.pi / 2), np.sin(times * math.pi / 2)], axis=1)
    expected = {"map": turned + np.stack([times, 0 * times], axis=1), "lidar": [[1, 0]] * 5}[fixed]
    np.testing.assert_allclose(seen[:, :2], expected, atol=2e-3)


def test_a_scan_without_times_is_drawn_from_its_stamp():
    for message in (scan(increment=0.0), scan(increment=1e9), scan(increment=-1.0)):
        content = LaserScanDisplay().content(message)[0]
        assert content.placed is None
    status = LaserScanDisplay().content(scan(increment=1e9))[1]
    assert status.text.startswith("time_increment 1e+09 s is not used: 5 beams would take 5e+09 s")


def feed_of(display, type_name):
    return DisplayFeed("d", display, {"/t": type_name}, lambda _: None, lambda: None)


def test_a_scan_waits_for_the_transforms_of_its_last_beam():
    feed = feed_of(LaserScanDisplay(), "sensor_msgs/msg/LaserScan")
    feed.take_message("/t", msg.serialize(scan()))
    feed.work(Base(turning_robot(until_s=0.5), "map", (0.0, 0.0, 0.0)))
    (status,) = map(decode_packet, feed.take_packets())
    assert "extrapolation into the future" in status["text"]
    assert feed.waits
    feed.work(Base(turning_robot(), "map", (0.0, 0.0, 0.0)))
    kinds = [decode_packet(packet)["type"] for packet in feed.take_packets()]
    assert kinds == ["display", "status"]


def test_in_another_fixed_frame_the_beams_are_sent_anew():
    feed = feed_of(LaserScanDisplay(), "sensor_msgs/msg/LaserScan")
    feed.take_message("/t", msg.serialize(scan()))
    buffer = turning_robot()
    points = []
    for fixed in ("map", "lidar"):
        feed.work(Base(buffer, fixed, (0.0, 0.0, 0.0)))
        (shown,) = (
            packet
            for packet in map(decode_packet, feed.take_packets())
            if packet["type"] == "display"
        )
        points.append(shown["arrays"]["points"])
    assert np.abs(points[0] - points[1]).max() > 0.5


def cloud(*heights):
    rows = np.array([(0, 0, z) for z in heights], "f4")
    Field = msg.get_message("sensor_msgs/msg/PointField")  # noqa: N806
    message = msg.get_message("sensor_msgs/msg/PointCloud2")(
        height=1, width=len(rows), point_step=12, row_step=12 * len(rows), data=rows.tobytes(),
        fields=[Field(name=n, offset=4 * k, datatype=7, count=1) for k, n in enumerate("xyz")],
    )  # fmt: skip
    message.header.frame_id = "lidar"
    return message


def test_the_axis_is_one_of_the_fixed_frame():
    buffer = Buffer()  # the sensor's z is the map's x
    half = math.sqrt(0.5)
    buffer.set_static_transform("map", "lidar", (3, 0, 0), (0, half, 0, half))
    base = Base(buffer, "map", (0.0, 0.0, 0.0))
    options = {"color": "axis", "axis": "x", "autocompute_axis": False, "axis_min": 3}
    low, high = [255, 0, 255, 255], [255, 0, 0, 255]  # of RViz's rainbow, upside down
    content = PointCloudDisplay({**options, "axis_max": 4}).content(cloud(0, 1))[0]
    seen = base.arrays(content)["rgba"].tolist()
    assert seen[0] != seen[1]
    own = PointCloudDisplay({**options, "axis_max": 4, "axis_in_fixed_frame": False})
    content = own.content(cloud(0, 1))[0]
    assert content.placed is None
    same = base.arrays(content)["rgba"].tolist()
    assert same[0] == same[1] != seen[1]
    assert {tuple(seen[0]), tuple(seen[1])} == {tuple(low), tuple(high)}


def test_points_stay_for_their_decay_time():
    now = [0]
    display = PointCloudDisplay({"decay_time": 2}, clock=lambda: now[0])

    def after(seconds):
        now[0] = round(seconds * SECOND)
        return display.content(cloud(0))[:-1]

    (first,) = after(0)
    (second,) = after(1.5)
    assert (first.part, second.part) == ("0", "1")
    assert first.header["decay"] == 2
    third, gone = after(2.5)
    assert (third.part, gone) == ("2", Removal("0"))
    assert display.start() == [Removal("1"), Removal("2")]
    assert PointCloudDisplay().content(cloud(0))[0].part == ""


def test_points_that_stay_share_the_budget():
    now = [0]
    display = PointCloudDisplay({"decay_time": 100}, clock=lambda: now[0])
    display.budget = 100
    held = {}
    for _ in range(300):
        now[0] += SECOND // 10
        for output in display.content(cloud(*range(50)))[:-1]:
            if isinstance(output, Removal):
                del held[output.part]
            else:
                held[output.part] = len(output.arrays["points"])
        assert sum(held.values()) <= 150
    assert len(held) == 100


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"angle_increment": 0.0}, "angle_increment is 0: all 5 beams are drawn at 0 rad"),
        ({"angle_max": math.nan}, "angle_max is nan: the beams are drawn by angle_min and"),
        ({"angle_increment": -0.5, "angle_max": 2.0}, "-0.5 leads from angle_min 0 away from"),
        ({"angle_increment": 0.5, "angle_max": 1.0}, "and angle_increment say 3"),
        ({"range_max": 0.0}, "none of the 5 ranges lies between range_min 0 and range_max 0"),
        ({"range_min": math.nan}, "none of the 5 ranges lies between range_min nan and"),
        ({"range_min": 3.0, "range_max": 2.0}, "lies between range_min 3 and range_max 2"),
    ],
)
def test_a_scan_with_impossible_limits_says_so(values, said):
    *_, status = LaserScanDisplay().content(scan(**values))
    assert status.level == "warn"
    assert said in status.text


@pytest.mark.parametrize("values", [{"angle_increment": math.nan}, {"angle_min": math.inf}])
def test_a_scan_without_angles_is_not_drawn(values):
    (status,) = LaserScanDisplay().content(scan(**values))
    assert status.level == "error"
    assert "must be finite" in status.text


def test_a_scan_that_turns_clockwise_is_no_mistake():
    content, status = LaserScanDisplay().content(scan(angle_increment=-0.5, angle_max=-2.0))
    assert status.level == "ok"
    assert content.arrays["points"][-1].tolist() == pytest.approx(
        [math.cos(2.0), -math.sin(2.0), 0.0]
    )
