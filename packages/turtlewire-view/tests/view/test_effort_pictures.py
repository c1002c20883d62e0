"""Efforts in a real browser: rings and arrows at the joints' frames."""

# ruff: noqa: F811 - fixtures are imported
from __future__ import annotations

import pytest

from .looking_down import get, scene, shown_page  # noqa: F401 - fixtures

URDF = """<robot name="r"><link name="map"/><link name="base"/><link name="tip"/>
  <joint name="turn" type="revolute"><parent link="map"/><child link="base"/>
    <axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="10" velocity="1"/></joint>
  <joint name="push" type="prismatic"><parent link="base"/><child link="tip"/>
    <axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="10" velocity="1"/></joint>
</robot>"""


def states(**efforts):
    names, values = list(efforts), [float(each) for each in efforts.values()]
    return get("sensor_msgs/msg/JointState")(name=names, effort=values)


@pytest.fixture
def show(scene):
    """Show efforts of the robot, whose greatest effort is a ring of 1.05 m."""
    scene.source.offer(f"{scene.topic}_robot", get("std_msgs/msg/String")(data=URDF))

    def show(message, **options):
        options = {"scale": 2, "width": 0.2, **options}
        scene.show("effort", message, description_topic=f"{scene.topic}_robot", **options)
        return scene

    return show


def test_a_torque_is_a_ring_and_a_force_an_arrow(show):
    scene = show(states(turn=10))
    scene.expect_red((2.05, 0, 0), (1, 1.05, 0), (-0.05, 0, 0))
    scene.expect_ground((1, 0, 0), (2.3, 0, 0))
    scene.send(states(push=-10))
    scene.expect_red((1, 0.5, 0), (1, 0.9, 0))
    scene.expect_ground((2.05, 0, 0), (1, 1.2, 0))
    scene.set_option("scale", 0)
    scene.expect_ground((1, 0.5, 0))


def test_a_joint_is_hidden_or_has_another_greatest_effort(show):
    scene = show(states(turn=10))
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
    scene = show(states(turn=10), history_length=2)
    scene.expect_red((2.05, 0, 0))
    scene.send(states(turn=5))
    scene.wait_until(
        "async () => (await import('./js/main.js')).displays.list[0].partNames.size > 1"
    )
    scene.source.put_frame("map", "base", (-2, 0, 0))
    scene.expect_red((2.05, 0, 0))  # the earlier one
    scene.expect_ground((1.55, 0, 0))
    scene.source.put_frame("map", "base", (1, 0, 0))


def test_a_robot_without_transforms_is_named(show):
    scene = show(states(turn=10), tf_prefix="nowhere")
    scene.expect_status("No transform from [nowhere/base]")
