"""Given: broadcasts the frame of a turtle."""

import math

from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from tf2_ros import TransformBroadcaster
from turtlesim.msg import Pose


class Broadcaster(Node):
    """Publishes the frame of the turtle that the parameter `turtlename` names."""

    def __init__(self) -> None:
        super().__init__("broadcaster")
        self.turtlename = self.declare_parameter("turtlename", "turtle1").value
        self.broadcaster = TransformBroadcaster(self)
        self.create_subscription(Pose, f"/{self.turtlename}/pose", self.on_pose, 1)

    def on_pose(self, pose: Pose) -> None:
        """Send the pose on."""
        transform = TransformStamped()
        transform.header.stamp = self.get_clock().now().to_msg()
        transform.header.frame_id = "world"
        transform.child_frame_id = self.turtlename
        transform.transform.translation.x = pose.x
        transform.transform.translation.y = pose.y
        transform.transform.rotation.z = math.sin(pose.theta / 2)
        transform.transform.rotation.w = math.cos(pose.theta / 2)
        self.broadcaster.sendTransform(transform)
