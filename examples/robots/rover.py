"""Drives the rover: velocities on ``cmd_vel`` turn its wheels and move it in the frame ``odom``."""

from __future__ import annotations

import math
from typing import NamedTuple

import rclpy
from geometry_msgs.msg import TransformStamped, Twist
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from sensor_msgs.msg import JointState
from tf2_ros import TransformBroadcaster

PERIOD = 0.04  # seconds between two states
RADIUS = 0.1  # of a wheel, in metres, as in rover.urdf.xacro
TRACK = 0.4  # between the wheels, in metres
PATIENCE = 0.5  # seconds after which a velocity is no longer obeyed


class Place(NamedTuple):
    """Position [m] and heading [rad] of the rover in ``odom``."""

    x: float = 0.0
    y: float = 0.0
    heading: float = 0.0

    def driven(self, ahead: float, turned: float) -> Place:
        """Return the place after ``ahead`` metres on an arc that turns by ``turned`` rad."""
        middle = self.heading + turned / 2
        chord = ahead * (math.sin(turned / 2) / (turned / 2) if turned else 1.0)
        return Place(
            self.x + chord * math.cos(middle),
            self.y + chord * math.sin(middle),
            self.heading + turned,
        )


class Rover(Node):
    """Publishes joint states and the transform from ``odom`` to ``base_link``."""

    def __init__(self) -> None:
        super().__init__("rover")
        self.place = Place()
        self._wheels = {"left_wheel_joint": 0.0, "right_wheel_joint": 0.0}
        self._twist = Twist()
        self._told_at = self.get_clock().now()
        self._joint_states = self.create_publisher(JointState, "joint_states", 10)
        self._broadcaster = TransformBroadcaster(self)
        self.create_subscription(Twist, "cmd_vel", self._on_twist, 10)
        self.create_timer(PERIOD, self._on_timer)

    def _on_twist(self, twist: Twist) -> None:
        self._twist, self._told_at = twist, self.get_clock().now()

    def _on_timer(self) -> None:
        now = self.get_clock().now()
        if (now - self._told_at).nanoseconds > PATIENCE * 1e9:
            self._twist = Twist()
        ahead, turned = self._twist.linear.x * PERIOD, self._twist.angular.z * PERIOD
        self.place = self.place.driven(ahead, turned)
        self._wheels["left_wheel_joint"] += (ahead - turned * TRACK / 2) / RADIUS
        self._wheels["right_wheel_joint"] += (ahead + turned * TRACK / 2) / RADIUS
        self._publish(now.to_msg())

    def _publish(self, stamp) -> None:  # noqa: ANN001 - builtin_interfaces.msg.Time
        state = JointState(
            name=[*self._wheels, "camera_pan"],
            position=[*self._wheels.values(), 0.5 * math.sin(self.place.heading)],
        )
        state.header.stamp = stamp
        self._joint_states.publish(state)
        transform = TransformStamped(child_frame_id="base_link")
        transform.header.stamp = stamp
        transform.header.frame_id = "odom"
        transform.transform.translation.x = self.place.x
        transform.transform.translation.y = self.place.y
        transform.transform.translation.z = RADIUS
        transform.transform.rotation.z = math.sin(self.place.heading / 2)
        transform.transform.rotation.w = math.cos(self.place.heading / 2)
        self._broadcaster.sendTransform(transform)


def main() -> None:
    """Drive until Ctrl-C."""
    try:
        with rclpy.init():
            rclpy.spin(Rover())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


if __name__ == "__main__":
    main()
