"""The node with which a launch calls services and subscribes."""

from __future__ import annotations

import asyncio
import contextlib
import os
import threading
from typing import TYPE_CHECKING, Any, cast

from launch.event_handlers import OnShutdown

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from rclpy.context import Context
    from rclpy.executors import SingleThreadedExecutor
    from rclpy.node import Node

_KEY = "ros_adapter"


class ROSAdapter:
    """A node with its own context and thread, which run from the start to :meth:`shutdown`.

    Args:
        argv: Arguments for its context.
        autostart: Whether to start at once.
    """

    def __init__(self, *, argv: list[str] | None = None, autostart: bool = True) -> None:
        self._argv = ["launch_ros", *(argv or ())]
        self._context: Any = None
        self._node: Any = None
        self._executor: Any = None
        self._thread: threading.Thread | None = None
        if autostart:
            self.start()

    def start(self) -> None:
        """Make the node and spin it.

        Raises:
            RuntimeError: The adapter is already running.
        """
        import rclpy
        from rclpy.context import Context
        from rclpy.executors import SingleThreadedExecutor

        if self._thread is not None:
            raise RuntimeError("Cannot start a ROS adapter that is already running")
        self._context = Context()
        rclpy.init(args=self._argv, context=self._context)
        self._node = rclpy.create_node(f"launch_ros_{os.getpid()}", context=self._context)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        self._thread = threading.Thread(target=self._spin, name="launch_ros", daemon=True)
        self._thread.start()

    @property
    def argv(self) -> list[str]:
        """Arguments of its context."""
        return self._argv

    @property
    def ros_context(self) -> Context | None:
        """The context; None before the start."""
        return cast("Context | None", self._context)

    @property
    def ros_node(self) -> Node:
        """The node; None before the start."""
        return cast("Node", self._node)

    @property
    def ros_executor(self) -> SingleThreadedExecutor | None:
        """The executor; None before the start."""
        return cast("SingleThreadedExecutor | None", self._executor)

    @property
    def has_ended(self) -> bool:
        """True when no thread spins the executor."""
        return self._thread is None

    def _spin(self) -> None:
        from rclpy.executors import ExternalShutdownException, ShutdownException

        with contextlib.suppress(ExternalShutdownException, ShutdownException):
            self._executor.spin()

    def shutdown(self) -> None:
        """End node and thread; this also ends the waits for services.

        Raises:
            RuntimeError: The adapter is not running.
        """
        if self._thread is None:
            raise RuntimeError("Cannot shutdown a ROS adapter that is not running")
        self._executor.shutdown()
        # Also ends the waits in `_ask`, which run on other threads.
        self._context.try_shutdown()
        self._thread.join()
        self._thread = None
        self._node.destroy_node()


def get_ros_adapter(context: LaunchContext) -> ROSAdapter:
    """Return the adapter of a launch. The first call of a run makes it; it ends with the run."""
    adapter: ROSAdapter | None = context.get_locals_as_dict().get(_KEY)
    if adapter is None or (adapter.has_ended and not context.is_shutdown):
        made = adapter = ROSAdapter()
        context.extend_globals({_KEY: adapter})
        # Appended, because other handlers may still cancel timers of the node. Handled once,
        # because a second required process may end, and shut down again, during the shutdown.
        end = OnShutdown(on_shutdown=lambda *_: made.shutdown(), handle_once=True)
        context.register_event_handler(end, append=True)
    return adapter


def get_ros_node(context: LaunchContext) -> Node:
    """Return the node of the adapter of a launch."""
    return get_ros_adapter(context).ros_node


async def call_service(context: LaunchContext, service_type: Any, name: str, request: Any) -> Any:
    """Call a service as soon as it is ready.

    Returns:
        The response; None when the launch ended before.
    """
    node = get_ros_node(context)
    # On a thread, because waiting for a service blocks.
    return await asyncio.get_running_loop().run_in_executor(
        None, _ask, node, service_type, name, request
    )


def _ask(node: Node, service_type: Any, name: str, request: Any) -> Any:
    from rclpy._rclpy_pybind11 import RCLError

    # Set by the response and by the end of the launch, whichever comes first.
    ended = threading.Event()
    node.context.on_shutdown(ended.set)
    try:
        client = node.create_client(service_type, name)
        client.wait_for_service()
        future = client.call_async(request)
    except RCLError:  # the launch has ended
        return None
    future.add_done_callback(lambda _: ended.set())
    ended.wait()
    if not future.done():
        return None
    node.destroy_client(client)
    return future.result()
