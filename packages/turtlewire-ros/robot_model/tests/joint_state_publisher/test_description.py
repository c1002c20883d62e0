"""Which joints a description has, with which limits and start values."""

from __future__ import annotations

import math

import pytest

from joint_state_publisher.description import DescriptionError, JointOptions, read_joints
from joint_state_publisher.joints import MimicRule
from turtlewire.urdf.faults import XACRO_LEFT

LIMIT = '<limit lower="-1" upper="2" effort="1" velocity="3"/>'


def read(*joints: str, warnings: list[str] | None = None, **options):
    told = [] if warnings is None else warnings
    text = f"<robot name='r'><link name='a'/>{''.join(joints)}</robot>"
    return read_joints(text, JointOptions(**{"zeros": {}, "mimics": {}, **options}), told.append)


def robot(content: str) -> str:
    return f"<robot>{content}</robot>"


def joint(name: str, kind: str, inside: str = LIMIT) -> str:
    return f"<joint name='{name}' type='{kind}'>{inside}</joint>"


def test_joints_that_do_not_move_are_left_out_and_the_order_is_the_files():
    joints = read(
        joint("z", "revolute"),
        joint("f", "fixed"),
        joint("l", "floating"),
        joint("p", "planar"),
        joint("b", "continuous", ""),
        joint("a", "prismatic"),
    )
    assert joints.order == ["z", "b", "a"]
    assert joints.robot == "r"
    assert (joints.free["b"].minimum, joints.free["b"].maximum) == (-math.pi, math.pi)
    assert joints.free["z"].max_velocity == 3.0


def test_elements_of_xacro_and_limits_the_wrong_way_round_are_warnings():
    warnings: list[str] = []
    text = (
        "<robot name='r' xmlns:xacro='http://www.ros.org/wiki/xacro'><link name='a'/>"
        "<xacro:macro name='leg'/><xacro:leg/>"
        + joint("j", "revolute", '<limit lower="2" upper="1"/>')
        + "</robot>"
    )
    read_joints(text, JointOptions({}, {}), warnings.append)
    assert warnings == [
        XACRO_LEFT,
        "Joint 'j' cannot move: its lower limit, 2, is above its upper limit, 1.",
    ]


def test_start_values():
    high = '<limit lower="1" upper="2"/>'
    joints = read(
        joint("zero", "revolute"),
        joint("middle", "revolute", high),
        joint("told", "revolute"),
        zeros={"told": 0.5},
    )
    assert [joint.position for joint in joints.free.values()] == [0.0, 1.5, 0.5]


@pytest.mark.parametrize(("uses", "limits"), [(True, (-0.5, 2.0)), (False, (-1.0, 2.0))])
def test_soft_limits_narrow_the_limits(uses, limits):
    soft = LIMIT + '<safety_controller soft_lower_limit="-0.5" soft_upper_limit="5"/>'
    free = read(joint("a", "revolute", soft), use_smallest_limits=uses).free["a"]
    assert (free.minimum, free.maximum) == limits


def test_mimics():
    mimic = LIMIT + '<mimic joint="b" multiplier="-2" offset="0.5"/>'
    described = [joint("a", "revolute", mimic), joint("b", "revolute"), joint("c", "revolute")]
    by_parameter = {"c": MimicRule("b", 3.0)}
    joints = read(*described, mimics=by_parameter)
    assert joints.mimics == {"a": MimicRule("b", -2.0, 0.5), "c": MimicRule("b", 3.0, 0.0)}
    assert joints.kinds == {"a": "revolute", "b": "revolute", "c": "revolute"}
    assert read(*described, use_mimic_tags=False).mimics == {}


def test_a_mimic_of_an_unknown_joint_moves_freely_with_a_warning():
    warnings: list[str] = []
    joints = read(joint("a", "revolute", LIMIT + '<mimic joint="gone"/>'), warnings=warnings)
    assert joints.state().positions == [0.0]
    assert warnings == [
        "Joint 'a' mimics 'gone', which is not a joint that moves: 'a' is treated as a free joint."
    ]


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("<joints/>", 'URDF must have a "robot" tag'),
        ("<COLLADA/>", 'URDF must have a "robot" tag'),
        ("<robot>", "not well-formed XML"),
        ("", "not well-formed XML"),
        ("<!DOCTYPE r [<!ENTITY a 'aa'>]><robot>&a;</robot>", "not well-formed XML"),
        (
            robot(joint("x", "revolute", "")),
            'Limits must be specified for joint "x" of type "revolute"',
        ),
        (
            robot(joint("x", "prismatic", '<limit upper="1"/>')),
            '"lower" limit must be specified for joint "x" of type "prismatic"',
        ),
        (
            robot(joint("x", "revolute", '<limit lower="0" upper="one"/>')),
            '"upper" limit must be a float for joint "x" of type "revolute"',
        ),
        (
            robot(joint("x", "revolute", '<limit lower="nan" upper="1"/>')),
            '"lower" limit must be a float',
        ),
    ],
)
def test_errors(text, error):
    with pytest.raises(DescriptionError, match=error):
        read_joints(text, JointOptions({}, {}), print)


def test_sdf():
    text = """<sdf version="1.9"><model name="m">
      <joint name="a" type="revolute">
        <axis><limit><lower>-1</lower><upper>1</upper></limit></axis></joint>
      <joint name="b" type="ball"/><joint name="c" type="continuous"/>
    </model></sdf>"""
    joints = read_joints(text, JointOptions({}, {}), print)
    assert joints.order == ["a", "c"]
    assert joints.free["a"].minimum == -1.0
