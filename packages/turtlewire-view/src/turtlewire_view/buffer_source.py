"""A buffer as a source: its frames as they change, and messages that do not."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from turtlewire import msg
from turtlewire.errors import TurtlewireError
from turtlewire_view.live import LiveTimeline, newest_stamp_ns
from turtlewire_view.source import (
    Joints,
    ParameterAnswer,
    ServiceAnswer,
    ServiceCalls,
    Topic,
    no_service,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from turtlewire.msg import Message
    from turtlewire.tf.buffer import Buffer

__all__ = ["BufferSource"]

#: The page can go back to the first sample of a buffer.
_ALL_NS = 1 << 62


class BufferSource:
    """The frames of a buffer. Pages follow its changes, and can go back to all of its samples.

    Args:
        buffer: The frames.
        name: What the page calls it.
        messages: A message of each topic.
    """

    kind = "live"
    joints: Joints | None = None
    problem = ""
    history_ns = _ALL_NS

    def __init__(
        self, buffer: Buffer, name: str, messages: Mapping[str, Message] | None = None
    ) -> None:
        self.buffer = buffer
        self.name = name
        self._messages = dict(messages or {})
        self._ends: list[Callable[[], None]] = []

    def now_ns(self) -> int:
        """Return the newest stamp; the system time if all transforms are static."""
        newest = newest_stamp_ns(self.buffer)
        return time.time_ns() if newest is None else newest

    def departed_frames(self) -> list[str]:
        """Return no frame: a buffer does not know the graph."""
        return []

    def new_timeline(self) -> LiveTimeline:
        """Return a page's own time, which follows the buffer until the page is paused."""
        return LiveTimeline(self)

    def topics(self) -> list[Topic]:
        """Return the topics of the messages."""
        return [
            Topic(name, msg.type_name(type(message)), 1)
            for name, message in sorted(self._messages.items())
        ]

    def subscribe(
        self,
        topic: str,
        type_name: str,  # noqa: ARG002 - Source's
        on_message: Callable[[bytes], None],
    ) -> Callable[[], None]:
        """Deliver the topic's message at once."""
        if topic in self._messages:
            on_message(msg.serialize(self._messages[topic]))
        return _nothing

    def ask_parameter(
        self, node: str, name: str, on_answer: Callable[[ParameterAnswer], None]
    ) -> Callable[[], None]:
        """Answer at once that a buffer has no parameters."""
        problem = f"a buffer has no parameters, so '{name}' of {node} is not known; use the topic"
        on_answer(ParameterAnswer(problem=problem))
        return _nothing

    def ask_service(
        self, name: str, type_name: str, on_answer: Callable[[ServiceAnswer], None]
    ) -> ServiceCalls:
        """Answer at once that a buffer has no services."""
        del type_name
        return no_service(f"a buffer has no services, so {name} cannot be called", on_answer)

    def advertise(self, topic: str, type_name: str) -> None:
        """Do nothing: a buffer accepts no messages."""

    def publish(self, topic: str, type_name: str, cdr: bytes) -> int:  # noqa: ARG002 - Source's
        """Refused.

        Raises:
            TurtlewireError: Always.
        """
        raise TurtlewireError(
            f"The view shows a buffer, not a network, so nothing was published on {topic}."
        )

    def on_change(self, call: Callable[[], None]) -> None:
        """Call ``call()`` on the threads that write to the buffer."""
        self._ends.append(self.buffer.on_change(call))

    def drop_old_timeline(self) -> None:
        """A buffer belongs to the program, which clears it itself."""

    def close(self) -> None:
        """Stop following the buffer."""
        while self._ends:
            self._ends.pop()()


def _nothing() -> None:
    pass
