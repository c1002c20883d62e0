from math import cos, pi, sin

import rclpy
from geometry_msgs.msg import Quaternion, TransformStamped
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import QoSProfile
from sensor_msgs.msg import JointState
from tf2_ros import TransformBroadcaster


class StatePublisher(Node):
    """As in the tutorial, its constructor runs until Ctrl-C, with a rate beside `spin_once`."""

    def __init__(self):
        rclpy.init()
        super().__init__("state_publisher")
        qos_profile = QoSProfile(depth=10)
        self.joint_pub = self.create_publisher(JointState, "joint_states", qos_profile)
        self.broadcaster = TransformBroadcaster(self, qos=qos_profile)
        self.get_logger().info(f"{self.get_name()} started")
        loop_rate = self.create_rate(30)
        angle = 0.0
        odom_trans = TransformStamped()
        odom_trans.header.frame_id = "odom"
        odom_trans.child_frame_id = "axis"
        joint_state = JointState()
        try:
            while rclpy.ok():
                rclpy.spin_once(self)
                joint_state.header.stamp = self.get_clock().now().to_msg()
                joint_state.name = ["swivel", "periscope_lift"]
                joint_state.position = [2 * angle, 0.2 * sin(angle)]
                odom_trans.header.stamp = self.get_clock().now().to_msg()
                odom_trans.transform.translation.x = 2.0 * cos(angle)
                odom_trans.transform.translation.y = 2.0 * sin(angle)
                odom_trans.transform.translation.z = 0.7
                odom_trans.transform.rotation = facing(angle + pi / 2)
                self.joint_pub.publish(joint_state)
                self.broadcaster.sendTransform(odom_trans)
                angle += pi / 180
                loop_rate.sleep()
        except (KeyboardInterrupt, ExternalShutdownException):
            pass


def facing(yaw):
    return Quaternion(x=0.0, y=0.0, z=sin(yaw / 2), w=cos(yaw / 2))


def main():
    StatePublisher()


if __name__ == "__main__":
    main()
