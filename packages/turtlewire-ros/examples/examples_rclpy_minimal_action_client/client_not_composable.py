"""An action client in one function, which spins until each answer has arrived."""

from __future__ import annotations

import contextlib
from typing import TYPE_CHECKING, Any

import rclpy
from action_msgs.msg import GoalStatus
from example_interfaces.action import Fibonacci
from rclpy.action import ActionClient
from rclpy.executors import ExternalShutdownException

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.task import Future


def wait_for(node: Node, future: Future[Any]) -> Any:
    """Return the future's result, for which the node spins."""
    rclpy.spin_until_future_complete(node, future)
    if not future.done():
        raise ExternalShutdownException
    return future.result()


def main(args: list[str] | None = None) -> None:
    """Send one goal and wait for its result."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        node = rclpy.create_node("minimal_action_client")
        log = node.get_logger()
        client = ActionClient(node, Fibonacci, "fibonacci")
        log.info("Waiting for action server...")
        if not client.wait_for_server():
            raise ExternalShutdownException
        log.info("Sending goal request...")
        sent = client.send_goal_async(
            Fibonacci.Goal(order=10),
            feedback_callback=lambda it: log.info(f"Received feedback: {it.feedback.sequence}"),
        )
        goal_handle = wait_for(node, sent)
        if not goal_handle.accepted:
            log.info("Goal rejected :(")
            return
        log.info("Goal accepted :)")
        answer = wait_for(node, goal_handle.get_result_async())
        if answer.status == GoalStatus.STATUS_SUCCEEDED:
            log.info(f"Goal succeeded! Result: {answer.result.sequence}")
        else:
            log.info(f"Goal failed with status code: {answer.status}")
