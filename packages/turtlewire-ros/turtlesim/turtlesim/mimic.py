"""Makes one turtle do what another does: ``input/pose`` in, ``output/cmd_vel`` out."""

from __future__ import annotations

import contextlib
from typing import Any

import rclpy
from geometry_msgs.msg import Twist
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from turtlesim.msg import Pose
from turtlesim.turtle_endpoints import QUEUE_DEPTH


class MimicNode(Node):
    """Sends the velocities of one turtle to another; remap the two topics to choose them."""

    def __init__(self, **options: Any) -> None:
        super().__init__("turtle_mimic", **options)
        self._twist = self.create_publisher(Twist, "output/cmd_vel", QUEUE_DEPTH)
        self.create_subscription(Pose, "input/pose", self._on_pose, QUEUE_DEPTH)

    def _on_pose(self, pose: Any) -> None:
        message = Twist()
        message.linear.x = pose.linear_velocity
        message.angular.z = pose.angular_velocity
        self._twist.publish(message)


def main(args: list[str] | None = None) -> None:
    """Run until Ctrl-C."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        rclpy.spin(MimicNode())


if __name__ == "__main__":
    main()
