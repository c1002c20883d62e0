"""Joints and their values, without ROS."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from joint_state_publisher.joints import FreeJoint, JointSet, MimicLoopError, MimicRule

NUMBERS = st.floats(-100, 100)
FACTORS = st.floats(-4, 4)


def chain(*mimics: tuple[float, float], position: float = 0.0) -> JointSet:
    """A free joint `j0`, and joints each of which follows the one before."""
    joints = JointSet(order=[f"j{k}" for k in range(len(mimics) + 1)])
    joints.free["j0"] = FreeJoint("j0", "revolute", -200, 200, 0, position=position)
    for k, (factor, offset) in enumerate(mimics):
        joints.mimics[f"j{k + 1}"] = MimicRule(f"j{k}", factor, offset)
    return joints


@given(NUMBERS, st.lists(st.tuples(FACTORS, NUMBERS), max_size=4))
def test_a_chain_of_mimics_is_one_formula_after_the_other(position, mimics):
    expected = [position]
    for factor, offset in mimics:
        expected.append(expected[-1] * factor + offset)
    assert chain(*mimics, position=position).state().positions == pytest.approx(expected)


def test_a_circle_of_mimics_is_named():
    joints = chain((1, 0), (1, 0))
    joints.mimics["j0"] = MimicRule("j2")
    del joints.free["j0"]
    with pytest.raises(
        MimicLoopError, match=r"infinite recursive mimic chain: \['j0', 'j2', 'j1', 'j0'\]"
    ):
        joints.state()


@given(st.floats(0.01, 5), st.integers(1, 200))
def test_sweeps_stay_within_the_limits(step, count):
    joint = FreeJoint("j", "revolute", -1.5, 0.5, 0.0, position=0.0)
    for _ in range(count):
        joint.sweep(step)
        assert -1.5 <= joint.position <= 0.5


def test_a_sweep_turns_at_the_limits_and_a_continuous_joint_begins_anew():
    sweeping = FreeJoint("a", "revolute", -1, 1, 0, position=0.8)
    turning = FreeJoint("b", "continuous", -math.pi, math.pi, 0, position=3.0)
    joints = JointSet(order=["a", "b"], free={"a": sweeping, "b": turning})
    seen = []
    for _ in range(3):
        joints.sweep(0.5)
        seen.append(joints.state().positions)
    assert seen == [
        pytest.approx([1.0, -math.pi]),
        pytest.approx([0.5, -math.pi + 0.5]),
        pytest.approx([0.0, -math.pi + 1.0]),
    ]


def test_a_source_gives_what_it_has():
    joints = chain((-0.5, 0.25))
    joints.take(["nobody", "j0", "j1"], [9.0, 2.0, 7.0], [], [1.0, 3.0, 5.0])
    state = joints.state()
    assert state.positions == [2.0, -0.75]  # a mimic joint is not taken over
    assert state.efforts == [3.0, 3.0]
    assert state.velocities == []
    with pytest.raises(ValueError, match="2 names but 1 values of position"):
        joints.take(["j0", "j1"], [1.0], [], [])


@pytest.mark.parametrize(
    ("kind", "visited"),
    [
        # A step onto a limit is not a step over it: the joint turns with the next one.
        ("revolute", [0.5, 1.0, 1.0, 0.5, 0.0, -0.5, -1.0, -1.0, -0.5]),
        ("continuous", [0.5, 1.0, -1.0, -0.5, 0.0, 0.5, 1.0, -1.0, -0.5]),
    ],
)
def test_a_sweep_reaches_both_limits(kind, visited):
    joint = FreeJoint("j", kind, -1.0, 1.0, 0.0, position=0.0)
    found = []
    for _ in visited:
        joint.sweep(0.5)
        found.append(joint.position)
    assert found == visited
