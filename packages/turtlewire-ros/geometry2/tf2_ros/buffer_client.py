"""Lookups in the buffer of another process."""

from __future__ import annotations

import threading
import time
import warnings
from typing import TYPE_CHECKING, Any

from rclpy.action import ActionClient
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time
from tf2_msgs.action import LookupTransform
from tf2_msgs.msg import TF2Error
from tf2_py.messages import to_nanoseconds
from turtlewire.distro import LYRICAL, since
from turtlewire.errors import TimeoutException, TransformException

from .buffer_interface import NO_TIMEOUT, BufferInterface
from .buffer_server import exception_for
from .transform_listener import spin_in_thread

if TYPE_CHECKING:
    from geometry_msgs.msg import TransformStamped
    from rclpy.task import Future

# `STATUS_SUCCEEDED` of action_msgs.
_SUCCEEDED = 4
_NOT_READY = "The BufferServer is not ready."
_WRONG = "Something is likely wrong with the server."
_NOT_BACK = (
    "The LookupTransform goal sent to the BufferServer did not come back in the specified time. "
    + _WRONG
)
_NOT_ACCEPTED = (
    "The LookupTransform goal sent to the BufferServer did not come back with accepted status. "
    + _WRONG
)
_GONE = "The BufferServer left the graph before it answered."
_NO_RESULT = f"The BufferServer returned None for result or result.error!  {_WRONG}"


class BufferClient(BufferInterface):
    """A buffer interface whose lookups a :class:`~tf2_ros.BufferServer` answers. Thread-safe.

    The client has its own node and thread, so that a lookup works in any callback, whether
    or not the user's node is being spun.

    Args:
        node: The client takes its context and namespace.
        ns: Name of the server's action.
        check_frequency: Has no effect: the client waits for answers instead of polling.
        timeout_padding: How much longer than the lookup's own timeout to wait for the server.
    """

    def __init__(
        self,
        node: Node,
        ns: str,
        check_frequency: float | None = 10.0,  # noqa: ARG002 -- ROS 2's signature
        timeout_padding: Duration | float = Duration(seconds=2.0),  # noqa: B008 -- never changed
    ) -> None:
        super().__init__()
        padding = (
            timeout_padding
            if isinstance(timeout_padding, Duration)
            else Duration(seconds=timeout_padding)
        )
        self.timeout_padding = padding
        self.node = node
        self._node = Node(
            f"_{node.get_name()}_buffer_client",
            context=node.context,
            namespace=node.get_namespace(),
            # The command line's rules are for the user's nodes.
            use_global_arguments=False,
            enable_rosout=False,
            start_parameter_services=False,
        )
        self._action = node.resolve_topic_name(ns)
        self.action_client = ActionClient(self._node, LookupTransform, self._action)
        self._executor, self._thread = spin_in_thread(self._node, "buffer-client")

    def destroy(self) -> bool:
        """End the thread and leave the graph.

        If the server was killed, the middleware waits up to a second for it to acknowledge the last
        request.
        """
        # First, so that no callback uses what is destroyed below.
        self._executor.shutdown()
        self._thread.join()
        self.action_client.destroy()
        self._node.destroy_node()
        return True

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Time, timeout: Duration | Any = NO_TIMEOUT
    ) -> TransformStamped:
        """The server's transform that takes data from ``source_frame`` into ``target_frame``.

        Args:
            target_frame: The frame in which the answer is expressed.
            source_frame: The frame whose pose is asked for.
            time: The time of the transform.
            timeout: How long the server may wait for the data.

        Raises:
            TimeoutException: The server does not exist or does not answer.
            TransformException: The lookup failed on the server.
            TypeError: ``time`` is not a time.
        """
        goal = LookupTransform.Goal(
            target_frame=target_frame,
            source_frame=source_frame,
            source_time=_message(time),
            timeout=_duration(timeout),
            advanced=False,
        )
        return self._ask(goal, timeout)

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
        timeout: Duration | Any = NO_TIMEOUT,
    ) -> TransformStamped:
        """Return the server's transform from one frame and time into another frame and time.

        Raises:
            TransformException: As :meth:`lookup_transform`.
        """
        goal = LookupTransform.Goal(
            target_frame=target_frame,
            source_frame=source_frame,
            source_time=_message(source_time),
            timeout=_duration(timeout),
            target_time=_message(target_time),
            fixed_frame=fixed_frame,
            advanced=True,
        )
        return self._ask(goal, timeout)

    def can_transform(
        self, target_frame: str, source_frame: str, time: Time, timeout: Duration | Any = NO_TIMEOUT
    ) -> bool:
        """Return True if :meth:`lookup_transform` succeeds."""
        try:
            self.lookup_transform(target_frame, source_frame, time, timeout)
        except TransformException:
            return False
        return True

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
        timeout: Duration | Any = NO_TIMEOUT,
    ) -> bool:
        """Return True if :meth:`lookup_transform_full` succeeds."""
        try:
            self.lookup_transform_full(
                target_frame, target_time, source_frame, source_time, fixed_frame, timeout
            )
        except TransformException:
            return False
        return True

    def _ask(self, goal: Any, timeout: Duration | Any) -> TransformStamped:
        timeout_s = to_nanoseconds(timeout, "duration") / 1e9
        if not self.action_client.wait_for_server(timeout_sec=timeout_s):
            raise TimeoutException(_NOT_READY)
        # Before the request: a server that leaves later cannot answer it.
        limit, servers = timeout_s + self.timeout_padding.nanoseconds / 1e9, self._servers()
        handle = self._wait(self.action_client.send_goal_async(goal), limit, servers)
        if not handle.accepted:
            raise TimeoutException(_NOT_ACCEPTED)
        try:
            response = self._wait(handle.get_result_async(), limit, servers)
        except TimeoutException:
            # The server can stop waiting.
            handle.cancel_goal_async()
            raise
        return _transform(response)

    def _servers(self) -> set[bytes]:
        # Each action server publishes the status, so its publisher identifies the server.
        return {
            bytes(each.endpoint_gid)
            for each in self._node.get_publishers_info_by_topic(f"{self._action}/_action/status")
        }

    def _wait(self, future: Future, seconds: float, servers: set[bytes]) -> Any:
        """Return the result of a future.

        Raises:
            TimeoutException: The timeout has passed, or one of the servers has left the graph.
        """
        until, news = time.monotonic() + seconds, threading.Event()
        future.add_done_callback(lambda _future: news.set())
        # Also woken by changes of the graph, to notice that the server has left.
        stop_listening = self._node.context.wire.graph.add_listener(news.set)
        try:
            while not future.done():
                if not servers <= self._servers():
                    raise TimeoutException(_GONE)
                if not news.wait(max(0.0, until - time.monotonic())):
                    raise TimeoutException(_NOT_BACK)
                news.clear()
        finally:
            stop_listening()
        return future.result()


def _transform(response: Any) -> TransformStamped:
    """Return the transform of a response.

    Raises:
        TransformException: The response is an error.
    """
    result = response.result
    if result is None or result.error is None:
        raise TransformException(_NO_RESULT)
    if result.error.error != TF2Error.NO_ERROR:
        raise exception_for(result.error)
    # A C++ server of ROS 2 reports a timeout by the status alone.
    if response.status != _SUCCEEDED:
        raise TimeoutException("The BufferServer gave up: the transform was not available in time.")
    transform: TransformStamped = result.transform
    return transform


def _message(time: Time | Any) -> Any:
    """Return a time as message.

    Raises:
        TypeError: ``time`` is not a time; in Lyrical, it is a message.
    """
    if isinstance(time, Time):
        return time.to_msg()
    if hasattr(time, "sec") and hasattr(time, "nanosec") and not since(LYRICAL):
        # The warning points at the user's call.
        warnings.warn(
            "Passing a builtin_interfaces.msg.Time is deprecated, pass a rclpy.time.Time object.",
            UserWarning,
            stacklevel=3,
        )
        return time
    raise TypeError("Must pass a rclpy.time.Time object.")


def _duration(duration: Duration | Any) -> Any:
    return Duration(nanoseconds=to_nanoseconds(duration, "duration")).to_msg()
