"""Broadcasts, once, a frame that never moves: NAME X Y Z ROLL PITCH YAW."""

import sys

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.utilities import remove_ros_args
from tf2_ros import StaticTransformBroadcaster
from tf_transformations import quaternion_from_euler

USAGE = (
    "usage: ros2 run learning_tf2_py static_turtle_tf2_broadcaster NAME X Y Z ROLL PITCH YAW "
    "(metres and radians in world)"
)


class StaticTurtleBroadcaster(Node):
    """Broadcasts the frame `child_frame_id` in the frame `world`."""

    def __init__(self, child_frame_id, translation, angles):
        super().__init__("static_turtle_tf2_broadcaster")
        self.broadcaster = StaticTransformBroadcaster(self)

        t = TransformStamped()
        t.header.stamp = self.get_clock().now().to_msg()
        t.header.frame_id = "world"
        t.child_frame_id = child_frame_id
        t.transform.translation.x, t.transform.translation.y, t.transform.translation.z = (
            translation
        )
        q = quaternion_from_euler(*angles)
        (
            t.transform.rotation.x,
            t.transform.rotation.y,
            t.transform.rotation.z,
            t.transform.rotation.w,
        ) = q
        self.broadcaster.sendTransform(t)


def parse_arguments(arguments):
    """Return the frame's name and its six numbers; end the program with help if they are wrong."""
    if len(arguments) != 7:
        sys.exit(USAGE)
    name, *numbers = arguments
    if name in ("", "world"):
        sys.exit(f'{USAGE}\nThe name must be a new one, not "{name}".')
    try:
        return name, [float(number) for number in numbers]
    except ValueError as error:
        sys.exit(f"{USAGE}\n{error}")


def main(args=None):
    name, numbers = parse_arguments(remove_ros_args(args if args is not None else sys.argv)[1:])
    rclpy.init(args=args)
    try:
        rclpy.spin(StaticTurtleBroadcaster(name, numbers[:3], numbers[3:]))
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
