"""Forward kinematics: against yourdfpy, and laws that hold for every robot."""

import io
import pickle
import re
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from turtlewire.urdf import Robot, UrdfError
from turtlewire.urdf.joints import Follower, followers_of

NAMES = ("arm", "differential_drive", "gripper", "hexapod", "quadruped", "tree")
STATES = 1000


@pytest.fixture(params=NAMES)
def robot(request, robots):
    return Robot.from_xml(robots[request.param])


@pytest.fixture
def gripper(robots):
    return Robot.from_xml(robots["gripper"])


def matrices(poses):
    """Poses (..., 7) as matrices (..., 4, 4), by scipy."""
    from scipy.spatial.transform import Rotation

    out = np.zeros((*poses.shape[:-1], 4, 4))
    rotation = Rotation.from_quat(poses[..., 3:].reshape(-1, 4)).as_matrix()
    out[..., :3, :3] = rotation.reshape(*poses.shape[:-1], 3, 3)
    out[..., :3, 3] = poses[..., :3]
    out[..., 3, 3] = 1.0
    return out


def random_states(robot, number, seed=0):
    return np.random.default_rng(seed).uniform(-4.0, 4.0, (number, len(robot.joint_names)))


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
def test_as_yourdfpy(robot, robots, count):
    import yourdfpy

    # yourdfpy does not resolve mimic joints of mimic joints: it gets all positions.
    free = re.sub("<mimic[^>]*/>", "", robots[robot.name])
    oracle = yourdfpy.URDF.load(io.StringIO(free), build_scene_graph=True)
    states = random_states(robot, count)
    found = matrices(robot.link_poses(states))
    for state, links in zip(states, found, strict=True):
        named = dict(zip(robot.joint_names, state.tolist(), strict=True))
        oracle.update_cfg(for_yourdfpy(robot, all_positions(robot, named)))
        wanted = [oracle.get_transform(link) for link in robot.link_names]
        np.testing.assert_allclose(links, wanted, rtol=0, atol=1e-9)


def test_as_yourdfpy_with_its_own_mimic_joints(robots):
    """One level, which it resolves itself."""
    import yourdfpy

    text = re.sub('<mimic joint="finger[^>]*/>', "", robots["gripper"])
    text = text.replace("1 2 -2", "1 0 0")  # it slides by other lengths, so others would follow
    robot = Robot.from_xml(text)
    oracle = yourdfpy.URDF.load(io.StringIO(text), build_scene_graph=True)
    for state in random_states(robot, 50):
        named = dict(zip(robot.joint_names, state.tolist(), strict=True))
        oracle.update_cfg(for_yourdfpy(robot, named))
        wanted = [oracle.get_transform(link) for link in robot.link_names]
        found = matrices(robot.link_poses(named))[0]
        np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-9)


def rpy_matrix(rpy):
    from scipy.spatial.transform import Rotation

    return Rotation.from_euler("xyz", rpy).as_matrix()  # lower case: fixed axes


def test_at_zero_every_link_stands_at_its_origin(robot):
    placed = dict(zip(robot.link_names, matrices(robot.link_poses({}))[0], strict=True))
    assert np.array_equal(placed[robot.root], np.eye(4))
    for joint in robot.joints.values():
        if joint.name in followers_of(robot):
            continue  # the offset of its mimic moves it
        origin = np.eye(4)
        origin[:3, :3], origin[:3, 3] = rpy_matrix(joint.origin.rpy), joint.origin.xyz
        wanted = placed[joint.parent] @ origin
        np.testing.assert_allclose(placed[joint.child], wanted, rtol=0, atol=1e-12)


def test_a_link_is_its_parent_and_its_joint(robot):
    states = random_states(robot, 20)
    poses = matrices(robot.link_poses(states))
    stamps = np.arange(20) * 1_000_000
    buffer = robot.transforms(states, stamps)
    index = {name: number for number, name in enumerate(robot.link_names)}
    for link in robot.link_names[1:]:
        parent = robot.parent_joints[link].parent
        local = buffer.lookup_transforms(parent, link, stamps, matrices=True)
        wanted = poses[:, index[parent]] @ local
        np.testing.assert_allclose(poses[:, index[link]], wanted, rtol=0, atol=1e-12)
        found = buffer.lookup_transforms(robot.root, link, stamps, matrices=True)
        np.testing.assert_allclose(poses[:, index[link]], found, rtol=0, atol=1e-12)


def test_without_stamps_all_transforms_are_static(gripper):
    buffer = gripper.transforms({"slide_joint": 0.25})
    assert buffer.time_range(gripper.root, gripper.link_names[-1]) is None
    assert {link.static for link in buffer.links()} == {True}
    assert set(buffer.frames()) == set(gripper.links)
    for link, pose in zip(
        gripper.link_names[1:], gripper.link_poses({"slide_joint": 0.25})[0, 1:], strict=True
    ):
        found = buffer.lookup_transform(gripper.root, link, None)
        assert found.translation == pytest.approx(pose[:3].tolist())


def test_stamps_move_only_the_joints_that_move(gripper):
    buffer = gripper.transforms([[0.1, 0.0]], [7])
    moving = {link.child_frame for link in buffer.links() if not link.static}
    assert moving == {joint.child for joint in gripper.joints.values() if joint.moves}
    with pytest.raises(ValueError, match="2 rows of positions need as many stamps"):
        gripper.transforms([[0.1, 0.0]] * 2)
    with pytest.raises(ValueError, match=r"expected stamps of shape \(2,\), .*; got \(3,\)"):
        gripper.transforms([[0.1, 0.0]] * 2, [1, 2, 3])


def test_a_batch_is_its_rows(robot):
    states = random_states(robot, 5)
    rows = [robot.link_poses(state)[0] for state in states]
    np.testing.assert_array_equal(robot.link_poses(states), rows)
    assert robot.link_poses(states).shape == (5, len(robot.link_names), 7)
    assert robot.link_poses(states[:0]).shape == (0, len(robot.link_names), 7)


def one_joint(kind, **attributes):
    limit = '<limit effort="1" velocity="1" lower="-1" upper="1"/>'
    axis = attributes.get("axis", "0 0 1")
    return Robot.from_xml(
        f'<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="{kind}">'
        f'<parent link="a"/><child link="b"/><axis xyz="{axis}"/>{limit}</joint></robot>'
    )


angles = st.floats(-10, 10)
axes = st.tuples(*[st.floats(-1e200, 1e200)] * 3).filter(any)


@given(angles, angles, axes)
def test_two_turns_about_one_axis_are_their_sum(first, second, axis):
    robot = one_joint("continuous", axis=" ".join(map(repr, axis)))
    turn = [matrices(robot.link_poses({"j": q}))[0, 1] for q in (first, second, first + second)]
    np.testing.assert_allclose(turn[0] @ turn[1], turn[2], rtol=0, atol=1e-9)
    np.testing.assert_allclose(turn[0][:3, :3] @ turn[0][:3, :3].T, np.eye(3), rtol=0, atol=1e-12)


@given(angles, axes)
def test_a_slide_goes_as_far_as_its_position(position, axis):
    robot = one_joint("prismatic", axis=" ".join(map(repr, axis)))
    pose = robot.link_poses({"j": position})[0, 1]
    assert np.linalg.norm(pose[:3]) == pytest.approx(abs(position), abs=1e-9)
    np.testing.assert_array_equal(pose[3:], [0, 0, 0, 1])


@given(angles)
def test_mimic_joints_follow_through_the_chain(position):
    robot = Robot.from_xml(CHAIN)
    wanted = all_positions(robot, {"a": position})
    free = Robot.from_xml(re.sub("<mimic[^>]*/>", "", CHAIN))
    np.testing.assert_allclose(
        robot.link_poses({"a": position}), free.link_poses(wanted), rtol=0, atol=1e-9
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
    assert gripper.joint_names == ("slide_joint", "nail_joint")
    assert followers_of(gripper) == {
        "finger_a_joint": Follower("slide_joint", -3.0, 0.625),
        "finger_b_joint": Follower("slide_joint", 1.5, -0.25),
        "tip_a_joint": Follower("slide_joint", -1.5, 0.3125),
        "tip_b_joint": Follower("slide_joint", 1.5, -0.25),
    }


def test_a_joint_that_follows_no_joint_is_free():
    robot = Robot.from_xml(CHAIN.replace('joint="a"', 'joint="ghost"'))
    assert robot.joint_names == ("b", "a")


def test_joints_that_follow_each_other_are_refused():
    text = CHAIN.replace('<robot name="chain">', '<robot name="chain">\n')
    loop = Robot.from_xml(text.replace('joint="a"', 'joint="c"'))
    with pytest.raises(UrdfError, match="in a loop: c -> b -> c") as caught:
        followers_of(loop)
    assert caught.value.line == 2


@pytest.mark.slow
def test_ten_thousand_joints_that_follow_each_other():
    links = "".join(
        chain_link(f"j{number}", f'<mimic joint="j{number - 1}" offset="1"/>')
        for number in range(9999, 0, -1)
    )
    robot = Robot.from_xml(
        f'<robot name="r"><link name="base"/>{links}{chain_link("j0", "")}</robot>'
    )
    assert followers_of(robot)["j9999"] == Follower("j0", 1.0, 9999.0)


def test_ten_thousand_links_in_a_row():
    links = "".join(f'<link name="l{number}"/>' for number in range(10_000))
    joints = "".join(
        f'<joint name="j{number}" type="fixed"><parent link="l{number}"/>'
        f'<child link="l{number + 1}"/><origin xyz="1 0 0"/></joint>'
        for number in range(9999)
    )
    poses = Robot.from_xml(f'<robot name="r">{links}{joints}</robot>').link_poses([[]])
    assert poses[0, -1, 0] == 9999.0


def test_limits(robot):
    states = random_states(robot, 100)
    clipped = robot.clip(states)
    assert robot.within_limits(clipped).all()
    inside = robot.within_limits(states)
    np.testing.assert_array_equal(clipped[inside], states[inside])
    for column, name in enumerate(robot.joint_names):
        endless = robot.joints[name].type == "continuous"
        wanted = (-np.inf, np.inf) if endless else (-2.0, 1.5)
        assert (robot.lower[column], robot.upper[column]) == wanted
    nan = np.full(len(robot.joint_names), np.nan)
    assert not robot.within_limits(nan).any()


def test_states_by_name(gripper):
    by_name = {"nail_joint": [0.1, 0.2, 0.3], "slide_joint": 1.0}
    np.testing.assert_array_equal(
        gripper.clip(by_name), gripper.clip([[1.0, 0.1], [1.0, 0.2], [1.0, 0.3]])
    )
    with pytest.raises(KeyError, match="follows 'slide_joint'"):
        gripper.link_poses({"tip_a_joint": 1.0})
    with pytest.raises(KeyError, match="Did you mean: slide_joint"):
        gripper.link_poses({"slide_joit": 1.0})
    with pytest.raises(ValueError, match=r"shape \(N, 2\)"):
        gripper.link_poses([[1.0]])


def test_floating_and_planar_joints_stay_at_their_origin():
    for kind in ("floating", "planar"):
        robot = one_joint(kind)
        assert robot.joint_names == ()
        np.testing.assert_array_equal(robot.link_poses({})[0, 1], [0, 0, 0, 0, 0, 0, 1])


TWO_JOINTS = """<robot name="arm"><link name="base"/><link name="hand"/><link name="tip"/>
  <joint name="elbow" type="continuous"><parent link="base"/><child link="hand"/></joint>
  <joint name="wrist" type="continuous"><parent link="hand"/><child link="tip"/></joint></robot>"""


@pytest.mark.parametrize(
    ("positions", "error", "text"),
    [
        (
            {"elbow": [1, 2, 3], "wrist": [1, 2]},
            ValueError,
            "all joints need the same number of positions, or one: 'elbow' has 3, 'wrist' has 2",
        ),
        (
            {"elbow": np.zeros((2, 3)), "wrist": 0.0},
            ValueError,
            (
                "the positions of the joint 'elbow' must be a number or have the shape (N,), not "
                "(2, 3)"
            ),
        ),
        (
            {"wrist": "x"},
            TypeError,
            "positions of the joint 'wrist' must be an array of numbers, not text",
        ),
        (
            {"wrist": None},
            TypeError,
            "positions of the joint 'wrist' must be an array of numbers, not NoneType",
        ),
        (
            [1, 2, 3],
            ValueError,
            (
                "positions must be a dict by name of the joint, or have the shape (N, 2), with a "
                "column for each of the joints elbow, wrist, not (3,)"
            ),
        ),
        *(
            (
                wrong,
                TypeError,
                (
                    "positions must be a dict by name of the joint, or have the shape (N, 2), with "
                    f"a column for each of the joints elbow, wrist, not {type(wrong).__name__}"
                ),
            )
            for wrong in ("elbow", None)
        ),
        (
            SimpleNamespace(name=["elbow"], position=[1.0]),  # as a JointState
            TypeError,
            (
                "positions must be a dict by name of the joint, or have the shape (N, 2), with a "
                "column for each of the joints elbow, wrist, not SimpleNamespace; write "
                "dict(zip(message.name, message.position))"
            ),
        ),
        (
            5,
            ValueError,
            (
                "positions must be a dict by name of the joint, or have the shape (N, 2), with a "
                "column for each of the joints elbow, wrist, not a number"
            ),
        ),
        ({"elbw": 1}, KeyError, "the robot 'arm' has no free joint 'elbw'. Did you mean: elbow"),
        ({5: 1}, KeyError, "the robot 'arm' has no free joint 5. It has elbow, wrist"),
    ],
)
def test_positions_that_do_not_fit(positions, error, text):
    robot = Robot.from_xml(TWO_JOINTS)
    for ask in (robot.link_poses, robot.transforms, robot.clip):
        with pytest.raises(error) as caught:
            ask(positions)
        assert caught.value.args == (text,)


def test_one_position_for_many_of_another_joint():
    robot = Robot.from_xml(TWO_JOINTS)
    states = robot.clip({"elbow": [1, 2, 3], "wrist": [5]})
    assert states.tolist() == [[1, 5], [2, 5], [3, 5]]
    assert robot.clip({"elbow": np.float32(1.5)}).tolist() == [[1.5, 0]]
    assert robot.clip({"elbow": []}).shape == (0, 2)
    assert robot.clip({}).tolist() == [[0, 0]]


def test_a_path_is_no_description():
    with pytest.raises(UrdfError) as caught:
        Robot.from_xml("arm.urdf")
    assert caught.value.hint == "This text is not XML. To read a file, call Robot.load."


def test_xml_is_no_path():
    for xml in (TWO_JOINTS, f"\n {TWO_JOINTS}", TWO_JOINTS.encode()):
        with pytest.raises(ValueError, match=r"for XML, call Robot\.from_xml"):
            Robot.load(xml)
        with pytest.raises(
            TypeError, match=r"call Robot\.from_xml\(text\) for XML, or Robot\.load"
        ):
            Robot(xml)
    with pytest.raises(TypeError, match=r"path must be a str or pathlib.Path, not int$"):
        Robot.load(3)
    robot = Robot.from_xml(TWO_JOINTS)
    assert pickle.loads(pickle.dumps(robot)) == robot
