"""Two timers that exclude each other, on four threads, and a listener next to them."""

from __future__ import annotations

import contextlib

import rclpy
from examples_rclpy_executors.listener import Listener
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


class DoubleTalker(Node):
    """Publishes a counted greeting from two timers.

    Both change the counter, so they share a callback group that runs one callback at a time.
    """

    def __init__(self) -> None:
        super().__init__("double_talker")
        self.i = 0
        self.pub = self.create_publisher(String, "chatter", 10)
        self.group = MutuallyExclusiveCallbackGroup()
        self.timer = self.create_timer(1.0, self.timer_callback, callback_group=self.group)
        self.timer2 = self.create_timer(0.5, self.timer_callback, callback_group=self.group)

    def timer_callback(self) -> None:
        """Publish one greeting."""
        message = String(data=f"Hello World: {self.i}")
        self.i += 1
        self.get_logger().info(f'Publishing: "{message.data}"')
        self.pub.publish(message)


def main(args: list[str] | None = None) -> None:
    """Talk and listen until Ctrl-C."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        executor = MultiThreadedExecutor(num_threads=4)
        executor.add_node(DoubleTalker())
        executor.add_node(Listener())
        executor.spin()
