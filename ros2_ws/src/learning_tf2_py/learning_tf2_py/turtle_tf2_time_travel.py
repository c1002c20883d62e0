"""Drives turtle2 to where turtle1 was some seconds ago: a lookup between two frames at two times."""

import rclpy
from geometry_msgs.msg import Twist
from learning_tf2_py.turtle_tf2_listener import twist_towards
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from tf2_ros import Buffer, TransformException, TransformListener


class TimeTraveller(Node):
    """Asks TF2 ten times a second where turtle1 was, as turtle2 sees it now. `world` is the frame that did not move in between."""

    def __init__(self):
        super().__init__("turtle_tf2_time_travel")
        self.delay = Duration(seconds=self.declare_parameter("delay", 5.0).value)
        self.tf_buffer = Buffer()
        self.tf_listener = TransformListener(self.tf_buffer, self)
        self.publisher = self.create_publisher(Twist, "turtle2/cmd_vel", 1)
        self.create_timer(0.1, self.on_timer)

    def on_timer(self):
        now = self.get_clock().now()
        if now.nanoseconds < self.delay.nanoseconds:
            return  # a simulation that has just begun: there is no past to look at
        try:
            turtle2_from_past = self.tf_buffer.lookup_transform_full(
                target_frame="turtle2",
                target_time=rclpy.time.Time(),
                source_frame="turtle1",
                source_time=now - self.delay,
                fixed_frame="world",
            )
        except TransformException as ex:
            self.get_logger().info(f"Could not retrieve transform: {ex}", throttle_duration_sec=1.0)
            return
        past = turtle2_from_past.transform.translation
        self.publisher.publish(twist_towards(past.x, past.y))


def main(args=None):
    rclpy.init(args=args)
    try:
        rclpy.spin(TimeTraveller())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
