"""A node in RViz's place, so that launch files that start RViz run; it shows nothing."""

from __future__ import annotations

import argparse
import contextlib
import os
import sys

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.utilities import remove_ros_args

__all__ = ["main"]

_NOTICE = (
    "turtlewire has no 3D view yet: this node shows nothing. `turtlewire frames` shows the tree of "
    "frames, `ros2 run tf2_ros tf2_echo SOURCE TARGET` where a link is; RViz on a machine with "
    "ROS 2, with the same ROS_DOMAIN_ID, shows the robot."
)


def main(args: list[str] | None = None) -> None:
    """Take RViz's arguments, say that nothing is shown, and spin until Ctrl-C."""
    parser = argparse.ArgumentParser(prog="rviz2", description=_NOTICE)
    parser.add_argument("-d", "--display-config", help="RViz's settings")
    options, _ = parser.parse_known_args(
        remove_ros_args(sys.argv if args is None else ["", *args])[1:]
    )
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        node = rclpy.create_node("rviz2")
        config = options.display_config
        if config is not None and not os.path.isfile(config):
            node.get_logger().warning(f"There is no file {config}")
        node.get_logger().info(_NOTICE)
        rclpy.spin(node)
