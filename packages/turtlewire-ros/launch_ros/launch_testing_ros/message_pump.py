"""Spins a node on its own thread."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

from rclpy.executors import SingleThreadedExecutor

if TYPE_CHECKING:
    from rclpy.context import Context
    from rclpy.node import Node


class MessagePump:
    """Spins a node on its own thread, so that a test can wait for what it receives.

    Args:
        node: The node.
        context: Its context, if that is not the default one.
    """

    def __init__(self, node: Node, context: Context | None = None) -> None:
        self._node = node
        self._executor = SingleThreadedExecutor(context=context)
        self._executor.add_node(node)
        self._thread = threading.Thread(
            target=self._executor.spin, name="message_pump", daemon=True
        )

    def start(self) -> None:
        """Begin to spin."""
        self._thread.start()

    def stop(self) -> None:
        """End the thread; returns when it has ended."""
        self._executor.shutdown()
        if self._thread.is_alive():
            self._thread.join()
