"""An action server of functions, without a class for its node."""

from __future__ import annotations

import contextlib
import time
from functools import partial
from typing import TYPE_CHECKING, Any

import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionServer, CancelResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor

if TYPE_CHECKING:
    from rclpy.node import Node


def cancel_callback(node: Node, _goal_handle: Any) -> CancelResponse:
    """Accept every cancellation."""
    node.get_logger().info("Received cancel request")
    return CancelResponse.ACCEPT


def execute_callback(node: Node, goal_handle: Any) -> Fibonacci.Result:
    """Compute one sequence; runs on a thread of the executor."""
    node.get_logger().info("Executing goal...")
    feedback = Fibonacci.Feedback(sequence=[0, 1])
    for _ in range(1, goal_handle.request.order):
        if goal_handle.is_cancel_requested:
            goal_handle.canceled()
            node.get_logger().info("Goal canceled")
            return Fibonacci.Result()
        feedback.sequence.append(feedback.sequence[-1] + feedback.sequence[-2])
        node.get_logger().info(f"Publishing feedback: {feedback.sequence}")
        goal_handle.publish_feedback(feedback)
        time.sleep(1)
    goal_handle.succeed()
    result = Fibonacci.Result(sequence=feedback.sequence)
    node.get_logger().info(f"Returning result: {result.sequence}")
    return result


def main(args: list[str] | None = None) -> None:
    """Serve goals until Ctrl-C."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        node = rclpy.create_node("minimal_action_server")
        ActionServer(
            node,
            Fibonacci,
            "fibonacci",
            execute_callback=partial(execute_callback, node),
            cancel_callback=partial(cancel_callback, node),
            callback_group=ReentrantCallbackGroup(),
        )
        rclpy.spin(node, executor=MultiThreadedExecutor())
