"""The node of rclpy with which verbs and extensions send, receive and look at the graph."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from contextlib import nullcontext, suppress
from types import TracebackType
from typing import TYPE_CHECKING, Any

from ros2cli.discovery import hidden_node_name, wait_until_discovered
from ros2cli.node import NODE_NAME_PREFIX
from turtlewire.wire.environment import leaving_at_once

if TYPE_CHECKING:
    from rclpy.node import Node
    from turtlewire.wire.base import Graph

__all__ = ["DEFAULT_TIMEOUT", "NODE_NAME_PREFIX", "DirectNode", "add_arguments"]

#: Seconds for which ROS 2 looks; here that is the time of ``--spin-time``, if it is given.
DEFAULT_TIMEOUT = 0.5

#: How long an answer may follow the news that its server has left.
_LAST_ANSWER_S = 0.5


class DirectNode:
    """A hidden node that knows the graph; a context manager.

    It has all attributes of the `rclpy.node.Node` in its attribute ``node``.

    Args:
        args: The command line, with the arguments of `add_arguments`; None for the defaults.
        node_name: Name of the node; by default one made of the process id.
        lingers: Whether the end waits until others have got what was sent last.
    """

    def __init__(
        self,
        args: argparse.Namespace | None,
        *,
        node_name: str | None = None,
        lingers: bool = False,
    ) -> None:
        import rclpy
        import rclpy.executors  # now: Python loses an interrupt that comes during an import
        from rclpy.parameter import Parameter

        overrides = (
            [Parameter("use_sim_time", value=True)] if getattr(args, "use_sim_time", False) else []
        )
        with nullcontext() if lingers else leaving_at_once():
            rclpy.init(args=[])
            self.node: Node = rclpy.create_node(
                node_name or hidden_node_name(getattr(args, "node_name_suffix", None)),
                # As in ROS 2, this node has no services for other tools.
                start_parameter_services=False,
                parameter_overrides=overrides,
            )
        self._spin_time: float | None = getattr(args, "spin_time", None)

    @classmethod
    def around(cls, node: Any) -> DirectNode:
        """Wrap a node that the caller owns and destroys.

        Args:
            node: A node of rclpy, or an object whose attribute ``node`` is one.
        """
        # Without the constructor, which would make a node.
        direct = DirectNode.__new__(DirectNode)
        direct.node = getattr(node, "node", node)
        direct._spin_time = None
        return direct

    def __getattr__(self, name: str) -> Any:
        if name == "node":  # the constructor has failed
            raise AttributeError(name)
        return getattr(self.node, name)

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
        exc_type: type[BaseException] | None,
        exc_value: BaseException | None,
        traceback: TracebackType | None,
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
            # A signal such as SIGTERM ends a verb as Ctrl-C does.
            raise KeyboardInterrupt from error

    def wait_for(
        self, predicate: Callable[[], bool], timeout: float | None = None, other: Any = None
    ) -> bool:
        """Handle callbacks until the graph is as wanted.

        Args:
            predicate: Asked now and after every change of the graph.
            timeout: Seconds to wait; None waits without a limit.
            other: A future whose end also asks the predicate.

        Returns:
            Whether the predicate was true in time.

        Raises:
            KeyboardInterrupt: At Ctrl-C, or another signal that ends this process.
        """
        from rclpy.task import Future

        fulfilled: Future = Future()

        def look(_: Any = None) -> None:
            if not fulfilled.done() and predicate():
                fulfilled.set_result(True)

        remove = self.graph.add_listener(look)
        if other is not None:
            other.add_done_callback(look)
        try:
            # After the listener is added, so that no change is missed.
            look()
            self.result(fulfilled, timeout)
        except TimeoutError:
            return False
        finally:
            remove()
        return True

    def wait_for_server(
        self, service: str, is_ready: Callable[[], bool], timeout: float | None = None
    ) -> bool:
        """Wait until the server of a service is available.

        Args:
            service: Fully qualified name of the service.
            is_ready: Whether it is there; asked now and after every change of the graph.
            timeout: Seconds to wait; None waits without a limit.

        Returns:
            Whether it came in time.

        Raises:
            UncallableServiceError: The server's middleware would misread the request.
        """
        from turtlewire.wire.services import require_callable

        def look() -> bool:
            if not self.node.context.ok():  # where is_ready() raises
                return False
            require_callable(self.graph, service)
            return is_ready()

        timeout_ns = None if timeout is None else int(timeout * 1e9)
        return self.node.context.wait_for_graph(look, timeout_ns)

    def pause(self, seconds: float) -> None:
        """Handle callbacks for a number of seconds.

        Raises:
            KeyboardInterrupt: At Ctrl-C, or another signal that ends this process.
        """
        from rclpy.task import Future

        with suppress(TimeoutError):
            self.result(Future(), seconds)

    def answer(
        self, future: Any, server: str, is_served: Callable[[], bool], timeout: float | None = None
    ) -> Any:
        """Handle callbacks until a server has answered; return its answer.

        Args:
            future: The answer to come.
            server: Name of the server for the error, for example ``service '/spawn'``.
            is_served: Whether it is still there; asked at every change of the graph.
            timeout: Seconds to wait; None waits while the server exists.

        Raises:
            KeyboardInterrupt: At Ctrl-C.
            RuntimeError: The server left without an answer.
            TimeoutError: No answer came within ``timeout`` seconds.
        """
        if not self.wait_for(lambda: future.done() or not is_served(), timeout, future):
            raise TimeoutError(f"no answer within {timeout} s")
        if not future.done():  # its last answer may still be in transit
            with suppress(TimeoutError):
                return self.result(future, _LAST_ANSWER_S)
            raise RuntimeError(f"The server of {server} ended before it answered")
        return future.result()

    def result(self, future: Any, timeout: float | None = None) -> Any:
        """Handle callbacks until a future is done; return its result.

        Raises:
            KeyboardInterrupt: At Ctrl-C.
            TimeoutError: The future was not done within ``timeout`` seconds.
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

    def handle_received(self) -> None:
        """Handle the callbacks of everything that has been received already."""
        import rclpy
        from rclpy.executors import ExternalShutdownException, ShutdownException, TimeoutException

        executor = rclpy.get_global_executor()
        added = executor.add_node(self.node)
        try:
            # The first exception of these means that nothing is left.
            with suppress(TimeoutException, ShutdownException, ExternalShutdownException):
                while True:
                    handler, _, _ = executor.wait_for_ready_callbacks(0)
                    handler()
                    handler.result()
        finally:
            if added:
                executor.remove_node(self.node)

    def get_action_names_and_types(self) -> list[tuple[str, list[str]]]:
        """Return the names and types of all actions."""
        from rclpy.action import get_action_names_and_types

        return get_action_names_and_types(self.node)

    def get_action_client_names_and_types_by_node(
        self, remote_node_name: str, remote_node_namespace: str
    ) -> list[tuple[str, list[str]]]:
        """Return the names and types of the actions that a node may start."""
        from rclpy.action import get_action_client_names_and_types_by_node as ask

        return ask(self.node, remote_node_name, remote_node_namespace)

    def get_action_server_names_and_types_by_node(
        self, remote_node_name: str, remote_node_namespace: str
    ) -> list[tuple[str, list[str]]]:
        """Return the names and types of the actions that a node offers."""
        from rclpy.action import get_action_server_names_and_types_by_node as ask

        return ask(self.node, remote_node_name, remote_node_namespace)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add ``--spin-time`` and ``--use-sim-time``."""
    from ros2cli import arguments
    from ros2cli.discovery import SPIN_ARGUMENTS

    arguments.add_arguments(parser, SPIN_ARGUMENTS)
