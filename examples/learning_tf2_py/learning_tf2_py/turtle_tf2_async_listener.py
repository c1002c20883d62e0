"""Drives turtle2 to the target's current position; awaiting the transform blocks no thread."""

import rclpy
from learning_tf2_py.turtle_tf2_listener import FOLLOWER, TurtleListener
from rclpy.executors import ExternalShutdownException
from tf2_ros import TransformException


class AsyncListener(TurtleListener):
    """Awaits the present transform. Other callbacks of the node run meanwhile."""

    def __init__(self):
        super().__init__("turtle_tf2_async_listener")

    async def on_timer(self):
        if not self.count_publishers(f"{FOLLOWER}/pose"):
            self.spawn_follower()
            return
        now = self.get_clock().now()
        try:
            await self.tf_buffer.wait_for_transform_async(FOLLOWER, self.target_frame, now)
            self.steer(self.tf_buffer.lookup_transform(FOLLOWER, self.target_frame, now))
        except TransformException as ex:
            self.get_logger().info(f"Could not retrieve transform: {ex}", throttle_duration_sec=1.0)


def main(args=None):
    rclpy.init(args=args)
    try:
        rclpy.spin(AsyncListener())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
