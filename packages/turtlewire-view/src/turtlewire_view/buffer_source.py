"""A buffer as a source: its frames as they change, and messages that do not."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from turtlewire import msg
from turtlewire.errors import TurtlewireError
from turtlewire_view.live import LiveTimeline, newest_stamp_ns
from turtlewire_view.source import Joints, OfflineSource, Topic

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from turtlewire.msg import Message
    from turtlewire.tf.buffer import Buffer

__all__ = ["BufferSource"]

#: The page can go back to the first sample of a buffer.
_ALL_NS = 1 << 62


class BufferSource(OfflineSource):
    """The frames of a buffer. Pages follow its changes, and can go back to all of its samples.

    Args:
        buffer: The frames.
        name: What the page calls it.
        messages: A message of each topic.
    """

    kind = "live"
    _WHAT = "a buffer"
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
        return lambda: None

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

    def close(self) -> None:
        """Stop following the buffer."""
        while self._ends:
            self._ends.pop()()
