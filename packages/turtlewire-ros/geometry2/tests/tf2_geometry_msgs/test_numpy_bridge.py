import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import tf2_geometry_msgs as tf2
from geometry_msgs.msg import Point, Point32, Pose, Quaternion, Transform, TransformStamped, Vector3

NUMBERS = [1.0, 2.0, 3.0, 0.5, -0.5, 0.5, 0.5]


@pytest.mark.parametrize(
    ("to_array", "from_array", "kind", "count"),
    [
        (tf2.array_from_point, tf2.point_from_array, Point, 3),
        (tf2.array_from_vector3, tf2.vector3_from_array, Vector3, 3),
        (tf2.array_from_quaternion, tf2.quaternion_from_array, Quaternion, 4),
        (tf2.array_from_pose, tf2.pose_from_array, Pose, 7),
        (tf2.array_from_transform, tf2.transform_from_array, Transform, 7),
    ],
)
def test_numbers_of_a_message_and_back(to_array, from_array, kind, count):
    message = from_array(NUMBERS[-count:])
    assert type(message) is kind
    assert to_array(message).tolist() == NUMBERS[-count:]
    assert to_array(message).dtype == np.float64
    assert from_array(to_array(message)) == message
    for wrong in (NUMBERS[: count - 1], [NUMBERS[:count]], 1.0):
        with pytest.raises(ValueError, match=rf"has the shape \({count},\), got"):
            from_array(wrong)


def test_lists_of_messages_and_back():
    rows = np.arange(21.0).reshape(3, 7)
    assert tf2.array_from_poses(tf2.poses_from_array(rows)).tolist() == rows.tolist()
    assert (
        tf2.array_from_points(tf2.points_from_array(rows[:, :3])).tolist() == rows[:, :3].tolist()
    )
    assert tf2.array_from_points([Point32(x=1.0), Vector3(y=2.0)]).tolist() == [
        [1, 0, 0],
        [0, 2, 0],
    ]
    assert tf2.array_from_poses([]).shape == (0, 7)
    assert tf2.array_from_points([]).shape == (0, 3)
    with pytest.raises(ValueError, match=r"have the shape \(N, 7\), got \(7,\)"):
        tf2.poses_from_array(NUMBERS)


def test_matrices_do_what_the_transforms_do(some_world):
    matrix = tf2.matrix_from_transform(some_world.message)
    assert matrix[:3, :3] == pytest.approx(some_world.rotation.as_matrix(), abs=1e-12)
    moved = tf2.do_transform_point(Point(x=1.0, y=2.0, z=3.0), some_world.message)
    assert matrix @ (1, 2, 3, 1) == pytest.approx([moved.x, moved.y, moved.z, 1])
    assert tf2.matrix_from_transform(some_world.message.transform).tolist() == matrix.tolist()
    assert tf2.matrix_from_transform(tf2.transform_from_matrix(matrix)) == pytest.approx(
        matrix, abs=1e-12
    )
    assert tf2.matrix_from_pose(tf2.pose_from_matrix(matrix)) == pytest.approx(matrix, abs=1e-12)


def test_a_stamped_transform_gives_its_transform():
    assert tf2.array_from_transform(TransformStamped()).tolist() == [0, 0, 0, 0, 0, 0, 1]


def test_euler_angles_of_a_message():
    quaternion = tf2.quaternion_from_euler(0.1, -0.2, 0.3)
    assert type(quaternion) is Quaternion
    assert tf2.array_from_quaternion(quaternion) == pytest.approx(
        Rotation.from_euler("xyz", (0.1, -0.2, 0.3)).as_quat()
    )
    assert tf2.euler_from_quaternion(quaternion) == pytest.approx((0.1, -0.2, 0.3))
    assert tf2.euler_from_quaternion(quaternion, "rzyx") == pytest.approx((0.3, -0.2, 0.1))
    assert tf2.quaternion_from_euler(0.3, -0.2, 0.1, "rzyx") == quaternion


def test_arrays_share_nothing_with_messages():
    pose = Pose()
    array = tf2.array_from_pose(pose)
    array += 5
    assert pose == Pose()
