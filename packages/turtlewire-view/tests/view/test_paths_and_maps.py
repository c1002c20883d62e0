"""Paths, poses, odometry, covariances, polygons, points, ranges and maps."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from turtlewire import msg
from turtlewire_view.displays.content import Removal
from turtlewire_view.displays.occupancy_grid import OccupancyGridDisplay
from turtlewire_view.displays.poses import (
    OdometryDisplay,
    PathDisplay,
    PoseArrayDisplay,
    PoseDisplay,
    covariance_shape,
)
from turtlewire_view.displays.shapes import PointDisplay, PolygonDisplay, RangeDisplay

Pose = msg.get_message("geometry_msgs/msg/Pose")
PoseStamped = msg.get_message("geometry_msgs/msg/PoseStamped")


def new(type_name, frame="map", **values):
    message = msg.get_message(type_name)(**values)
    message.header.frame_id = frame
    message.header.stamp.sec = 5
    return message


def pose(x=0.0, yaw=0.0):
    result = Pose()
    result.position.x = x
    result.orientation.z, result.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return result


def path(*xs):
    return new("nav_msgs/msg/Path", poses=[PoseStamped(pose=pose(x)) for x in xs])


def test_a_path_and_its_buffer():
    display = PathDisplay({"buffer_length": 2, "pose_style": "axes"})
    content, status = display.content(path(1.0, 2.0))
    assert content.arrays["points"].tolist() == [[1, 0, 0], [2, 0, 0]]
    assert content.arrays["rotations"].tolist() == [[0, 0, 0, 1]] * 2
    assert (content.frame_id, content.stamp_ns) == ("map", 5 * 10**9)
    assert status.level == "ok"
    assert len(display.content(path(1.0))) == 2
    assert Removal(content.part) in display.content(path(1.0))


def test_a_path_with_a_pose_that_is_none():
    content, status = PathDisplay().content(path(1.0, math.nan, 3.0))
    assert content.arrays["points"][:, 0].tolist() == [1, 3]
    assert status.text == "1 of 3 poses are not finite"
    (status,) = PathDisplay().content(new("nav_msgs/msg/Path", frame=""))
    assert "header.frame_id is empty" in status.text


def test_odometry_keeps_what_moved():
    display = OdometryDisplay({"keep": 2})

    def odometry(x, yaw=0.0):
        message = new("nav_msgs/msg/Odometry", frame="odom")
        message.pose.pose = pose(x, yaw)
        return display.content(message)

    first = odometry(0.0)[0]
    assert len(odometry(0.05)) == 1  # only its status
    assert odometry(0.05, 0.2)[0].header["at"][0] == 0.05
    assert Removal(first.part) in odometry(0.2, 0.2)


@pytest.mark.parametrize(("x", "shown"), [(0.4375, False), (0.5, True), (0.5625, True)])
def test_odometry_as_far_away_as_the_tolerance_is_shown(x, shown):
    display = OdometryDisplay({"position_tolerance": 0.5})
    for place in (0.0, x):
        message = new("nav_msgs/msg/Odometry", frame="odom")
        message.pose.pose = pose(place)
        outputs = display.content(message)
    assert (len(outputs) == 2) == shown  # content and status


def test_poses():
    content, _ = PoseDisplay().content(new("geometry_msgs/msg/PoseStamped", pose=pose(2.0, 1.0)))
    assert content.header["at"] == pytest.approx(
        [2, 0, 0, 0, 0, math.sin(0.5), math.cos(0.5)]
    )  # fmt: skip
    message = new("geometry_msgs/msg/PoseWithCovarianceStamped")
    message.pose.covariance[0] = 4.0
    message.pose.covariance[35] = 0.01
    content, _ = PoseDisplay().content(message)
    assert content.header["at"] == [0, 0, 0, 0, 0, 0, 1]  # a quaternion of zeros is no rotation
    assert content.header["covariance"]["yaw"] == pytest.approx(0.1)
    message.pose.covariance[0] = -4.0
    content, status = PoseDisplay().content(message)
    assert content.header["covariance"] is None
    assert status.text == "the covariance has negative variances"
    poses = new("geometry_msgs/msg/PoseArray", poses=[pose(1.0), pose(math.nan)])
    content, status = PoseArrayDisplay().content(poses)
    assert content.arrays["points"].tolist() == [[1, 0, 0]]
    assert status.level == "warn"


@given(st.lists(st.floats(-3, 3), min_size=9, max_size=9))
def test_the_ellipsoid_is_that_of_the_covariance(numbers):
    factor = np.array(numbers).reshape(3, 3)
    covariance = np.zeros((6, 6))
    covariance[:3, :3] = factor @ factor.T
    shape = covariance_shape(covariance.reshape(-1), pytest.fail)
    if shape is None:
        assert not covariance.any()
        return
    x, y, z, w = shape["rotation"]
    rotation = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    again = rotation @ np.diag(np.square(shape["radii"])) @ rotation.T
    assert again == pytest.approx(covariance[:3, :3], abs=1e-6)


def test_polygons_points_and_ranges():
    Point32 = msg.get_message("geometry_msgs/msg/Point32")  # noqa: N806
    polygon = new("geometry_msgs/msg/PolygonStamped")
    polygon.polygon.points = [Point32(x=1.0), Point32(y=math.nan), Point32(y=2.0)]
    content, status = PolygonDisplay().content(polygon)
    assert content.arrays["points"].tolist() == [[1, 0, 0], [0, 2, 0]]
    assert status.text == "1 of 3 corners are not finite"
    display = PointDisplay()
    point = new("geometry_msgs/msg/PointStamped")
    point.point.z = 3.0
    first = display.content(point)[0]
    assert first.header["at"] == [0, 0, 3]
    assert Removal(first.part) in display.content(point)
    point.point.z = math.inf
    assert display.content(point)[0].level == "error"
    reading = new("sensor_msgs/msg/Range", range=2.0, field_of_view=0.5, max_range=4.0)
    content, status = RangeDisplay().content(reading)
    assert content.header == {"length": 2.0, "angle": 0.5}
    reading.range = math.inf
    content, status = RangeDisplay().content(reading)
    assert content.header["length"] == 4.0
    assert "nothing in reach" in status.text
    reading.range = math.nan
    assert RangeDisplay().content(reading)[0].level == "error"


def grid(width, height, cells, resolution=0.5):
    message = new("nav_msgs/msg/OccupancyGrid", data=cells)
    message.info.width, message.info.height = width, height
    message.info.resolution = resolution
    return message


def update(x, y, width, height, cells):
    return new("map_msgs/msg/OccupancyGridUpdate", x=x, y=y, width=width, height=height, data=cells)


def test_a_map_and_its_updates():
    display = OccupancyGridDisplay()
    content, status = display.content(grid(3, 2, [0, 100, -1, 1, 2, 3]))
    assert content.arrays["cells"].tolist() == [[0, 100, -1], [1, 2, 3]]
    assert (content.header["resolution"], content.header["cells"]) == (0.5, [3, 2])
    assert status.level == "ok"
    content, _ = display.content(update(1, 0, 2, 1, [7, 8]))
    assert content.event
    assert content.header == {"update": [1, 0, 2, 1]}
    assert content.arrays["cells"].tolist() == [[7, 8]]


def test_a_map_goes_with_its_frame_unless_its_stamp_is_to_count():
    display = OccupancyGridDisplay()
    assert display.start() == []
    content, _ = display.content(grid(2, 1, [0, 100]))
    assert content.locked
    display.content(update(0, 0, 1, 1, [50]))
    display.set_options({"use_timestamp": True})
    (again,) = display.start()
    assert not again.locked
    assert again.arrays["cells"].tolist() == [[50, 100]]
    assert display.start() == []
    assert not display.content(grid(2, 1, [0, 100]))[0].locked


@pytest.mark.parametrize(
    ("message", "line"),
    [
        (grid(3, 2, [0] * 5), "5 cells in data, but width 3 and height 2 say 6"),
        (grid(0, 2, []), "the map has no cells: width 0, height 2"),
        (grid(1, 1, [0], math.nan), "a resolution of nan m per cell is not valid"),
        (grid(2**32 - 1, 2**32 - 1, []), "0 cells in data"),
        (update(0, 0, 1, 1, [0]), "an update of a map that has not come yet"),
    ],
)
def test_invalid_maps(message, line):
    (status,) = OccupancyGridDisplay().content(message)
    assert (status.level, status.text[: len(line)]) == ("error", line)


def test_updates_that_do_not_fit():
    display = OccupancyGridDisplay()
    display.content(grid(3, 2, [0] * 6))
    for wrong in (update(-1, 0, 1, 1, [0]), update(2, 0, 2, 1, [0, 0]), update(0, 0, 0, 0, [])):
        assert display.content(wrong)[0].level == "error"


def test_a_large_map_is_drawn_coarser_and_keeps_obstacles():
    cells = np.zeros((2, 9000), np.int8)
    cells[1, 4000] = 100
    display = OccupancyGridDisplay()
    content, status = display.content(grid(9000, 2, cells.reshape(-1).tobytes()))
    assert content.arrays["cells"].shape == (1, 3000)
    assert content.arrays["cells"][0, 1333] == 100
    assert content.header["resolution"] == 1.5
    assert status.level == "warn"
    content, _ = display.content(update(8998, 1, 2, 1, [50, 60]))
    assert content.header["update"] == [2999, 0, 1, 1]
    assert content.arrays["cells"].tolist() == [[60]]


def with_quaternions(*ws):
    poses = [pose(float(number)) for number in range(len(ws))]
    for each, w in zip(poses, ws, strict=True):
        each.orientation.w = w
    return poses


def test_poses_with_quaternions_that_are_no_rotations():
    (zero,) = with_quaternions(0.0)
    stamped = new("geometry_msgs/msg/PoseStamped", pose=zero)
    content, status = PoseDisplay().content(stamped)
    assert content.header["at"] == [0, 0, 0, 0, 0, 0, 1]
    assert status.text == "Uninitialized quaternion, assuming identity."
    poses = with_quaternions(0.0, 1.0, 2.0)
    content, status = PoseArrayDisplay().content(new("geometry_msgs/msg/PoseArray", poses=poses))
    assert content.arrays["rotations"].tolist() == [[0, 0, 0, 1]] * 3
    assert status.text == "Uninitialized quaternion, assuming identity. (1 of 3 poses) (and 1 more)"


def test_a_path_says_so_only_when_it_draws_orientations():
    message = new("nav_msgs/msg/Path", poses=[PoseStamped(pose=p) for p in with_quaternions(0.0)])
    assert PathDisplay().content(message)[-1].level == "ok"
    status = PathDisplay({"pose_style": "axes"}).content(message)[-1]
    assert status.text == "Uninitialized quaternion, assuming identity."
