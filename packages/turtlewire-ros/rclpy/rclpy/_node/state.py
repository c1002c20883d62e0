"""The state of a node that its endpoints, parameters and services share, and its ``/rosout``."""

from __future__ import annotations

import weakref
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any

from rclpy._rclpy_pybind11 import InvalidHandle
from rclpy.impl import log_output
from rclpy.logging import get_logger
from rclpy.type_support import type_id
from turtlewire import msg
from turtlewire.errors import WireError
from turtlewire.wire import names

if TYPE_CHECKING:
    from rclpy.context import Context
    from rclpy.impl.arguments import Arguments
    from rclpy.impl.log_output import LogRecord
    from rclpy.impl.rcutils_logger import RcutilsLogger
    from turtlewire.wire import base
    from turtlewire.wire.qos import QoS

_LOG_TYPE = "rcl_interfaces/msg/Log"


class NodeState:
    """Names, context, logger, command line and the middleware's side of a node.

    The node leaves the graph with :meth:`close`, or when neither the node nor an endpoint of it is
    referred to any more: a publisher works as long as the program keeps it, as in ROS 2.

    Attributes:
        context: Its context.
        name: Base name, after remapping.
        namespace: Namespace, after remapping.
        full_name: Namespace and name, for example ``/robot1/camera``.
        arguments: Its command line.
        logger: Its logger, named like the node with dots for slashes.
        before_leaving: What to call before the node leaves the graph. None of it may refer to the
            core, which would live as long.
    """

    def __init__(
        self,
        context: Context,
        name: str,
        namespace: str,
        arguments: Arguments,
        *,
        rosout_qos: QoS | None,
    ) -> None:
        self.context = context
        self.name = name
        self.namespace = namespace
        self.full_name = names.fully_qualified_node_name(name, namespace)
        self.arguments = arguments
        self.logger: RcutilsLogger = get_logger(self.full_name[1:].replace("/", "."))
        self._wire = context.wire.create_node(name, namespace)
        rosout = (
            None
            if rosout_qos is None
            else RosoutPublisher(self._wire, self.logger.name, rosout_qos)
        )
        self.before_leaving: dict[Callable[[], None], None] = {}
        # Refers to the wire node instead of this object, which the finalizer must not keep alive.
        leave = partial(_leave, self._wire, rosout, self.before_leaving)
        self._end = weakref.finalize(self, _leave_later, context.wire, leave, rosout)
        self._end.atexit = False  # the node ends with its context
        self._leave = leave

    @property
    def wire(self) -> base.Node:
        """The middleware's side of it; raises ``InvalidHandle`` after :meth:`close`."""
        return self.checked()._wire

    def checked(self) -> NodeState:
        """Return itself; raise ``InvalidHandle`` after :meth:`close`."""
        if not self._end.alive:
            raise InvalidHandle("cannot use Destroyable because destruction was requested")
        return self

    def close(self) -> None:
        """Leave the graph, with all endpoints. Idempotent."""
        # None after an earlier call.
        if self._end.detach() is not None:
            self._leave()


def _leave(
    wire: base.Node, rosout: RosoutPublisher | None, before: dict[Callable[[], None], None]
) -> None:
    for call in list(before):
        call()
    if rosout is not None:
        rosout.close()
    wire.close()


def _leave_later(
    context: base.Context, leave: partial[None], rosout: RosoutPublisher | None
) -> None:
    """Leave on another thread: the garbage collector runs anywhere, with any lock held."""
    # At once: a closed context calls nothing, and the next node may have the same name.
    if rosout is not None:
        rosout.forget()
    context.call_soon(leave)


class RosoutPublisher:
    """Publishes what the logger ``logger_name`` and its children log. Thread-safe.

    The messages are ``rcl_interfaces/msg/Log``.
    """

    def __init__(self, wire_node: base.Node, logger_name: str, qos: QoS) -> None:
        self._wire = wire_node.create_publisher("/rosout", type_id(_LOG_TYPE), qos)
        self._logger_name = logger_name
        self._message_types: tuple[Any, Any] | None = None
        log_output.add_rosout_sink(logger_name, self._publish)

    def _publish(self, record: LogRecord) -> None:
        # At the first record: a program that never logs need not read the definitions.
        if self._message_types is None:
            self._message_types = (
                msg.get_message(_LOG_TYPE),
                msg.get_message("builtin_interfaces/msg/Time"),
            )
        log_type, time_type = self._message_types
        seconds, nanoseconds = divmod(record.stamp_ns, 1_000_000_000)
        log = log_type(
            stamp=time_type(sec=seconds, nanosec=nanoseconds),
            level=int(record.severity),
            name=record.name,
            msg=record.message,
            file=record.file_name,
            function=record.function_name,
            line=record.line_number,
        )
        try:
            self._wire.publish(msg.serialize(log))
        except WireError:
            # The context is gone; the console still has the line.
            self.forget()

    def forget(self) -> None:
        """Publish no further records. Idempotent."""
        log_output.remove_rosout_sink(self._logger_name, self._publish)

    def close(self) -> None:
        """Publish no further records, and leave the topic. Idempotent."""
        self.forget()
        self._wire.close()
