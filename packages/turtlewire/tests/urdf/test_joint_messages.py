"""JointStates to TFMessages, natively and in plain Python."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.needs import COMPILED_CORE

from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage
from turtlewire.errors import CdrError
from turtlewire.msg.cdr import deserialize, serialize
from turtlewire.urdf import Robot, joint_messages
from turtlewire.urdf.joint_messages import JointMessages, stamp_of

ROBOT = Robot.from_xml(
    '<robot name="r"><link name="base"/>'
    + "".join(
        f'<link name="{name}_link"/><joint name="{name}" type="{kind}"><parent link="base"/>'
        f'<child link="{name}_link"/><origin xyz="1 2 {number}" rpy="0.1 {number} 3"/>'
        f'<axis xyz="1 -{number} 0.5"/><limit effort="1" velocity="1"/>{mimic}</joint>'
        for number, (name, kind, mimic) in enumerate(
            [
                ("turn", "revolute", ""),
                ("slide", "prismatic", ""),
                ("endless", "continuous", ""),
                ("after", "revolute", '<mimic joint="before" multiplier="3" offset="1"/>'),
                ("before", "prismatic", '<mimic joint="turn" multiplier="-2" offset="0.5"/>'),
                ("ghost", "revolute", '<mimic joint="nowhere" multiplier="4"/>'),
                ("still", "fixed", ""),
                ("float", "floating", ""),
                ("loop_a", "revolute", '<mimic joint="loop_b"/>'),
                ("loop_b", "revolute", '<mimic joint="loop_a" offset="1"/>'),
            ]
        )
    )
    + "</robot>"
)


@pytest.fixture(params=["native", "python"], autouse=True)
def core(request, monkeypatch):
    """Each test runs with both."""
    if request.param == "python":
        monkeypatch.setattr(joint_messages, "_native_frames", lambda: None)
    elif joint_messages._native_frames() is None:
        pytest.skip(COMPILED_CORE)


def joint_state(positions, frame_id="", sec=5, nanosec=6):
    message = JointState(name=list(positions), position=list(positions.values()))
    message.header.frame_id = frame_id
    message.header.stamp.sec, message.header.stamp.nanosec = sec, nanosec
    return message


def answer(message, messages=None):
    cdr = serialize(message)
    messages = messages or JointMessages(ROBOT, "r1/")
    found = deserialize(TFMessage, messages.layout_of(cdr).transforms(cdr))
    for transform in found.transforms:
        assert transform.header.stamp == message.header.stamp
        assert transform.header.frame_id == "r1/base"
    return {each.child_frame_id: pose(each.transform) for each in found.transforms}


def pose(transform):
    t, q = transform.translation, transform.rotation
    return [t.x, t.y, t.z, q.x, q.y, q.z, q.w]


def pose_at(name, position):
    """Return the pose of a single joint, computed by the batch."""
    joint = ROBOT.joints[name]
    alone = Robot.from_xml(
        f'<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="{joint.type}">'
        f'<parent link="a"/><child link="b"/><origin xyz="{text(joint.origin.xyz)}"'
        f' rpy="{text(joint.origin.rpy)}"/><axis xyz="{text(joint.axis)}"/>'
        '<limit effort="1" velocity="1"/></joint></robot>'
    )
    return alone.link_poses({"j": position})[0, 1]


def text(numbers):
    return " ".join(map(repr, numbers))


def test_joints_in_the_order_of_their_names():
    found = answer(joint_state({"turn": 0.5, "slide": -1.0, "endless": 9.0}))
    order = ["after", "before", "endless", "slide", "turn"]
    assert list(found) == [f"r1/{name}_link" for name in order]
    wanted = {"turn": 0.5, "slide": -1.0, "endless": 9.0, "before": -0.5, "after": -0.5}
    for name in order:
        np.testing.assert_allclose(
            found[f"r1/{name}_link"], pose_at(name, wanted[name]), rtol=0, atol=1e-12
        )


@pytest.mark.parametrize(
    ("positions", "moved"),
    [
        ({"unknown": 1.0}, []),
        ({}, []),
        ({"before": 1.0}, ["after", "before"]),
        ({"after": 1.0}, ["after"]),
        ({"nowhere": 1.0}, ["ghost"]),  # the message knows a joint that the robot lacks
        ({"still": 1.0, "float": 1.0}, []),
        ({"loop_a": 1.0}, ["loop_a", "loop_b"]),
    ],
)
def test_which_joints_a_message_moves(positions, moved):
    assert list(answer(joint_state(positions))) == [f"r1/{name}_link" for name in moved]


def test_a_mimic_joint_that_is_named_does_not_follow():
    found = answer(joint_state({"turn": 1.0, "before": 0.25}))
    np.testing.assert_allclose(found["r1/before_link"], pose_at("before", 0.25), rtol=0, atol=1e-12)
    np.testing.assert_allclose(found["r1/after_link"], pose_at("after", 1.75), rtol=0, atol=1e-12)


def test_of_equal_names_the_first_one_counts():
    message = JointState(name=["slide", "slide"], position=[1.0, 2.0])
    found = answer(message)["r1/slide_link"]
    np.testing.assert_allclose(found, pose_at("slide", 1.0), rtol=0, atol=1e-12)


@given(
    st.dictionaries(st.sampled_from(["turn", "slide", "endless"]), st.floats(-9, 9), min_size=1),
    st.text(max_size=9).filter(lambda word: "\0" not in word),
    st.integers(-(2**31), 2**31 - 1),
    st.integers(0, 2**32 - 1),
)
def test_any_frame_id_stamp_and_position(positions, frame_id, sec, nanosec):
    message = joint_state(positions, frame_id, sec, nanosec)
    assert stamp_of(serialize(message)) == sec * 10**9 + nanosec
    found = answer(message)
    for name, position in positions.items():
        np.testing.assert_allclose(
            found[f"r1/{name}_link"], pose_at(name, position), rtol=0, atol=1e-12
        )


def test_layouts_are_kept_and_found_again():
    messages = JointMessages(ROBOT, "r1/")
    first = serialize(joint_state({"turn": 1.0}))
    layout = messages.layout_of(first)
    for number in range(200):
        messages.layout_of(serialize(joint_state({"turn": 1.0, f"new_{number}": 2.0})))
        assert messages.layout_of(serialize(joint_state({"turn": float(number)}))) is layout


def test_velocities_do_not_matter():
    message = joint_state({"turn": 1.0})
    message.velocity, message.effort = [3.0], [4.0]
    assert answer(message) == answer(joint_state({"turn": 1.0}))


def test_numbers_of_names_and_positions_may_differ():
    messages = JointMessages(ROBOT)
    layout = messages.layout_of(serialize(JointState(name=["turn", "slide"], position=[1.0])))
    assert (len(layout.names), layout.number_of_positions, layout.joints) == (2, 1, ())


GOOD = serialize(joint_state({"turn": 1.0, "slide": 2.0}, "frame"))


def test_bytes_that_end_too_early_are_refused():
    messages = JointMessages(ROBOT)
    positions_end = messages.layout_of(GOOD)._end
    for end in range(positions_end):
        with pytest.raises(CdrError, match="malformed"):
            JointMessages(ROBOT).layout_of(GOOD[:end])
        with pytest.raises(CdrError, match="malformed"):
            messages.layout_of(GOOD[:end])


@given(st.data())
def test_damaged_bytes_are_refused_or_read(data):
    damaged = bytearray(GOOD)
    for at in data.draw(st.lists(st.integers(0, len(GOOD) - 1), min_size=1, max_size=4)):
        damaged[at] = data.draw(st.integers(0, 255))
    try:
        layout = JointMessages(ROBOT).layout_of(bytes(damaged))
    except CdrError:
        return
    if len(layout.names) == layout.number_of_positions:
        deserialize(TFMessage, layout.transforms(bytes(damaged)))


@pytest.mark.parametrize("position", [1e308, float("inf"), float("-inf"), float("nan")])
def test_positions_that_are_no_place_are_passed_on_without_a_warning(position):
    found = answer(joint_state({"endless": position, "slide": position}))
    assert set(found) == {"r1/endless_link", "r1/slide_link"}
    assert not np.isfinite(found["r1/slide_link"]).all() or position == 1e308


def test_a_huge_number_of_names_is_refused():
    at = GOOD.index(b"\x05\x00\x00\x00turn\0") - 4
    with pytest.raises(CdrError, match="within its names"):
        JointMessages(ROBOT).layout_of(GOOD[:at] + b"\xff\xff\xff\xff" + GOOD[at + 4 :])


@pytest.mark.parametrize("core", ["native"], indirect=True)
def test_constants_that_change_while_they_are_read():
    class Vanishing:
        def __float__(self):
            constants.clear()
            return 1.0

    constants = [Vanishing(), *(object() for _ in range(14))]
    with pytest.raises(TypeError):
        joint_messages._native_frames()(bytes(100), [4], [20], constants, [0], [1.0], [0.0])
