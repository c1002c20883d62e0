"""Checks of the arguments that make endpoints, and the full names of endpoints."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from rclpy._rclpy_pybind11 import RCLError
from rclpy.exceptions import InvalidServiceNameException, InvalidTopicNameException
from rclpy.expand_topic_name import expand_topic_name
from rclpy.impl.hints import described, with_hint
from rclpy.qos import QoSProfile
from turtlewire.errors import WireError
from turtlewire.wire import names

if TYPE_CHECKING:
    from rclpy._node.state import NodeState
    from rclpy.context import Context

_INVALID = "rcl node's context is invalid"


def check_callable(callback: Any, *words: object) -> None:
    """Make sure that a callback can be called; TypeError with a hint if it cannot.

    Args:
        callback: The callback.
        *words: Arguments of the error, if they are not Python's.
    """
    if not callable(callback):
        words = words or (f"'{type(callback).__name__}' object is not callable",)
        raise with_hint(
            TypeError(*words),
            "Pass the function itself (self.callback), not what it returns (self.callback())",
        )


def check_valid(context: Context, failure: str) -> None:
    """Raise RCLError, with the text of what failed, if a context has ended, also by a signal."""
    if not context.ok():
        raise RCLError(f"{failure}: {_INVALID}")


def check_open(context: Context, what: str) -> None:
    """Raise RCLError if a timer or guard condition is made in a context that is shut down."""
    if not context.is_open():
        raise RCLError(
            f"failed to create {what}: the given context is not valid, either rcl_init() was not "
            "called or rcl_shutdown() was called."
        )


@contextmanager
def in_open_context(context: Context, what: str) -> Iterator[None]:
    """Let the block make an endpoint if the context is open.

    Raises:
        RCLError: The context is shut down, possibly by another thread during the block.
    """
    failed = "Failed" if what in {"publisher", "subscription"} else "failed"  # as in ROS 2
    closed = RCLError(f"{failed} to create {what}: {_INVALID}")
    if not context.is_open():
        raise closed
    try:
        yield
    except WireError:
        # Another thread may have shut the context down after the first look; any other error is the
        # middleware's own.
        if context.is_open():
            raise
        raise closed from None


def validate_qos(qos_or_depth: QoSProfile | int) -> QoSProfile:
    """Return a profile as it is, a depth as the default profile with that depth.

    Raises:
        TypeError: The argument is neither.
        ValueError: The depth is negative.
    """
    if isinstance(qos_or_depth, QoSProfile):
        return qos_or_depth
    if isinstance(qos_or_depth, int):
        if qos_or_depth < 0:
            raise ValueError("history depth must be greater than or equal to zero")
        return QoSProfile(depth=qos_or_depth)
    raise TypeError(f"Expected QoSProfile or int, but received {type(qos_or_depth)!r}")


class NameResolver:
    """Makes full names of what a program gives as names."""

    def __init__(self, core: NodeState) -> None:
        self._core = core

    def resolve_topic(self, topic: str, *, only_expand: bool = False) -> str:
        """Return the fully qualified name of a topic, remapped unless ``only_expand``.

        Raises:
            InvalidTopicNameException: The name breaks the rules.
            ValueError: The name has an unknown substitution.
        """
        expanded = self._expand(topic, InvalidTopicNameException)
        if only_expand:
            return expanded
        return self._core.arguments.remap_topic(expanded, self._core.name, self._core.namespace)

    def resolve_service(self, service: str, *, only_expand: bool = False) -> str:
        """Return the fully qualified name of a service, remapped unless ``only_expand``.

        Raises:
            InvalidServiceNameException: The name breaks the rules.
            ValueError: The name has an unknown substitution.
        """
        expanded = self._expand(service, InvalidServiceNameException)
        if only_expand:
            return expanded
        return self._core.arguments.remap_service(expanded, self._core.name, self._core.namespace)

    def _expand(
        self, name: str, error: type[InvalidTopicNameException | InvalidServiceNameException]
    ) -> str:
        if not isinstance(name, str):
            raise TypeError(f"The name of a topic or service is a str, not {described(name)}")
        fault = names.validate_topic_name(name)
        if fault is not None:
            raise error(name, fault.message, fault.invalid_index)
        expanded = expand_topic_name(name, self._core.name, self._core.namespace)
        # Substitutions can make a valid name invalid; the error then shows the expanded name.
        fault = names.validate_full_topic_name(expanded)
        if fault is not None:
            raise error(expanded, fault.message, fault.invalid_index)
        return expanded
