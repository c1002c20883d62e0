"""An action client in asyncio: rclpy's futures are awaited while a thread spins the node."""

from __future__ import annotations

import asyncio
import contextlib
from typing import Any

import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionClient
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node


class MinimalActionClientAsyncIO(Node):
    """Asks for Fibonacci sequences."""

    def __init__(self) -> None:
        super().__init__("minimal_action_client_asyncio")
        self._client = ActionClient(self, Fibonacci, "fibonacci")

    def wait_for_server(self) -> None:
        """Wait until the server is available."""
        self.get_logger().info("Waiting for action server...")
        if not self._client.wait_for_server():
            raise ExternalShutdownException

    def feedback_callback(self, feedback: Any) -> None:
        """Log how far the server is; runs on the thread that spins."""
        self.get_logger().info(f"Received feedback: {feedback.feedback.sequence}")

    async def send_goal(self, order: int) -> None:
        """Send a goal and log its result."""
        self.get_logger().info("Sending goal request...")
        goal_handle = await self._client.send_goal_async(
            Fibonacci.Goal(order=order), feedback_callback=self.feedback_callback
        )
        if not goal_handle.accepted:
            self.get_logger().info("Goal rejected :(")
            return
        self.get_logger().info("Goal accepted :)")
        answer = await goal_handle.get_result_async()
        self.get_logger().info(f"Result: {answer.result.sequence}, status: {answer.status}")


async def send_goals(node: MinimalActionClientAsyncIO) -> None:
    """Send one goal, then two at the same time."""
    await node.send_goal(5)
    await asyncio.gather(node.send_goal(5), node.send_goal(10))


async def run(node: MinimalActionClientAsyncIO) -> None:
    """Send the goals while a thread spins the node; Ctrl-C ends both."""
    spinning = asyncio.create_task(asyncio.to_thread(rclpy.spin, node))
    sending = asyncio.create_task(send_goals(node))
    for task in (spinning, sending):
        task.add_done_callback(_look_at)
    await asyncio.wait((spinning, sending), return_when=asyncio.FIRST_COMPLETED)
    if sending.done():
        rclpy.shutdown()
        await sending
    # If it is not done, the node no longer spins, so no answer can arrive.
    sending.cancel()
    await spinning


def _look_at(task: asyncio.Task[None]) -> None:
    """Take the exception, which asyncio reports otherwise: Ctrl-C may come within any task."""
    if not task.cancelled():
        task.exception()


def main(args: list[str] | None = None) -> None:
    """Send three goals and wait for their results."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        node = MinimalActionClientAsyncIO()
        node.wait_for_server()
        asyncio.run(run(node))
