"""From Kilted on, turtlesim's interfaces are those of `turtlesim_msgs`, with their own names on the
wire.
"""

import os

import pytest
from tests.programs import run_python

from turtlewire import msg
from turtlewire.msg.registry import interface_text

LOOK = """
import rclpy, turtlesim.msg, turtlesim.srv, turtlesim.action
from turtlewire.msg import type_name
from turtlesim.msg import Pose
from turtlesim.turtlesim_node import TurtlesimNode
from turtlesim.missing_turtles import find_missing

rclpy.init(args=[])
node = TurtlesimNode(headless=True)
user = rclpy.create_node("user")
user.create_subscription(Pose, "/turtle7/pose", print, 1)
names = dict(user.get_topic_names_and_types()) | dict(user.get_service_names_and_types())
print(names["/turtle1/pose"], names["/turtle1/color_sensor"], names["/spawn"],
      names["/turtle1/rotate_absolute/_action/feedback"])
print(type_name(Pose), type_name(turtlesim.srv.Spawn), type_name(turtlesim.action.RotateAbsolute))
print(find_missing(node.context.wire.graph.endpoints(), "/", ["turtle1"]),
      node._missing.hint("turtle7").partition("/spawn ")[2].split()[0])
"""


@pytest.mark.parametrize(
    ("distro", "package"),
    [
        (None, "turtlesim"),
        ("humble", "turtlesim"),
        ("kilted", "turtlesim_msgs"),
        ("rolling", "turtlesim_msgs"),
    ],
)
def test_types_are_those_of_the_distribution(distro, package):
    environment = {name: value for name, value in os.environ.items() if name != "ROS_DISTRO"}
    environment |= {"RMW_IMPLEMENTATION": "local"} | ({"ROS_DISTRO": distro} if distro else {})
    done = run_python(LOOK, check=False, env=environment)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines() == [
        (
            f"['{package}/msg/Pose'] ['{package}/msg/Color'] ['{package}/srv/Spawn'] "
            f"['{package}/action/RotateAbsolute_FeedbackMessage']"
        ),
        f"{package}/msg/Pose {package}/srv/Spawn {package}/action/RotateAbsolute",
        f"('turtle7',) {package}/srv/Spawn",
    ]


def test_both_packages_hold_the_same_but_for_the_name():
    """The hash of a type covers its name, so that a peer of the other distribution is never taken
    for one of ours.
    """
    for kind, found in msg.interfaces()["turtlesim"].items():
        for name in found:
            old, new = (
                interface_text(f"{package}/{kind}/{name}")
                for package in ("turtlesim", "turtlesim_msgs")
            )
            assert old == new
            assert msg.type_hash(f"turtlesim/{kind}/{name}") != msg.type_hash(
                f"turtlesim_msgs/{kind}/{name}"
            )


LISTEN = """
import rclpy
from turtlesim.msg import Pose as Theirs
from turtlesim_msgs.msg import Pose

rclpy.init(args=[])
node = rclpy.create_node("node")
node.create_publisher(Theirs, "/turtle1/pose", 1)
node.create_subscription(Pose, "/turtle1/pose", print, 1)
"""


@pytest.mark.parametrize("distro", ["jazzy", "lyrical"])
def test_a_listener_of_another_distribution_is_told_the_remedy(distro):
    done = run_python(
        LISTEN, env=os.environ | {"RMW_IMPLEMENTATION": "local", "ROS_DISTRO": distro}
    )
    remedy = "Type export ROS_DISTRO=lyrical in both terminals"
    assert (remedy in done.stderr) == (distro == "jazzy"), done.stderr
