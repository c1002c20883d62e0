"""Forward kinematics: against yourdfpy, and laws that hold for every robot."""

from __future__ import annotations

import io
import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from turtlewire.urdf import Follower, Kinematics, UrdfError, followers_of, parse_urdf

NAMES = ("arm", "differential_drive", "gripper", "hexapod", "quadruped", "tree")
STATES = 1000


@pytest.fixture(params=NAMES)
def kinematics(request, robots):
    return Kinematics(parse_urdf(robots[request.param]))


@pytest.fixture
def gripper(robots):
    return Kinematics(parse_urdf(robots["gripper"]))


def matrices(poses):
    """Poses (..., 7) as matrices (..., 4, 4), by scipy."""
    from scipy.spatial.transform import Rotation

    out = np.zeros((*poses.shape[:-1], 4, 4))
    rotation = Rotation.from_quat(poses[..., 3:].reshape(-1, 4)).as_matrix()
    out[..., :3, :3] = rotation.reshape(*poses.shape[:-1], 3, 3)
    out[..., :3, 3] = poses[..., :3]
    out[..., 3, 3] = 1.0
    return out


def random_states(kinematics, number, seed=0):
    return np.random.default_rng(seed).uniform(-4.0, 4.0, (number, len(kinematics.joints)))


def all_positions(robot, state):
    """Positions of all moving joints from those of the free ones, by the definition of mimic."""

    def position(joint):
        if joint.mimic is None:
            return state[joint.name]
        leader = position(robot.joints[joint.mimic.joint])
        return joint.mimic.multiplier * leader + joint.mimic.offset

    return {joint.name: position(joint) for joint in robot.joints.values() if joint.moves}


def for_yourdfpy(robot, positions):
    """yourdfpy, unlike KDL, slides by the position times the axis as the file gives it."""
    return {
        name: position / np.linalg.norm(robot.joints[name].axis)
        if robot.joints[name].type == "prismatic"
        else position
        for name, position in positions.items()
    }


@pytest.mark.parametrize("count", [100, pytest.param(STATES, marks=pytest.mark.slow)])
def test_as_yourdfpy(kinematics, robots, count):
    import yourdfpy

    robot = kinematics.robot
    # yourdfpy does not resolve mimic joints of mimic joints: it gets all positions.
    free = re.sub("<mimic[^>]*/>", "", robots[robot.name])
    oracle = yourdfpy.URDF.load(io.StringIO(free), build_scene_graph=True)
    states = random_states(kinematics, count)
    found = matrices(kinematics.link_poses(states))
    for state, links in zip(states, found, strict=True):
        named = dict(zip(kinematics.joints, state.tolist(), strict=True))
        oracle.update_cfg(for_yourdfpy(robot, all_positions(robot, named)))
        wanted = [oracle.get_transform(link) for link in kinematics.links]
        np.testing.assert_allclose(links, wanted, rtol=0, atol=1e-9)


def test_as_yourdfpy_with_its_own_mimic_joints(robots):
    """One level, which it resolves itself."""
    import yourdfpy

    text = re.sub('<mimic joint="finger[^>]*/>', "", robots["gripper"])
    text = text.replace("1 2 -2", "1 0 0")  # it slides by other lengths, so others would follow
    kinematics = Kinematics(parse_urdf(text))
    oracle = yourdfpy.URDF.load(io.StringIO(text), build_scene_graph=True)
    for state in random_states(kinematics, 50):
        named = dict(zip(kinematics.joints, state.tolist(), strict=True))
        oracle.update_cfg(for_yourdfpy(kinematics.robot, named))
        wanted = [oracle.get_transform(link) for link in kinematics.links]
        found = matrices(kinematics.link_poses(named))[0]
        np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-9)


def rpy_matrix(rpy):
    from scipy.spatial.transform import Rotation

    return Rotation.from_euler("xyz", rpy).as_matrix()  # lower case: fixed axes


def test_at_zero_every_link_stands_at_its_origin(kinematics):
    robot = kinematics.robot
    placed = dict(zip(kinematics.links, matrices(kinematics.link_poses({}))[0], strict=True))
    assert np.array_equal(placed[robot.root], np.eye(4))
    for joint in robot.joints.values():
        if joint.name in kinematics.followers:
            continue  # the offset of its mimic moves it
        origin = np.eye(4)
        origin[:3, :3], origin[:3, 3] = rpy_matrix(joint.origin.rpy), joint.origin.xyz
        wanted = placed[joint.parent] @ origin
        np.testing.assert_allclose(placed[joint.child], wanted, rtol=0, atol=1e-12)


def test_a_link_is_its_parent_and_its_joint(kinematics):
    states = random_states(kinematics, 20)
    poses, local = matrices(kinematics.link_poses(states)), kinematics.joint_transforms(states)
    index = {name: number for number, name in enumerate(kinematics.links)}
    for number, link in enumerate(kinematics.links[1:]):
        parent = poses[:, index[kinematics.robot.parent_joints[link].parent]]
        wanted = parent @ matrices(local[:, number])
        np.testing.assert_allclose(poses[:, index[link]], wanted, rtol=0, atol=1e-12)


def test_a_batch_is_its_rows(kinematics):
    states = random_states(kinematics, 5)
    rows = [kinematics.link_poses(state)[0] for state in states]
    np.testing.assert_array_equal(kinematics.link_poses(states), rows)
    assert kinematics.link_poses(states).shape == (5, len(kinematics.links), 7)
    assert kinematics.link_poses(states[:0]).shape == (0, len(kinematics.links), 7)


def one_joint(kind, **attributes):
    limit = '<limit effort="1" velocity="1" lower="-1" upper="1"/>'
    axis = attributes.get("axis", "0 0 1")
    return Kinematics(
        parse_urdf(
            f'<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="{kind}">'
            f'<parent link="a"/><child link="b"/><axis xyz="{axis}"/>{limit}</joint></robot>'
        )
    )


angles = st.floats(-10, 10)
axes = st.tuples(*[st.floats(-1e200, 1e200)] * 3).filter(any)


@given(angles, angles, axes)
def test_two_turns_about_one_axis_are_their_sum(first, second, axis):
    kinematics = one_joint("continuous", axis=" ".join(map(repr, axis)))
    turn = [
        matrices(kinematics.link_poses({"j": q}))[0, 1] for q in (first, second, first + second)
    ]
    np.testing.assert_allclose(turn[0] @ turn[1], turn[2], rtol=0, atol=1e-9)
    np.testing.assert_allclose(turn[0][:3, :3] @ turn[0][:3, :3].T, np.eye(3), rtol=0, atol=1e-12)


@given(angles, axes)
def test_a_slide_goes_as_far_as_its_position(position, axis):
    kinematics = one_joint("prismatic", axis=" ".join(map(repr, axis)))
    pose = kinematics.link_poses({"j": position})[0, 1]
    assert np.linalg.norm(pose[:3]) == pytest.approx(abs(position), abs=1e-9)
    np.testing.assert_array_equal(pose[3:], [0, 0, 0, 1])


@given(angles)
def test_mimic_joints_follow_through_the_chain(position):
    robot = parse_urdf(CHAIN)
    kinematics = Kinematics(robot)
    wanted = all_positions(robot, {"a": position})
    free = Kinematics(parse_urdf(re.sub("<mimic[^>]*/>", "", CHAIN)))
    np.testing.assert_allclose(
        kinematics.link_poses({"a": position}), free.link_poses(wanted), rtol=0, atol=1e-9
    )


def chain_link(name, mimic):
    return (
        f'<link name="{name}_link"/><joint name="{name}" type="continuous"><parent link="base"/>'
        f'<child link="{name}_link"/><origin xyz="1 2 3"/>{mimic}</joint>'
    )


CHAIN = (
    '<robot name="chain"><link name="base"/>'
    + chain_link("c", '<mimic joint="b" multiplier="-2" offset="0.5"/>')
    + chain_link("b", '<mimic joint="a" multiplier="0.25" offset="-1"/>')
    + chain_link("a", "")
    + "</robot>"
)


def test_followers(gripper):
    assert gripper.joints == ("slide_joint", "nail_joint")
    assert gripper.followers == {
        "finger_a_joint": Follower("slide_joint", -3.0, 0.625),
        "finger_b_joint": Follower("slide_joint", 1.5, -0.25),
        "tip_a_joint": Follower("slide_joint", -1.5, 0.3125),
        "tip_b_joint": Follower("slide_joint", 1.5, -0.25),
    }


def test_a_joint_that_follows_no_joint_is_free():
    robot = parse_urdf(CHAIN.replace('joint="a"', 'joint="ghost"'))
    assert Kinematics(robot).joints == ("b", "a")


def test_joints_that_follow_each_other_are_refused():
    text = CHAIN.replace('<robot name="chain">', '<robot name="chain">\n')
    loop = parse_urdf(text.replace('joint="a"', 'joint="c"'))
    with pytest.raises(UrdfError, match="in a loop: c -> b -> c") as caught:
        followers_of(loop)
    assert caught.value.line == 2


def test_ten_thousand_joints_that_follow_each_other():
    links = "".join(
        chain_link(f"j{number}", f'<mimic joint="j{number - 1}" offset="1"/>')
        for number in range(9999, 0, -1)
    )
    robot = parse_urdf(f'<robot name="r"><link name="base"/>{links}{chain_link("j0", "")}</robot>')
    assert followers_of(robot)["j9999"] == Follower("j0", 1.0, 9999.0)


def test_ten_thousand_links_in_a_row():
    links = "".join(f'<link name="l{number}"/>' for number in range(10_000))
    joints = "".join(
        f'<joint name="j{number}" type="fixed"><parent link="l{number}"/>'
        f'<child link="l{number + 1}"/><origin xyz="1 0 0"/></joint>'
        for number in range(9999)
    )
    poses = Kinematics(parse_urdf(f'<robot name="r">{links}{joints}</robot>')).link_poses([[]])
    assert poses[0, -1, 0] == 9999.0


def test_limits(kinematics):
    states = random_states(kinematics, 100)
    clipped = kinematics.clipped(states)
    assert kinematics.within_limits(clipped).all()
    inside = kinematics.within_limits(states)
    np.testing.assert_array_equal(clipped[inside], states[inside])
    for column, name in enumerate(kinematics.joints):
        endless = kinematics.robot.joints[name].type == "continuous"
        wanted = (-np.inf, np.inf) if endless else (-2.0, 1.5)
        assert (kinematics.lower[column], kinematics.upper[column]) == wanted
    nan = np.full(len(kinematics.joints), np.nan)
    assert not kinematics.within_limits(nan).any()


def test_states_by_name(gripper):
    by_name = {"nail_joint": [0.1, 0.2, 0.3], "slide_joint": 1.0}
    np.testing.assert_array_equal(
        gripper.joint_states(by_name), [[1.0, 0.1], [1.0, 0.2], [1.0, 0.3]]
    )
    with pytest.raises(KeyError, match="follows 'slide_joint'"):
        gripper.joint_states({"tip_a_joint": 1.0})
    with pytest.raises(KeyError, match="Did you mean: slide_joint"):
        gripper.joint_states({"slide_joit": 1.0})
    with pytest.raises(ValueError, match=r"shape \(N, 2\)"):
        gripper.joint_states([[1.0]])


def test_floating_and_planar_joints_stay_at_their_origin():
    for kind in ("floating", "planar"):
        kinematics = one_joint(kind)
        assert kinematics.joints == ()
        np.testing.assert_array_equal(kinematics.link_poses({})[0, 1], [0, 0, 0, 0, 0, 0, 1])
