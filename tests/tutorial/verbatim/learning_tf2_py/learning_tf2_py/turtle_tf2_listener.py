#!/usr/bin/env python3
import math
import rclpy
from rclpy.node import Node
from geometry_msgs.msg import Twist
from tf2_ros import TransformException
from tf2_ros.buffer import Buffer
from tf2_ros.transform_listener import TransformListener

class TurtleTF2Listener(Node):
    def __init__(self):
        super().__init__('turtle_tf2_listener')

        # 1. Set the target frame (the object to follow).
        self.target_frame = self.declare_parameter(
            'target_frame', 'turtle1'
        ).get_parameter_value().string_value

        # 2. Create TF2 buffer and listener objects.
        self.tf_buffer = Buffer()
        self.tf_listener = TransformListener(self.tf_buffer, self)

        # 3. Create a publisher for sending control commands to the second turtle (turtle2).
        self.publisher = self.create_publisher(
            Twist,
            'turtle2/cmd_vel',
            1
        )

        # 4. Create a timer that queries transforms and sends control commands every 0.1 seconds.
        self.timer = self.create_timer(0.1, self.on_timer)

    def on_timer(self):
        # 5. Define the source and target frames.
        from_frame_rel = self.target_frame
        to_frame_rel = 'turtle2'

        try:
            # 6. Request the transform between the frames using the TF buffer.
            # (target_frame -> source_frame)
            t = self.tf_buffer.lookup_transform(
                to_frame_rel,
                from_frame_rel,
                rclpy.time.Time()
            )
        except TransformException as ex:
            self.get_logger().info(
                f'Could not retrieve transform: {ex}'
            )
            return

        # 7. Generate control commands based on the transform data (t)
        # by calculating the distance and heading to the target.
        msg = Twist()

        scale_rotation_rate = 1.0
        msg.angular.z = scale_rotation_rate * math.atan2(
            t.transform.translation.y,
            t.transform.translation.x
        )

        scale_forward_speed = 0.5
        msg.linear.x = scale_forward_speed * math.sqrt(
            t.transform.translation.x ** 2 +
            t.transform.translation.y ** 2
        )

        # Publish movement commands to the second turtle.
        self.publisher.publish(msg)

def main(args=None):
    rclpy.init(args=args)
    node = TurtleTF2Listener()

    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.shutdown()

if __name__ == '__main__':
    main()
