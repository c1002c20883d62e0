"""Drives turtle2 to the target's current position; the lookup waits for the transform."""

import rclpy
from learning_tf2_py.turtle_tf2_listener import FOLLOWER, TurtleListener
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from tf2_ros import TransformException


class BlockingListener(TurtleListener):
    """Looks up the present transform, not the latest, with a timeout to wait for it."""

    def __init__(self):
        super().__init__("turtle_tf2_blocking_listener")

    def on_timer(self):
        now = self.get_clock().now()
        try:
            self.steer(
                self.tf_buffer.lookup_transform(
                    FOLLOWER, self.target_frame, now, timeout=Duration(seconds=1.0)
                )
            )
        except TransformException as ex:
            self.get_logger().info(f"Could not retrieve transform: {ex}", throttle_duration_sec=1.0)
            self.spawn_follower()


def main(args=None):
    rclpy.init(args=args)
    try:
        # A callback that waits blocks its thread. On ROS 2 the TF2 listener needs another thread of
        # the executor.
        rclpy.spin(BlockingListener(), MultiThreadedExecutor())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
