#!/usr/bin/env python3
import math
import rclpy
from rclpy.node import Node
from geometry_msgs.msg import TransformStamped
from turtlesim.msg import Pose
import tf_transformations

from tf2_ros import TransformBroadcaster


class OdometryBroadcaster(Node):
    def __init__(self):
        super().__init__('odometry_tf2_broadcaster')
        self.turtlename = self.declare_parameter(
            'turtlename', 'turtle1'
        ).get_parameter_value().string_value
        self.start = None
        self.tf_broadcaster = TransformBroadcaster(self)
        self.create_subscription(Pose, f'/{self.turtlename}/pose', self.on_pose, 1)

    def on_pose(self, pose):
        if self.start is None:
            self.start = pose
        odom = self.start
        self.send('world', f'{self.turtlename}/odom', odom.x, odom.y, odom.theta)

        # The pose as seen from odom.
        dx = pose.x - odom.x
        dy = pose.y - odom.y
        a = odom.theta
        x = dx * math.cos(a) + dy * math.sin(a)
        y = -dx * math.sin(a) + dy * math.cos(a)
        theta = pose.theta - odom.theta
        self.send(
            f'{self.turtlename}/odom', f'{self.turtlename}/base_link', x, y, theta
        )

    def send(self, parent, child, x, y, theta):
        t = TransformStamped()
        t.header.stamp = self.get_clock().now().to_msg()
        t.header.frame_id = parent
        t.child_frame_id = child
        t.transform.translation.x = x
        t.transform.translation.y = y
        q = tf_transformations.quaternion_from_euler(0, 0, theta)
        t.transform.rotation.x = q[0]
        t.transform.rotation.y = q[1]
        t.transform.rotation.z = q[2]
        t.transform.rotation.w = q[3]
        self.tf_broadcaster.sendTransform(t)


def main(args=None):
    rclpy.init(args=args)
    node = OdometryBroadcaster()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.shutdown()


if __name__ == '__main__':
    main()
