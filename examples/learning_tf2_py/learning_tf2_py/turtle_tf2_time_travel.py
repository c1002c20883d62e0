"""Drives turtle2 to turtle1's position some seconds ago: two frames at two times."""

import rclpy
from learning_tf2_py.turtle_tf2_listener import FOLLOWER, TurtleListener
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException
from rclpy.time import Time
from tf2_ros import TransformException


class TimeTraveller(TurtleListener):
    """Looks up the target's past place from turtle2's present one, by way of `world`."""

    def __init__(self):
        super().__init__("turtle_tf2_time_travel")
        self.delay = Duration(seconds=self.declare_parameter("delay", 5.0).value)

    def on_timer(self):
        now = self.get_clock().now()
        if now.nanoseconds < self.delay.nanoseconds:
            return  # a simulation that has just begun: there is no past to look at
        try:
            follower_from_past = self.tf_buffer.lookup_transform_full(
                target_frame=FOLLOWER,
                target_time=Time(),
                source_frame=self.target_frame,
                source_time=now - self.delay,
                fixed_frame="world",
            )
        except TransformException as ex:
            self.get_logger().info(f"Could not retrieve transform: {ex}", throttle_duration_sec=1.0)
            self.spawn_follower()
            return
        self.steer(follower_from_past)


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
