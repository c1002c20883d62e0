"""The ``/rosout`` publisher of a node.

It sends the node's log records as ``rcl_interfaces/msg/Log``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.impl import log_output
from rclpy.type_support import type_id
from turtlewire import msg
from turtlewire.errors import WireError

if TYPE_CHECKING:
    from rclpy.impl.log_output import LogRecord
    from turtlewire.wire import base
    from turtlewire.wire.qos import QoS

_TYPE = "rcl_interfaces/msg/Log"


class RosoutPublisher:
    """Publishes what the logger ``logger_name`` and its children log. Thread-safe."""

    def __init__(self, wire_node: base.Node, logger_name: str, qos: QoS) -> None:
        self._wire = wire_node.create_publisher("/rosout", type_id(_TYPE), qos)
        self._logger_name = logger_name
        self._message_types: tuple[Any, Any] | None = None
        log_output.add_rosout_sink(logger_name, self._publish)

    def _publish(self, record: LogRecord) -> None:
        # At the first record: a program that never logs need not read the definitions.
        if self._message_types is None:
            self._message_types = (
                msg.get_message(_TYPE),
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
            log_output.remove_rosout_sink(self._logger_name)

    def close(self) -> None:
        """Publish no further records. Idempotent."""
        log_output.remove_rosout_sink(self._logger_name)
        self._wire.close()
