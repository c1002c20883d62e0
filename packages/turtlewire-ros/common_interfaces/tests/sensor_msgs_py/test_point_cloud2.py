"""Point clouds to NumPy and back."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as st_numpy

from sensor_msgs.msg import PointCloud2, PointField
from sensor_msgs_py import point_cloud2
from std_msgs.msg import Header
from turtlewire import msg

HEADER = Header(frame_id="lidar")
MIXED = [
    PointField(name="x", offset=0, datatype=PointField.FLOAT32, count=1),
    PointField(name="ring", offset=4, datatype=PointField.UINT16, count=1),
    PointField(name="rgb", offset=6, datatype=PointField.UINT8, count=3),
]


@given(
    st_numpy.arrays(
        np.float32, st.tuples(st.integers(0, 5), st.just(3)), elements=st.floats(width=32)
    )
)
def test_points_come_back_as_they_went_in(points):
    cloud = point_cloud2.create_cloud_xyz32(HEADER, points)
    cloud = msg.deserialize(PointCloud2, msg.serialize(cloud))
    np.testing.assert_array_equal(point_cloud2.read_points_numpy(cloud), points)


def test_a_cloud_of_tuples():
    cloud = point_cloud2.create_cloud_xyz32(HEADER, [(1, 2, 3), (4, 5, 6)])
    assert (cloud.header, cloud.height, cloud.width, cloud.point_step, cloud.row_step) == (
        HEADER,
        1,
        2,
        12,
        24,
    )
    assert (cloud.is_dense, cloud.is_bigendian) == (False, False)
    assert [field.name for field in cloud.fields] == ["x", "y", "z"]
    assert point_cloud2.read_points_list(cloud, ["z", "x"]) == [(3.0, 1.0), (6.0, 4.0)]
    assert point_cloud2.read_points_list(cloud)[1].y == 5.0
    assert point_cloud2.read_points(cloud)["y"].tolist() == [2.0, 5.0]


def test_fields_of_several_types_and_counts():
    points = np.zeros(2, dtype=point_cloud2.dtype_from_fields(MIXED, point_step=16))
    points["ring"] = [7, 8]
    points["rgb_2"] = [255, 1]
    cloud = point_cloud2.create_cloud(HEADER, MIXED, points, point_step=16)
    assert cloud.point_step == 16
    read = point_cloud2.read_points(cloud)
    assert read.dtype.names == ("x", "ring", "rgb_0", "rgb_1", "rgb_2")
    np.testing.assert_array_equal(read, points)
    with pytest.raises(AssertionError, match="All fields need to have the same datatype"):
        point_cloud2.read_points_numpy(cloud)
    assert point_cloud2.read_points_numpy(cloud, ["ring"]).tolist() == [[7], [8]]


def test_points_with_nan_are_skipped_unless_the_cloud_is_dense():
    cloud = point_cloud2.create_cloud_xyz32(HEADER, [(1, 2, 3), (np.nan, 5, 6), (7, 8, 9)])
    assert len(point_cloud2.read_points(cloud)) == 3
    assert point_cloud2.read_points_numpy(cloud, skip_nans=True)[:, 0].tolist() == [1.0, 7.0]
    assert point_cloud2.read_points_numpy(cloud, skip_nans=True, uvs=[1]).tolist() == [
        [7.0, 8.0, 9.0]
    ]
    cloud.is_dense = True
    assert len(point_cloud2.read_points(cloud, skip_nans=True)) == 3


def test_clouds_with_rows_keep_their_shape():
    points = np.arange(12, dtype=np.float32).reshape(2, 2, 3)
    cloud = point_cloud2.create_cloud_xyz32(HEADER, points)
    assert (cloud.width, cloud.height) == (2, 2)
    np.testing.assert_array_equal(
        point_cloud2.read_points_numpy(cloud, reshape_organized_cloud=True), points
    )
    assert point_cloud2.read_points(cloud).shape == (4,)
    with pytest.raises(AssertionError, match="Too many dimensions for organized cloud!"):
        point_cloud2.create_cloud_xyz32(HEADER, np.zeros((1, 1, 1, 3), dtype=np.float32))


def test_padding_between_rows_is_no_point():
    cloud = point_cloud2.create_cloud_xyz32(HEADER, np.arange(12.0).reshape(4, 3))
    rows = np.frombuffer(cloud.data, np.uint8).reshape(2, 24)
    padded = np.hstack([rows, np.full((2, 5), 255, np.uint8)])
    cloud.height, cloud.width, cloud.row_step, cloud.data = 2, 2, 29, padded.tobytes()
    np.testing.assert_array_equal(
        point_cloud2.read_points_numpy(cloud), np.arange(12.0).reshape(4, 3)
    )
    assert point_cloud2.read_points_list(cloud, ["x"], uvs=[2]) == [(6.0,)]
    cloud.row_step = 0  # many writers leave it unset
    np.testing.assert_array_equal(
        point_cloud2.read_points_numpy(cloud)[:2], np.arange(6.0).reshape(2, 3)
    )


def test_big_endian_clouds_are_swapped():
    cloud = point_cloud2.create_cloud_xyz32(HEADER, [(1, 2, 3)])
    cloud.data = np.array([1, 2, 3], dtype=">f4").tobytes()
    cloud.is_bigendian = True
    assert point_cloud2.read_points_numpy(cloud).tolist() == [[1.0, 2.0, 3.0]]


def test_mistakes_are_named():
    cloud = point_cloud2.create_cloud_xyz32(HEADER, [(1, 2, 3)])
    with pytest.raises(
        AssertionError, match="Requests field is not in the fields of the point cloud"
    ):
        point_cloud2.read_points(cloud, ["intensity"])
    with pytest.raises(AssertionError, match="do not match for all fields"):
        point_cloud2.create_cloud(HEADER, MIXED, np.zeros(1, dtype=[("x", "f8")]))
    with pytest.raises(AssertionError, match="Pass a structured NumPy array"):
        point_cloud2.create_cloud(HEADER, MIXED, np.zeros((1, 5)))
    with pytest.raises(AssertionError, match="Can't process fields with count = 0"):
        point_cloud2.dtype_from_fields([PointField(name="x", datatype=PointField.INT8)])
    with pytest.raises(AssertionError, match="Duplicate field names are not allowed!"):
        point_cloud2.dtype_from_fields([MIXED[0], MIXED[0]])
    cloud.width = 5
    with pytest.raises(TypeError, match="buffer is too small"):
        point_cloud2.read_points(cloud)
