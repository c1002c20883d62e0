"""The command line of the talker and the listener whose quality of service can be chosen."""

from __future__ import annotations

import argparse
import contextlib
import sys
from collections.abc import Callable
from typing import TYPE_CHECKING

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.utilities import remove_ros_args

if TYPE_CHECKING:
    from rclpy.node import Node


def profile(*, reliable: bool) -> QoSProfile:
    """Return a queue of ten messages, reliable or best effort."""
    policy = ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT
    return QoSProfile(depth=10, reliability=policy)


def run_cycles(make_node: Callable[[bool], Node], role: str, args: list[str] | None) -> None:
    """Read ``--reliable`` and ``-n CYCLES``, make the node and spin it that many times."""
    parser = argparse.ArgumentParser(formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    parser.add_argument(
        "--reliable",
        action="store_true",
        help="set qos profile to reliable",
    )
    parser.add_argument(
        "-n",
        "--number_of_cycles",
        type=int,
        default=sys.maxsize,
        help=f"number of cycles of the {role}",
    )
    argv = sys.argv if args is None else ["", *args]
    # `rclpy.init` reads the ROS arguments; argparse would reject them.
    options = parser.parse_args(remove_ros_args(argv)[1:])
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        node = make_node(options.reliable)
        cycle = 0
        while rclpy.ok() and cycle < options.number_of_cycles:
            # As in ROS 2, each callback is a cycle, so a timer's counts as well as a message's.
            rclpy.spin_once(node)
            cycle += 1
