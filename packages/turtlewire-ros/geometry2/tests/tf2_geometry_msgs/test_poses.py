import copy

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import tf2_geometry_msgs as tf2
from geometry_msgs.msg import (
    Pose,
    PoseArray,
    PoseStamped,
    PoseWithCovariance,
    Quaternion,
    Transform,
    TransformStamped,
)
from nav_msgs.msg import Odometry, Path

HALF = np.sqrt(0.5)
SEED = 7


def numbers(pose):
    return tf2.array_from_pose(pose)


def some_pose(seed=0):
    random = np.random.default_rng(seed)
    return tf2.pose_from_array(
        [*random.uniform(-5, 5, 3), *Rotation.random(random_state=seed).as_quat()]
    )


def some_covariance(seed=0, size=6):
    root = np.random.default_rng(seed).normal(size=(size, size))
    return root @ root.T


def test_poses_as_homogeneous_matrices_have_it(some_world):
    pose = some_pose()
    moved = tf2.do_transform_pose(pose, some_world.message)
    target_from_source = np.eye(4)
    target_from_source[:3, :3], target_from_source[:3, 3] = (
        some_world.rotation.as_matrix(),
        some_world.translation,
    )
    assert tf2.matrix_from_pose(moved) == pytest.approx(
        target_from_source @ tf2.matrix_from_pose(pose), abs=1e-12
    )
    assert moved.orientation.w >= 0


def test_a_transform_moves_like_a_pose_and_keeps_its_child(some_world):
    inner = TransformStamped(
        child_frame_id="gripper", transform=tf2.transform_from_array(numbers(some_pose()))
    )
    inner.header.frame_id = "source"
    moved = tf2.do_transform_transform_stamped(inner, some_world.message)
    assert tf2.array_from_transform(moved) == pytest.approx(
        numbers(tf2.do_transform_pose(some_pose(), some_world.message))
    )
    assert (moved.header, moved.child_frame_id) == (some_world.message.header, "gripper")


def test_arrays_and_paths_move_pose_by_pose(some_world):
    poses = [some_pose(seed) for seed in range(4)]
    expected = [tf2.do_transform_pose(pose, some_world.message) for pose in poses]
    assert tf2.do_transform_pose_array(PoseArray(poses=poses), some_world.message).poses == expected
    path = tf2.do_transform_path(
        Path(poses=[PoseStamped(pose=pose) for pose in poses]), some_world.message
    )
    assert [pose.pose for pose in path.poses] == expected


def test_poses_of_a_path_get_the_frame_and_keep_their_stamps(quarter_turn):
    path = Path(poses=[PoseStamped(), PoseStamped()])
    path.header.frame_id = path.poses[0].header.frame_id = "source"
    path.poses[1].header.stamp.sec = 77
    moved = tf2.do_transform_path(path, quarter_turn.message)
    assert moved.header == quarter_turn.message.header
    assert [pose.header.frame_id for pose in moved.poses] == ["target", "target"]
    assert [pose.header.stamp.sec for pose in moved.poses] == [0, 77]


def test_odometry_moves_its_pose_and_keeps_its_twist(some_world):
    odometry = Odometry(child_frame_id="body")
    odometry.pose.pose.position.x = odometry.twist.twist.linear.x = 2.0
    odometry.pose.covariance = [float(i) for i in range(36)]
    before = copy.deepcopy(odometry)
    moved = tf2.do_transform_odometry(odometry, some_world.message)
    assert odometry == before
    assert moved.pose == tf2.do_transform_pose_with_covariance(odometry.pose, some_world.message)
    assert moved.twist == odometry.twist
    assert moved.twist is not odometry.twist
    assert (moved.header.frame_id, moved.child_frame_id) == (
        some_world.message.header.frame_id,
        "body",
    )


def test_a_path_through_several_frames_needs_several_transforms(quarter_turn):
    path = Path(poses=[PoseStamped()])
    path.header.frame_id, path.poses[0].header.frame_id = "source", "map"
    with pytest.raises(ValueError, match=r"poses\[0\] is in frame 'map', the path in 'source'"):
        tf2.do_transform_path(path, quarter_turn.message)


def test_a_covariance_by_hand(quarter_turn):
    covariance = np.diag([1.0, 2.0, 3.0, 4.0, 5.0, 6.0])
    covariance[0, 4] = covariance[4, 0] = 0.5  # x with the rotation about y
    moved = tf2.transform_covariance(covariance.ravel(), quarter_turn.message).reshape(6, 6)
    expected = np.diag([2.0, 1.0, 3.0, 5.0, 4.0, 6.0])
    expected[1, 3] = expected[3, 1] = -0.5  # x has become y, and y has become -x
    assert moved == pytest.approx(expected)


def test_a_covariance_is_that_of_a_cloud_of_poses(some_world):
    """Small errors of a pose are drawn, each such pose is transformed, and the errors are measured
    in the new frame.
    """
    covariance = some_covariance(SEED) * 1e-6
    pose = some_pose(SEED)
    errors = np.random.default_rng(SEED).multivariate_normal(np.zeros(6), covariance, size=20_000)
    centre = Rotation.from_quat(numbers(pose)[3:])
    turned = (Rotation.from_rotvec(errors[:, 3:]) * centre).as_quat()
    cloud = tf2.poses_from_array(np.hstack((numbers(pose)[:3] + errors[:, :3], turned)))
    moved_cloud = tf2.array_from_poses(
        tf2.do_transform_pose_array(PoseArray(poses=cloud), some_world.message).poses
    )
    moved = tf2.do_transform_pose_with_covariance(
        PoseWithCovariance(pose=pose, covariance=covariance.ravel()), some_world.message
    )
    moved_centre = numbers(moved.pose)
    new_errors = np.hstack(
        (
            moved_cloud[:, :3] - moved_centre[:3],
            (
                Rotation.from_quat(moved_cloud[:, 3:]) * Rotation.from_quat(moved_centre[3:]).inv()
            ).as_rotvec(),
        )
    )
    sampled = np.cov(new_errors.T)
    expected = moved.covariance.reshape(6, 6)
    # The standard error of a sampled covariance is sqrt((c_ii c_jj + c_ij^2) / n); six of them
    # leave one in 500 million out.
    allowed = 6 * np.sqrt(
        (np.outer(np.diag(expected), np.diag(expected)) + expected**2) / len(errors)
    )
    assert (np.abs(sampled - expected) <= allowed).all()
    assert (
        np.abs(covariance - expected).max() > 3 * allowed.max()
    )  # the tolerance would notice a covariance left as it was


@given(st.integers(0, 10_000))
def test_a_covariance_there_and_back(make_world, seed):
    world = make_world(rotation=Rotation.random(random_state=seed).as_quat())
    covariance = some_covariance(seed)
    there = tf2.transform_covariance(covariance.ravel(), world.message)
    assert tf2.transform_covariance(there, world.inverse().message).reshape(6, 6) == pytest.approx(
        covariance
    )
    assert np.linalg.eigvalsh(there.reshape(6, 6)) == pytest.approx(np.linalg.eigvalsh(covariance))


@given(st.integers(0, 10_000))
def test_poses_there_and_back(make_world, seed):
    pose = some_pose(seed + 1)
    world = make_world(
        np.random.default_rng(seed).uniform(-100, 100, 3),
        Rotation.random(random_state=seed).as_quat(),
    )
    there = tf2.do_transform_pose_stamped(PoseStamped(pose=pose), world.message)
    back = numbers(tf2.do_transform_pose_stamped(there, world.inverse().message).pose)
    assert back[:3] == pytest.approx(numbers(pose)[:3], abs=1e-9)
    assert abs(back[3:] @ numbers(pose)[3:]) == pytest.approx(1.0)


def test_pose_and_pose_stamped_confused():
    with pytest.raises(
        TypeError,
        match=r"takes a geometry_msgs\.msg\.Pose, got PoseStamped: use do_transform_pose_stamped",
    ):
        tf2.do_transform_pose(PoseStamped(), TransformStamped())
    with pytest.raises(
        TypeError, match=r"takes a geometry_msgs\.msg\.Pose, got PoseWithCovariance: use its \.pose"
    ):
        tf2.do_transform_pose(PoseWithCovariance(), TransformStamped())
    with pytest.raises(
        TypeError, match=r"takes a geometry_msgs\.msg\.PoseStamped, got Pose: use do_transform_pose"
    ):
        tf2.do_transform_pose_stamped(Pose(), TransformStamped())


def test_a_pose_without_orientation_gets_that_of_the_transform(quarter_turn):
    moved = tf2.do_transform_pose(
        Pose(orientation=Quaternion(w=0.0)), quarter_turn.message.transform
    )
    assert numbers(moved) == pytest.approx([10, 20, 30, 0, 0, HALF, HALF])
    assert (
        tf2.do_transform_transform(Transform(), quarter_turn.message)
        == quarter_turn.message.transform
    )
