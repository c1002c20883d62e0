"""A node of rclpy for verbs that send or receive."""

from __future__ import annotations

import os
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from ros2cli.discovery import wait_until_discovered

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable
    from types import TracebackType

    from rclpy.node import Node
    from turtlewire.wire.base import Graph

__all__ = ["DirectNode"]


class DirectNode:
    """A hidden node that knows the graph; a context manager.

    Args:
        args: The command line, with the options of :func:`ros2cli.discovery.add_spin_arguments`.
        name: Name of the node; by default one made of the process id.
    """

    def __init__(self, args: argparse.Namespace, *, name: str | None = None) -> None:
        import rclpy
        from rclpy.parameter import Parameter

        rclpy.init(args=[])
        overrides = (
            [Parameter("use_sim_time", value=True)] if getattr(args, "use_sim_time", False) else []
        )
        self.node: Node = rclpy.create_node(
            name or f"_ros2cli_{os.getpid()}",
            start_parameter_services=False,
            parameter_overrides=overrides,
        )
        self._spin_time: float | None = getattr(args, "spin_time", None)

    @property
    def graph(self) -> Graph:
        """The graph."""
        return self.node.context.wire.graph

    def __enter__(self) -> DirectNode:  # noqa: PYI034  Self is not in Python 3.10
        """Wait for discovery."""
        wait_until_discovered(self.graph, self._spin_time)
        return self

    def __exit__(
        self,
        _type: type[BaseException] | None,
        _error: BaseException | None,
        _traceback: TracebackType | None,
    ) -> None:
        """Leave the domain."""
        import rclpy

        self.node.destroy_node()
        rclpy.try_shutdown()

    def spin(self) -> None:
        """Handle callbacks until Ctrl-C.

        Raises:
            KeyboardInterrupt: At Ctrl-C.
        """
        import rclpy
        from rclpy.executors import ExternalShutdownException

        try:
            rclpy.spin(self.node)
        except ExternalShutdownException as error:
            raise KeyboardInterrupt from error

    def wait_for(self, predicate: Callable[[], bool], timeout: float | None = None) -> bool:
        """Handle callbacks until the graph is as wanted; False when it was not within ``timeout`` seconds.

        Raises:
            KeyboardInterrupt: At Ctrl-C, or another signal that ends this process.
        """
        from rclpy.task import Future

        fulfilled: Future = Future()

        def look() -> None:
            if predicate():
                fulfilled.set_result(True)

        remove = self.graph.add_listener(look)
        try:
            look()
            self.result(fulfilled, timeout)
        except TimeoutError:
            return False
        finally:
            remove()
        return True

    def pause(self, seconds: float) -> None:
        """Handle callbacks for so long.

        Raises:
            KeyboardInterrupt: At Ctrl-C, or another signal that ends this process.
        """
        from rclpy.task import Future

        with suppress(TimeoutError):
            self.result(Future(), seconds)

    def result(self, future: Any, timeout: float | None = None) -> Any:
        """Handle callbacks until a future is done; its result.

        Raises:
            KeyboardInterrupt: At Ctrl-C.
            TimeoutError: It was not done within ``timeout`` seconds.
        """
        import rclpy
        from rclpy.executors import ExternalShutdownException

        try:
            rclpy.spin_until_future_complete(self.node, future, timeout_sec=timeout)
        except ExternalShutdownException as error:
            raise KeyboardInterrupt from error
        if not future.done():
            if not rclpy.ok():
                raise KeyboardInterrupt
            raise TimeoutError(f"no answer within {timeout} s")
        return future.result()
