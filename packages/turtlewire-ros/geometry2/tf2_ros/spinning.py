"""An executor that spins in its own thread."""

from __future__ import annotations

from contextlib import suppress
from threading import Thread
from typing import TYPE_CHECKING

from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor

if TYPE_CHECKING:
    from rclpy.experimental import AsyncNode
    from rclpy.node import Node


def spin_in_thread(node: Node | AsyncNode, name: str) -> tuple[SingleThreadedExecutor, Thread]:
    """Spin a node in a daemon thread, until its executor or its context is shut down.

    Raises:
        TypeError: The node is asynchronous.
    """
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)  # type: ignore[arg-type]  # raises if it is asynchronous
    thread = Thread(target=_spin, args=(executor,), name=name, daemon=True)
    thread.start()
    return executor, thread


def _spin(executor: SingleThreadedExecutor) -> None:
    with suppress(ExternalShutdownException):
        executor.spin()
