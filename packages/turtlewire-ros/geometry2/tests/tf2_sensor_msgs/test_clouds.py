import copy
from array import array

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import tf2_ros
import tf2_sensor_msgs
from geometry_msgs.msg import PointStamped, TransformStamped
from sensor_msgs.msg import PointCloud2, PointField
from sensor_msgs_py import point_cloud2
from std_msgs.msg import Header
from tf2_geometry_msgs import do_transform_point, point_from_array, transform_from_array
from tf2_sensor_msgs import do_transform_cloud, transform_points

ROTATION = Rotation.from_euler("xyz", (0.3, -0.8, 2.1))
TRANSLATION = np.array((1.0, -20.0, 300.0))


@pytest.fixture
def transform():
    message = TransformStamped(transform=transform_from_array([*TRANSLATION, *ROTATION.as_quat()]))
    message.header.frame_id, message.header.stamp.sec = "target", 5
    return message


def make_cloud(dtype, values, *, shape=None, row_gap=0, bigendian=False):
    """A cloud of a structured dtype.

    Values of its fields by name; rows may be followed by a gap of filled bytes.
    """
    points = np.zeros(
        len(next(iter(values.values()))), np.dtype(dtype).newbyteorder(">" if bigendian else "<")
    )
    for name, column in values.items():
        points[name] = column
    width, height = shape or (len(points), 1)
    step = points.dtype.itemsize
    rows = np.full((height, width * step + row_gap), 0xAB, np.uint8)
    rows[:, : width * step] = points.view(np.uint8).reshape(height, width * step)
    types = {"f4": 7, "f8": 8, "u2": 4, "u1": 2, "i2": 3}
    fields = [
        PointField(name=name, offset=offset, datatype=types[format_.base.str[1:]], count=1)
        for name, (format_, offset) in points.dtype.fields.items()
    ]
    cloud = PointCloud2(
        height=height,
        width=width,
        fields=fields,
        is_bigendian=bigendian,
        point_step=step,
        row_step=rows.shape[1],
    )
    cloud.header.frame_id, cloud.header.stamp.sec = "source", 99
    cloud.data = array("B", rows.tobytes())
    return cloud


def read(cloud, *names):
    """Read the columns of a cloud independently: row by row, as struct does."""
    rows = np.frombuffer(cloud.data, np.uint8).reshape(cloud.height, cloud.row_step)[
        :, : cloud.width * cloud.point_step
    ]
    points = rows.reshape(-1, cloud.point_step)
    order, columns = ">" if cloud.is_bigendian else "<", []
    for field in (field for name in names for field in cloud.fields if field.name == name):
        dtype = np.dtype(order + {7: "f4", 8: "f8", 4: "u2"}[field.datatype])
        columns.append(
            points[:, field.offset : field.offset + dtype.itemsize]
            .copy()
            .view(dtype)[:, 0]
            .astype(float)
        )
    return np.stack(columns, axis=-1)


def xyz(count=6, seed=0):
    values = (
        np.random.default_rng(seed).uniform(-50, 50, (count, 3)).astype(np.float32).astype(float)
    )
    return values, dict(zip("xyz", values.T, strict=True))


XYZI = [("x", "f4"), ("y", "f4"), ("z", "f4"), ("intensity", "u2")]
LAYOUTS = {
    "packed": XYZI,
    "double": [("x", "f8"), ("y", "f8"), ("z", "f8")],
    "mixed": {
        "names": ["z", "ring", "x", "y"],
        "formats": ["f8", "u2", "f4", "f4"],
        "offsets": [3, 1, 17, 30],
        "itemsize": 37,
    },
    "padded": {
        "names": ["x", "y", "z"],
        "formats": ["f4"] * 3,
        "offsets": [0, 4, 8],
        "itemsize": 32,
    },
}


@pytest.mark.parametrize("bigendian", [False, True])
@pytest.mark.parametrize(("shape", "row_gap"), [(None, 0), ((3, 2), 0), ((2, 3), 5), ((1, 6), 1)])
@pytest.mark.parametrize("layout", LAYOUTS)
def test_every_layout(transform, layout, shape, row_gap, bigendian):
    values, columns = xyz()
    cloud = make_cloud(LAYOUTS[layout], columns, shape=shape, row_gap=row_gap, bigendian=bigendian)
    before = copy.deepcopy(cloud)
    moved = do_transform_cloud(cloud, transform)
    assert cloud == before
    assert read(moved, "x", "y", "z") == pytest.approx(
        ROTATION.apply(values) + TRANSLATION, rel=1e-6
    )
    for name in ("height", "width", "fields", "is_bigendian", "point_step", "row_step", "is_dense"):
        assert getattr(moved, name) == getattr(cloud, name)
    changed = np.frombuffer(moved.data, np.uint8) != np.frombuffer(cloud.data, np.uint8)
    coordinates = np.zeros((cloud.height, cloud.row_step), bool)
    for point in range(cloud.width):
        for field in cloud.fields:
            if field.name in "xyz":
                start = point * cloud.point_step + field.offset
                coordinates[:, start : start + (4 if field.datatype == 7 else 8)] = True
    assert not (changed & ~coordinates.ravel()).any()


def test_normals_are_turned_and_not_moved(transform):
    values, columns = xyz()
    normals = Rotation.random(6, random_state=4).as_matrix()[:, 0]
    layout = [
        *XYZI,
        ("normal_x", "f4"),
        ("normal_y", "f4"),
        ("normal_z", "f4"),
        ("curvature", "f4"),
    ]
    columns |= dict(zip(("normal_x", "normal_y", "normal_z"), normals.T, strict=True)) | {
        "curvature": np.arange(6)
    }
    moved = do_transform_cloud(make_cloud(layout, columns), transform)
    assert read(moved, "normal_x", "normal_y", "normal_z") == pytest.approx(
        ROTATION.apply(normals), abs=1e-6
    )
    assert read(moved, "x", "y", "z") == pytest.approx(
        ROTATION.apply(values) + TRANSLATION, rel=1e-6
    )
    assert read(moved, "curvature").ravel().tolist() == [0, 1, 2, 3, 4, 5]


def test_the_stamp_is_the_clouds_and_the_frame_the_transforms(transform):
    cloud = make_cloud(XYZI, xyz()[1])
    moved = do_transform_cloud(cloud, transform)
    assert (moved.header.frame_id, moved.header.stamp.sec) == ("target", 99)
    bare = do_transform_cloud(cloud, transform.transform)
    assert (bare.header.frame_id, bare.header.stamp.sec) == ("source", 99)
    assert bare.data == moved.data
    moved.header.stamp.sec, moved.fields[0].name, moved.data[0] = 0, "changed", moved.data[0] ^ 1
    assert cloud == make_cloud(XYZI, xyz()[1])
    assert transform.header.stamp.sec == 5


def test_a_buffer_transforms_clouds(transform):
    buffer = tf2_ros.Buffer()
    transform.child_frame_id = "source"
    buffer.set_transform_static(transform, "test")
    moved = buffer.transform(make_cloud(XYZI, xyz()[1]), "target")
    assert read(moved, "x", "y", "z") == pytest.approx(
        ROTATION.apply(xyz()[0]) + TRANSLATION, rel=1e-6
    )
    assert tf2_ros.convert(moved, PointCloud2) == moved


def test_far_away_nothing_is_lost():
    """Coordinates of a map, in the millions of metres, come into a frame nearby.

    Single precision would be 0.25 m off.
    """
    transform = transform_from_array([-4e6, 0, 0, 0, 0, 0, 1])
    cloud = make_cloud(
        [("x", "f8"), ("y", "f4"), ("z", "f4")], {"x": [4e6 + 0.125], "y": [1.0], "z": [0.0]}
    )
    assert read(do_transform_cloud(cloud, transform), "x", "y", "z").tolist() == [[0.125, 1.0, 0.0]]


def test_more_points_than_a_block(transform):
    values, columns = xyz(20_001)
    moved = do_transform_cloud(make_cloud(XYZI, columns), transform)
    assert read(moved, "x", "y", "z") == pytest.approx(
        ROTATION.apply(values) + TRANSLATION, rel=1e-5, abs=1e-4
    )


def test_points_that_were_not_seen_stay_unseen_and_say_nothing(transform):
    unseen = np.array((np.nan, np.inf, -np.inf, 1.0, 3e38))
    cloud = make_cloud(XYZI, {"x": unseen, "y": unseen, "z": unseen})
    moved = read(do_transform_cloud(cloud, transform), "x", "y", "z")
    assert not np.isfinite(moved[:3]).any()
    assert np.isfinite(moved[3]).all()


def test_no_points(transform):
    assert do_transform_cloud(make_cloud(XYZI, {"x": []}), transform).data == array("B")
    assert transform_points(np.empty((0, 3)), transform).shape == (0, 3)


def test_clouds_that_sensor_msgs_py_made(transform):
    cloud = point_cloud2.create_cloud_xyz32(Header(frame_id="source"), xyz()[0])
    moved = do_transform_cloud(cloud, transform)
    assert point_cloud2.read_points_numpy(moved) == pytest.approx(
        ROTATION.apply(xyz()[0]) + TRANSLATION, rel=1e-6
    )


@pytest.mark.parametrize(
    "kind", [bytes, bytearray, list, lambda data: np.frombuffer(data, np.uint8)]
)
def test_data_of_any_kind(transform, kind):
    cloud = make_cloud(XYZI, xyz()[1])
    expected = do_transform_cloud(cloud, transform)
    cloud.data = kind(cloud.data)
    assert do_transform_cloud(cloud, transform) == expected


def test_mistakes_are_reported(transform):
    cloud = make_cloud([("x", "f4"), ("y", "f4")], {"x": [1.0], "y": [1.0]})
    with pytest.raises(
        AssertionError, match=r"^Point cloud needs the fields x, y, and z for the transformation$"
    ):
        do_transform_cloud(cloud, transform)
    cloud = make_cloud([("x", "i2"), ("y", "f4"), ("z", "f4")], {"x": [1]})
    with pytest.raises(
        ValueError, match=r"field 'x' has datatype 3; only FLOAT32 \(7\) and FLOAT64 \(8\)"
    ):
        do_transform_cloud(cloud, transform)
    cloud = make_cloud(XYZI, xyz()[1])
    cloud.width = 7
    with pytest.raises(
        ValueError,
        match=r"7 x 1 points with point_step 14 and row_step 84 needs 98 bytes of data .* has 84",
    ):
        do_transform_cloud(cloud, transform)
    cloud.width, cloud.fields[2].offset = 6, 12
    with pytest.raises(ValueError, match=r"field 'z' ends at byte 16 of a point of 14 bytes"):
        do_transform_cloud(cloud, transform)
    cloud.row_step, cloud.width, cloud.height = 10, 3, 2
    with pytest.raises(
        ValueError, match=r"row_step 10 needs 52 bytes of data in rows of at least 42, has 84"
    ):
        do_transform_cloud(cloud, transform)


def test_an_unset_row_step_means_packed_rows(transform):
    cloud = make_cloud(XYZI, xyz()[1], shape=(3, 2))
    expected = do_transform_cloud(cloud, transform).data
    cloud.row_step = 0
    assert do_transform_cloud(cloud, transform).data == expected


@given(st.lists(st.tuples(*[st.floats(-1e6, 1e6)] * 3), max_size=20), st.integers(0, 10_000))
def test_arrays_as_single_points_have_it_and_back(points, seed):
    rotation = Rotation.random(random_state=seed)
    there = TransformStamped(transform=transform_from_array([1, 2, 3, *rotation.as_quat()]))
    back = transform_from_array([*-rotation.inv().apply((1, 2, 3)), *rotation.inv().as_quat()])
    array_ = np.array(points, dtype=float).reshape(-1, 3)
    before = array_.copy()
    moved = transform_points(array_, there)
    assert (array_ == before).all()
    for row, point in zip(moved, array_, strict=True):
        single = do_transform_point(PointStamped(point=point_from_array(point)), there).point
        assert row == pytest.approx((single.x, single.y, single.z), abs=1e-8)
    assert transform_points(moved, back) == pytest.approx(array_, abs=1e-8)


def test_points_of_any_type_and_stride(transform):
    values = np.arange(60, dtype=np.int16).reshape(10, 6)[::2, ::2]
    expected = ROTATION.apply(values) + TRANSLATION
    assert transform_points(values, transform.transform) == pytest.approx(expected)
    assert transform_points(values.tolist(), transform) == pytest.approx(expected)
    with pytest.raises(ValueError, match=r"points have the shape \(N, 3\), got \(3,\)"):
        transform_points((1, 2, 3), transform)


def test_the_package_lists_what_it_has():
    assert tf2_sensor_msgs.__all__ == [
        "do_transform_cloud",
        "from_msg_msg",
        "to_msg_msg",
        "transform_points",
    ]


def test_ros_2s_module_path_has_ros_2s_functions():
    from tf2_sensor_msgs import tf2_sensor_msgs as module

    assert module.__all__ == tf2_sensor_msgs.__all__
    assert module.do_transform_cloud is do_transform_cloud
