"""The Python nodes that were running when the captures of `servers.txt` were made."""

from __future__ import annotations

import sys

import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionServer
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.lifecycle import LifecycleNode
from rclpy.node import Node
from std_msgs.msg import String


class FibonacciServer(Node):
    """`examples_rclpy_minimal_action_server`: at least two numbers."""

    def __init__(self):
        super().__init__("minimal_action_server")
        self._server = ActionServer(self, Fibonacci, "fibonacci", self.execute)

    def execute(self, goal):
        sequence = [0, 1]
        for index in range(1, goal.request.order):
            sequence.append(sequence[index] + sequence[index - 1])
        goal.succeed()
        return Fibonacci.Result(sequence=sequence)


class HiddenTalker(Node):
    """`demo_nodes_py talker` under a hidden name."""

    def __init__(self):
        super().__init__("_hidden_talker")
        self._publisher = self.create_publisher(String, "hidden_chatter", 10)


def main():
    rclpy.init(args=sys.argv)
    executor = MultiThreadedExecutor()
    for node in (FibonacciServer(), HiddenTalker(), LifecycleNode("lc_talker")):
        executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
