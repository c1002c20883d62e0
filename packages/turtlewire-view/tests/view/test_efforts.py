"""Efforts of joint states: shares, colours, and messages that cannot be drawn.

Efforts in a real browser: rings and arrows at the joints' frames.
"""

import math

import pytest

from turtlewire_view.displays.content import Content, Removal
from turtlewire_view.displays.effort import EffortDisplay

from .looking_down import get

JointState, String = get("sensor_msgs/msg/JointState"), get("std_msgs/msg/String")
STATES, ROBOT = "/joint_states", "/robot_description"
URDF = """<robot name="r">
  <link name="base"/><link name="arm"/><link name="wheel"/><link name="rail"/><link name="tip"/>
  <joint name="elbow" type="revolute"><parent link="base"/><child link="arm"/>
    <axis xyz="0 0 2"/><limit lower="-1" upper="1" effort="10" velocity="1"/></joint>
  <joint name="roll" type="continuous"><parent link="base"/><child link="wheel"/></joint>
  <joint name="slide" type="prismatic"><parent link="base"/><child link="rail"/>
    <axis xyz="0 1 0"/><limit lower="0" upper="1" effort="100" velocity="1"/></joint>
  <joint name="glue" type="fixed"><parent link="base"/><child link="tip"/></joint>
</robot>"""


def states(**efforts):
    names, values = list(efforts), [float(each) for each in efforts.values()]
    return JointState(name=names, effort=values, position=[0.0] * len(names))


def make(urdf=URDF, **options):
    display = EffortDisplay(options)
    display.topic = STATES
    if urdf:
        display.take(ROBOT, String(data=urdf))
    return display


def joints_of(outputs):
    (content,) = [each for each in outputs if isinstance(each, Content)]
    return {each["name"]: each for each in content.header["joints"]}


def test_efforts_are_shares_of_the_greatest_ones():
    display = make()
    assert display.topics("sensor_msgs/msg/JointState") == {
        ROBOT: "std_msgs/msg/String", STATES: "sensor_msgs/msg/JointState"
    }  # fmt: skip
    outputs = display.take(STATES, states(elbow=-5, roll=4, slide=500, glue=1, other=1))
    joints = joints_of(outputs)
    assert joints["elbow"] == {
        "name": "elbow", "frame": "arm", "axis": [0, 0, 1], "shape": "ring", "share": -0.5,
        "color": [0, 255, 128, 255],
    }  # fmt: skip
    assert joints["roll"]["share"] == pytest.approx(0.2)  # without a limit
    assert (joints["slide"]["share"], joints["slide"]["shape"]) == (1, "arrow")
    assert joints["slide"]["color"] == [255, 0, 0, 255]
    assert set(joints) == {"elbow", "roll", "slide"}
    assert outputs[-1].text == ""


def test_a_greatest_effort_of_ones_own_and_a_prefix():
    display = make(joints={"elbow": {"max": 20}, "roll": {"max": 0}}, tf_prefix="left/")
    joints = joints_of(display.take(STATES, states(elbow=5, roll=1)))
    assert (joints["elbow"]["share"], joints["elbow"]["frame"]) == (0.25, "left/arm")
    assert joints["roll"]["share"] == pytest.approx(0.05)


def test_old_efforts_go_beyond_the_history():
    display = make(history_length=2)
    sent = [display.take(STATES, states(elbow=1)) for _ in range(3)]
    gone = [[each.part for each in outputs if isinstance(each, Removal)] for outputs in sent]
    assert gone == [[], [], ["0"]]
    assert [each.part for each in display.start()] == ["1", "2"]


@pytest.mark.parametrize(
    ("urdf", "message", "line"),
    [
        ("", states(elbow=1), f"No robot description received on [{ROBOT}]"),
        ("<robot", states(elbow=1), "the description is invalid: "),
        (URDF, JointState(name=["elbow"]), "the joint states have 1 name and 0 efforts"),
        (URDF, states(knee=1), "the message has no joint of the robot; its first is 'knee'"),
        (URDF, states(elbow=math.nan, roll=1), "joint 'elbow': the effort nan or the axis cannot"),
        (URDF, states(roll=math.inf), "joint 'roll': the effort inf or the axis cannot"),
    ],
)
def test_a_wrong_robot_or_message_is_named(urdf, message, line):
    outputs = make(urdf).take(STATES, message)
    assert outputs[-1].text.startswith(line)


def test_a_wrong_description_is_named_at_once_and_replaced():
    display = make("")
    (status,) = display.take(ROBOT, String(data="<robot"))
    assert status.level == "error"
    (status,) = display.take(ROBOT, String(data=URDF))
    assert (status.level, status.text) == ("ok", "")
    assert joints_of(display.take(STATES, states(elbow=10)))["elbow"]["share"] == 1


@pytest.mark.parametrize("joints", [{"a": {"max": -1}}, {"a": {"max": "x"}}, {"a": {"top": 1}}])
def test_wrong_choices_of_joints_are_refused(joints):
    with pytest.raises(ValueError, match="option 'joints' of a"):
        EffortDisplay({"joints": joints})


PICTURED = """<robot name="r"><link name="map"/><link name="base"/><link name="tip"/>
  <joint name="turn" type="revolute"><parent link="map"/><child link="base"/>
    <axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="10" velocity="1"/></joint>
  <joint name="push" type="prismatic"><parent link="base"/><child link="tip"/>
    <axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="10" velocity="1"/></joint>
</robot>"""


def pictured_states(**efforts):
    names, values = list(efforts), [float(each) for each in efforts.values()]
    return get("sensor_msgs/msg/JointState")(name=names, effort=values)


@pytest.fixture
def show(scene):
    """Show efforts of the robot, whose greatest effort is a ring of 1.05 m."""
    scene.source.offer(f"{scene.topic}_robot", get("std_msgs/msg/String")(data=PICTURED))

    def show(message, **options):
        options = {"scale": 2, "width": 0.2, **options}
        scene.show("effort", message, description_topic=f"{scene.topic}_robot", **options)
        return scene

    return show


@pytest.mark.slow
def test_a_torque_is_a_ring_and_a_force_an_arrow(show):
    scene = show(pictured_states(turn=10))
    scene.expect_red((2.05, 0, 0), (1, 1.05, 0), (-0.05, 0, 0))
    scene.expect_ground((1, 0, 0), (2.3, 0, 0))
    scene.send(pictured_states(push=-10))
    scene.expect_red((1, 0.5, 0), (1, 0.9, 0))
    scene.expect_ground((2.05, 0, 0), (1, 1.2, 0))
    scene.set_option("scale", 0)
    scene.expect_ground((1, 0.5, 0))


def test_a_joint_is_hidden_or_has_another_greatest_effort(show):
    scene = show(pictured_states(turn=10))
    scene.expect_red((2.05, 0, 0))
    scene.set_option("joints", {"turn": {"max": 100}})
    scene.expect_ground((2.05, 0, 0))
    scene.set_option("joints", {"turn": {"shown": False}})
    scene.expect_ground((2.05, 0, 0))
    scene.set_option("joints", {})
    scene.expect_red((2.05, 0, 0))
    scene.page.click("#display-list summary")
    box = scene.page.get_by_label("Greatest effort of turn")
    box.fill("100")
    box.press("Enter")
    scene.expect_ground((2.05, 0, 0))


def test_efforts_follow_their_joints_and_earlier_ones_stay(show):
    scene = show(pictured_states(turn=10), history_length=2)
    scene.expect_red((2.05, 0, 0))
    scene.send(pictured_states(turn=5))
    scene.wait_until(
        "async () => (await import('./js/main.js')).displays.list[0].partNames.size > 1"
    )
    scene.source.put_frame("map", "base", (-2, 0, 0))
    scene.expect_red((2.05, 0, 0))  # the earlier one
    scene.expect_ground((1.55, 0, 0))
    scene.source.put_frame("map", "base", (1, 0, 0))


def test_a_robot_without_transforms_is_named(show):
    scene = show(pictured_states(turn=10), tf_prefix="nowhere")
    scene.expect_status("No transform from [nowhere/base]")
