#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from geometry_msgs.msg import TransformStamped
from turtlesim.msg import Pose
import tf_transformations

# Import the dynamic broadcaster library from tf2_ros.
from tf2_ros import TransformBroadcaster

class TurtleTF2Broadcaster(Node):
    def __init__(self):
        super().__init__('turtle_tf2_broadcaster')

        # Retrieve the turtle name as a parameter. (Default: 'turtle1')
        self.turtlename = self.declare_parameter(
            'turtlename', 'turtle1'
        ).get_parameter_value().string_value

        # 1. Create a dynamic transform broadcaster object.
        self.tf_broadcaster = TransformBroadcaster(self)

        # 2. Create a subscriber to receive the turtle's pose information.
        self.subscription = self.create_subscription(
            Pose,
            f'/{self.turtlename}/pose',
            self.handle_turtle_pose,
            1
        )

    # 3. Callback function executed whenever pose data is received.
    def handle_turtle_pose(self, msg):
        t = TransformStamped()

        # Configure the header: set the current timestamp and parent frame.
        t.header.stamp = self.get_clock().now().to_msg()
        t.header.frame_id = 'world'
        t.child_frame_id = self.turtlename

        # Copy the turtle's 2D pose (x, y) into the 3D translation data.
        t.transform.translation.x = msg.x
        t.transform.translation.y = msg.y
        t.transform.translation.z = 0.0

        # Convert the turtle's 1D rotation (theta) into a 3D quaternion.
        q = tf_transformations.quaternion_from_euler(0, 0, msg.theta)
        t.transform.rotation.x = q[0]
        t.transform.rotation.y = q[1]
        t.transform.rotation.z = q[2]
        t.transform.rotation.w = q[3]

        # 4. Broadcast the configured transform to the TF2 network.
        self.tf_broadcaster.sendTransform(t)

def main(args=None):
    rclpy.init(args=args)
    node = TurtleTF2Broadcaster()

    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.shutdown()

if __name__ == '__main__':
    main()
