"""The class of ``ros2 topic delay``, and the delay of a topic for other programs."""

from __future__ import annotations

import threading
from typing import Any

from ros2cli.builtin import BuiltinVerb
from ros2cli.commands.topic.delay import age, main
from ros2cli.commands.topic.statistics import Delays
from ros2topic.verb import VerbExtension

__all__ = ["DEFAULT_WINDOW_SIZE", "DelayVerb", "ROSTopicDelay", "main"]

DEFAULT_WINDOW_SIZE = 10000


class DelayVerb(BuiltinVerb, VerbExtension):
    """Show the delay of a topic, by the stamps in its headers."""

    _module = "topic.delay"


class ROSTopicDelay:
    """The delay of a topic; `callback_delay` is the callback of its subscription.

    Args:
        node: The node whose clock counts.
        window_size: How many messages count.
    """

    def __init__(self, node: Any, window_size: int) -> None:
        self.lock = threading.Lock()
        self.window_size = window_size
        self._clock = node.get_clock()
        self._delays = Delays(window_size)

    def callback_delay(self, msg: Any) -> None:
        """Note a message.

        Raises:
            RuntimeError: It has no header.
        """
        if not hasattr(msg, "header"):
            raise RuntimeError("msg does not have header")
        with self.lock:
            self._delays.add(age(msg, self._clock))

    def get_delay(self) -> tuple[float, float, float, float, int] | None:
        """Mean, minimum, maximum and deviation of the delay [s], and how many messages count.

        Returns:
            None if no message came since the last call.
        """
        with self.lock:
            return self._delays.summary() if self._delays.is_new else None

    def print_delay(self) -> None:
        """Print the delay, if messages came since the last call."""
        with self.lock:
            print(self._delays.report(), end="")
