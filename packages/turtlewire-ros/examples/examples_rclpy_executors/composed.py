"""The talker and the listener in one process, on one thread."""

from __future__ import annotations

import contextlib

import rclpy
from examples_rclpy_executors.listener import Listener
from examples_rclpy_executors.talker import Talker
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor


def main(args: list[str] | None = None) -> None:
    """Talk and listen until Ctrl-C."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        executor = SingleThreadedExecutor()
        executor.add_node(Talker())
        executor.add_node(Listener())
        executor.spin()
