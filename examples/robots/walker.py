"""Lets the walker walk in a circle: three of its six legs stand while the other three swing."""

from __future__ import annotations

import math

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from sensor_msgs.msg import JointState
from tf2_ros import TransformBroadcaster

PERIOD = 0.04  # seconds between two states
CADENCE = 1.0  # steps a second
STRIDE = 0.4  # how far a hip swings to either side, in radians
LIFT = 0.5  # how far a knee bends to lift its foot, in radians
SPEED = 0.15  # metres a second
CIRCLE = 0.8  # radius of the circle, in metres
HEIGHT = 0.17  # of the body above the ground, in metres

#: Each leg with its side (1: left) and its half of the gait.
LEGS = {
    "left_front": (1, 0.0),
    "left_middle": (1, 0.5),
    "left_back": (1, 0.0),
    "right_front": (-1, 0.5),
    "right_middle": (-1, 0.0),
    "right_back": (-1, 0.5),
}


def gait(phase: float) -> tuple[float, float]:
    """Return a leg's reach ahead, from -1 to 1, and its foot's height, from 0 to 1.

    In the first half of a phase from 0 to 1 the foot stands and the body moves over it; in the
    second half it swings ahead through the air.
    """
    if phase < 0.5:
        return 1 - 4 * phase, 0.0
    swing = 2 * phase - 1
    return -math.cos(math.pi * swing), math.sin(math.pi * swing)


def joint_angles(seconds: float) -> dict[str, float]:
    """Return the angles of all joints [rad] at a time after the start."""
    angles = {}
    for name, (side, start) in LEGS.items():
        ahead, height = gait((CADENCE * seconds + start) % 1.0)
        angles[f"{name}_hip"] = -side * STRIDE * ahead
        angles[f"{name}_knee"] = -LIFT * height
    return angles


class Walker(Node):
    """Publishes joint states and the transform from ``odom`` to ``base_link``."""

    def __init__(self) -> None:
        super().__init__("walker")
        self._start = self.get_clock().now()
        self._joint_states = self.create_publisher(JointState, "joint_states", 10)
        self._broadcaster = TransformBroadcaster(self)
        self.create_timer(PERIOD, self._on_timer)

    def _on_timer(self) -> None:
        now = self.get_clock().now()
        seconds = (now - self._start).nanoseconds / 1e9
        angles = joint_angles(seconds)
        state = JointState(name=list(angles), position=list(angles.values()))
        transform = TransformStamped(child_frame_id="base_link")
        transform.header.frame_id = "odom"
        state.header.stamp = transform.header.stamp = now.to_msg()
        at = SPEED * seconds / CIRCLE
        transform.transform.translation.x = CIRCLE * math.cos(at)
        transform.transform.translation.y = CIRCLE * math.sin(at)
        transform.transform.translation.z = HEIGHT
        heading = at + math.pi / 2
        transform.transform.rotation.z = math.sin(heading / 2)
        transform.transform.rotation.w = math.cos(heading / 2)
        self._joint_states.publish(state)
        self._broadcaster.sendTransform(transform)


def main() -> None:
    """Walk until Ctrl-C."""
    try:
        with rclpy.init():
            rclpy.spin(Walker())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


if __name__ == "__main__":
    main()
