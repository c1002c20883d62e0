"""Broadcasts the frame of a turtle in the frame `world`, at each pose that turtlesim publishes."""

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from tf2_ros import TransformBroadcaster
from tf_transformations import quaternion_from_euler
from turtlesim.msg import Pose


class TurtleBroadcaster(Node):
    """Turns the poses of the turtle that the parameter `turtlename` names into transforms."""

    def __init__(self):
        super().__init__("turtle_tf2_broadcaster")
        self.turtlename = self.declare_parameter("turtlename", "turtle1").value
        self.broadcaster = TransformBroadcaster(self)
        self.create_subscription(Pose, f"/{self.turtlename}/pose", self.on_pose, 1)

    def on_pose(self, pose):
        t = TransformStamped()
        t.header.stamp = self.get_clock().now().to_msg()
        t.header.frame_id = "world"
        t.child_frame_id = self.turtlename

        # A turtle lives in the plane: no z, and no rotation but the one about z.
        t.transform.translation.x = pose.x
        t.transform.translation.y = pose.y
        q = quaternion_from_euler(0.0, 0.0, pose.theta)
        (
            t.transform.rotation.x,
            t.transform.rotation.y,
            t.transform.rotation.z,
            t.transform.rotation.w,
        ) = q

        self.broadcaster.sendTransform(t)


def main(args=None):
    rclpy.init(args=args)
    try:
        rclpy.spin(TurtleBroadcaster())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
