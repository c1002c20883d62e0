"""``ros2 run robot_state_publisher robot_state_publisher``."""

from __future__ import annotations

import contextlib
import sys

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.utilities import remove_ros_args
from robot_state_publisher.node import RobotStatePublisher, StartError

_USAGE = """usage: robot_state_publisher [URDF_FILE] [--ros-args -p robot_description:=TEXT ...]

Publishes the frames of a robot: subscribes to joint_states, publishes /tf, /tf_static and
robot_description. The description is the parameter robot_description; a file as argument is
the old way.

parameters: robot_description   the URDF; what `xacro FILE` prints
            publish_frequency   maximum number of published joint states per second (default 20.0)
            ignore_timestamp    publish every joint state, whatever its stamp (default false)
            frame_prefix        is put before the names of all frames, without a slash"""


def main(args: list[str] | None = None) -> int:
    """Publish until stopped; returns the exit status."""
    argv = sys.argv if args is None else args
    words = remove_ros_args(argv)[1:]
    if {"-h", "--help"} & {*words}:
        print(_USAGE)  # noqa: T201
        return 0
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=argv):
        try:
            node = RobotStatePublisher(urdf_file=words[0] if words else None)
        except StartError as error:
            print(error, file=sys.stderr)  # noqa: T201
            if error.hint:
                print(f"    {error.hint}", file=sys.stderr)  # noqa: T201
            return 1
        rclpy.spin(node)
    return 0
