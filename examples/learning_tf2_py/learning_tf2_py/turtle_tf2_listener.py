"""Drives turtle2 after the frame that the parameter `target_frame` names; turtle1 by default."""

import math

import rclpy
from geometry_msgs.msg import Twist
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import Buffer, TransformException, TransformListener
from turtlesim.srv import Spawn

FOLLOWER = "turtle2"


def twist_towards(x, y):
    """Return the command that drives to a point `x` m ahead and `y` m to the left."""
    command = Twist()
    command.linear.x = 0.5 * math.hypot(x, y)
    command.angular.z = 1.0 * math.atan2(y, x)
    return command


class TurtleListener(Node):
    """Looks up the target in turtle2's frame ten times a second, and steers turtle2 there."""

    def __init__(self, node_name="turtle_tf2_listener"):
        super().__init__(node_name)
        self.target_frame = self.declare_parameter("target_frame", "turtle1").value

        self.tf_buffer = Buffer()
        self.tf_listener = TransformListener(self.tf_buffer, self)

        self.spawner = self.create_client(Spawn, "spawn")
        self.spawning = None
        self.publisher = self.create_publisher(Twist, f"{FOLLOWER}/cmd_vel", 1)
        self.create_timer(0.1, self.on_timer)

    def on_timer(self):
        try:
            self.steer(self.tf_buffer.lookup_transform(FOLLOWER, self.target_frame, Time()))
        except TransformException as ex:
            self.get_logger().info(f"Could not retrieve transform: {ex}", throttle_duration_sec=1.0)
            self.spawn_follower()

    def steer(self, follower_from_target):
        target = follower_from_target.transform.translation
        self.publisher.publish(twist_towards(target.x, target.y))

    def spawn_follower(self):
        """Ask the simulator, once, for a second turtle: nothing else in the demo does."""
        if self.spawning is not None or not self.spawner.service_is_ready():
            return
        if self.count_publishers(f"{FOLLOWER}/pose"):
            return
        self.spawning = self.spawner.call_async(
            Spawn.Request(x=4.0, y=2.0, theta=0.0, name=FOLLOWER)
        )
        self.spawning.add_done_callback(self.on_spawned)

    def on_spawned(self, future):
        name = future.result().name
        if name:
            self.get_logger().info(f"Successfully spawned {name}")


def main(args=None):
    rclpy.init(args=args)
    try:
        rclpy.spin(TurtleListener())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
