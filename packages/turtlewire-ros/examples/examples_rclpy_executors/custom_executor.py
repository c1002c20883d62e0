"""An executor of our own: nodes of high priority do not wait for the others."""

from __future__ import annotations

import contextlib
import os
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import rclpy
from examples_rclpy_executors.listener import Listener
from examples_rclpy_executors.talker import Talker
from rclpy.executors import Executor, ExternalShutdownException, TimeoutException
from rclpy.node import Node
from std_msgs.msg import String


class Estopper(Node):
    """Listens for emergency stops, which must not wait."""

    def __init__(self) -> None:
        super().__init__("estopper")
        self.sub = self.create_subscription(String, "estop", self.estop_callback, 10)

    def estop_callback(self, message: String) -> None:
        """Log the stop."""
        self.get_logger().info(f"I heard: {message.data}")


class PriorityExecutor(Executor):
    """Runs callbacks of high-priority nodes on many threads, and other nodes' on one."""

    def __init__(self) -> None:
        super().__init__()
        self.high_priority_nodes: set[Node] = set()
        self.hp_executor = ThreadPoolExecutor(max_workers=os.cpu_count() or 4)
        self.lp_executor = ThreadPoolExecutor(max_workers=1)

    def add_high_priority_node(self, node: Node) -> None:
        """Serve a node whose callbacks do not wait for other nodes'."""
        self.high_priority_nodes.add(node)
        self.add_node(node)

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """Hand the next callback to the threads of its node's priority."""
        try:
            handler, _group, node = self.wait_for_ready_callbacks(timeout_sec=timeout_sec)
        except TimeoutException:
            return
        important = node in self.high_priority_nodes
        pool: Any = self.hp_executor if important else self.lp_executor
        pool.submit(handler)


def main(args: list[str] | None = None) -> None:
    """Talk and listen, and listen for stops on ``estop``, until Ctrl-C."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        executor = PriorityExecutor()
        executor.add_high_priority_node(Estopper())
        executor.add_node(Listener())
        executor.add_node(Talker())
        executor.spin()
