"""Drives turtle1 in a curve, then prints how far turtle2 went and how far from turtle1 it ended."""

from __future__ import annotations

import math
import sys
import threading
import time

from geometry_msgs.msg import Twist
from turtlesim.msg import Pose
from turtlewire import msg
from turtlewire.wire import open_context
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS

LIMIT_S = 60
NEAR_M = 0.3

context = open_context()
node = context.create_node("driver")
changed = threading.Condition()
poses: dict[str, Pose] = {}
way = {"turtle1": 0.0, "turtle2": 0.0}


def on_pose(name: str, data: bytes) -> None:
    pose = msg.deserialize(Pose, data)
    with changed:
        way[name] += distance(poses.get(name, pose), pose)
        poses[name] = pose
        changed.notify_all()


def distance(one: Pose, other: Pose) -> float:
    return math.hypot(one.x - other.x, one.y - other.y)


def wait_for(condition, limit_s: float = LIMIT_S) -> None:
    with changed:
        if not changed.wait_for(condition, limit_s):
            sys.exit(f"never true: {poses}, {way}")


pose_id = TypeId("turtlesim/msg/Pose", msg.type_hash("turtlesim/msg/Pose"))
for turtle in way:
    node.create_subscription(
        f"/{turtle}/pose", pose_id, QoS(), lambda data, _, turtle=turtle: on_pose(turtle, data)
    )
command = node.create_publisher(
    "/turtle1/cmd_vel",
    TypeId("geometry_msgs/msg/Twist", msg.type_hash("geometry_msgs/msg/Twist")),
    QoS(),
)
wait_for(lambda: way["turtle2"] > 0.1)
twist = Twist()
twist.linear.x, twist.angular.z = 2.0, 1.8
deadline = time.monotonic() + LIMIT_S
while way["turtle1"] < 4.0 and time.monotonic() < deadline:
    command.publish(msg.serialize(twist))
    with changed:
        changed.wait(0.2)
wait_for(lambda: way["turtle1"] >= 4.0)
wait_for(lambda: poses["turtle1"].linear_velocity == 0.0 and distance(*poses.values()) < NEAR_M)
print(f"{way['turtle2']:.3f} {distance(*poses.values()):.3f}", flush=True)
context.close()
