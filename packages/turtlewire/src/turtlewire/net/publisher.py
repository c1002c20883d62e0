"""Messages out."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from turtlewire import msg
from turtlewire.call_errors import explain_calls, near_name
from turtlewire.tf.datetimes import as_nanoseconds

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlewire.tf.datetimes import Span
    from turtlewire.wire import base

__all__ = ["Publisher"]


@explain_calls
class Publisher:
    """Publishes messages of one type on one topic. Thread-safe.

    Attributes:
        topic: Its fully qualified name.
        type: The class of its messages.
    """

    def __init__(
        self,
        publisher: base.Publisher,
        graph: base.Graph,
        message_type: type[msg.Message],
        on_close: Callable[[Publisher], None],
    ) -> None:
        self._publisher = publisher
        self._graph = graph
        self._on_close = on_close
        self.topic: str = publisher.topic
        self.type = message_type

    def publish(self, message: msg.Message | None = None, /, **fields: Any) -> None:
        """Send a message, or one with these fields.

        Raises:
            TypeError: The message has another type or no such field, or both kinds of arguments
                are given.
            CdrError: A field cannot hold its value.
            WireError: The connection is closed.
        """
        if message is None:
            self._check_fields(fields)
            message = self.type(**fields)
        elif fields:
            raise TypeError("publish() takes a message or fields, not both")
        if not isinstance(message, self.type):
            wrong: object = message
            given = type(wrong).__name__
            if isinstance(wrong, type):
                given = f"the class {wrong.__name__}"
            raise TypeError(
                f"{self.topic} has the type {msg.type_name(self.type)}, but publish() was called "
                f"with {given}; its fields can be given by name: {', '.join(self._field_names())}"
            )
        self._publisher.publish(msg.serialize(message))

    def _field_names(self) -> list[str]:
        return list(self.type.get_fields_and_field_types())

    def _check_fields(self, fields: dict[str, Any]) -> None:
        known = self._field_names()
        for name in fields:
            if name not in known:
                near = near_name(name, known)
                advice = f"did you mean '{near}'?" if near else f"it has {', '.join(known)}"
                raise TypeError(f"{msg.type_name(self.type)} has no field '{name}'; {advice}")

    def wait_for_subscribers(self, count: int = 1, *, timeout_ns: Span | None = None) -> bool:
        """Block until this many subscriptions are matched.

        Args:
            count: How many.
            timeout_ns: How long to wait at most; None waits without limit.

        Returns:
            False if the time was over before.
        """
        limit = None if timeout_ns is None else as_nanoseconds(timeout_ns, "timeout_ns")
        return self._graph.wait_for(lambda: self._publisher.subscription_count() >= count, limit)

    def close(self) -> None:
        """Leave the topic. Idempotent."""
        self._publisher.close()
        self._on_close(self)
