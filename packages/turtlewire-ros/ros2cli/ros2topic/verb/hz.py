"""The class of ``ros2 topic hz``, and the rate of topics for other programs."""

from __future__ import annotations

import threading
import time
from typing import TYPE_CHECKING, Any

from ros2cli.builtin import BuiltinVerb
from ros2cli.commands.topic.hz import main
from ros2cli.commands.topic.statistics import rate_text, spread
from ros2topic.verb import VerbExtension

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["DEFAULT_WINDOW_SIZE", "HzVerb", "ROSTopicHz", "main"]

DEFAULT_WINDOW_SIZE = 10000


class HzVerb(BuiltinVerb, VerbExtension):
    """Show the rate of a topic."""

    _module = "topic.hz"


class _Arrivals:
    """When the messages of one topic came, in nanoseconds of the clock."""

    def __init__(self) -> None:
        self.times: list[int] = []  # between two messages each
        self.msg_t0 = -1
        self.msg_tn = 0
        self.last_printed_tn = 0


class ROSTopicHz:
    """The rates of topics; `callback_hz` is a callback of their subscriptions.

    Each method takes the name of the topic; a program with one topic leaves it out. All times are
    nanoseconds. It may be used by several threads.

    Args:
        node: The node whose clock counts.
        window_size: How many messages count.
        filter_expr: Says which messages count; None for all.
        use_wtime: Whether the wall clock counts.
    """

    def __init__(
        self,
        node: Any,
        window_size: int,
        filter_expr: Callable[[Any], bool] | None = None,
        use_wtime: bool = False,
    ) -> None:
        self.lock = threading.Lock()
        self.window_size = window_size
        self.filter_expr = filter_expr
        self.use_wtime = use_wtime
        self._clock = node.get_clock()
        self._of: dict[str | None, _Arrivals] = {}

    def _arrivals(self, topic: str | None) -> _Arrivals:
        return self._of.setdefault(topic, _Arrivals())

    def get_last_printed_tn(self, topic: str | None = None) -> int:
        """Return the last message's time at the last `get_hz`."""
        return self._arrivals(topic).last_printed_tn

    def set_last_printed_tn(self, value: int, topic: str | None = None) -> None:
        """Set `get_last_printed_tn`."""
        self._arrivals(topic).last_printed_tn = value

    def get_msg_t0(self, topic: str | None = None) -> int:
        """Return the first message's time; -1 before it."""
        return self._arrivals(topic).msg_t0

    def set_msg_t0(self, value: int, topic: str | None = None) -> None:
        """Set `get_msg_t0`."""
        self._arrivals(topic).msg_t0 = value

    def get_msg_tn(self, topic: str | None = None) -> int:
        """Return the last message's time; 0 before the first."""
        return self._arrivals(topic).msg_tn

    def set_msg_tn(self, value: int, topic: str | None = None) -> None:
        """Set `get_msg_tn`."""
        self._arrivals(topic).msg_tn = value

    def get_times(self, topic: str | None = None) -> list[int]:
        """Times between the messages."""
        return self._arrivals(topic).times

    def set_times(self, value: list[int], topic: str | None = None) -> None:
        """Set `get_times`."""
        self._arrivals(topic).times = value

    def callback_hz(self, m: Any, topic: str | None = None) -> None:
        """Note a message; simulated time that begins anew forgets those before."""
        if self.filter_expr is not None and not self.filter_expr(m):
            return
        now = time.time_ns() if self.use_wtime else self._clock.now().nanoseconds
        with self.lock:
            arrivals = self._arrivals(topic)
            if arrivals.msg_t0 < 0 or now < arrivals.msg_tn:
                arrivals.msg_t0 = now
                arrivals.times = []
            else:
                arrivals.times.append(now - arrivals.msg_tn)
                del arrivals.times[: 1 - self.window_size or None]
            arrivals.msg_tn = now

    def get_hz(self, topic: str | None = None) -> tuple[float, int, int, float, int] | None:
        """Rate [1/ns], shortest and longest time, their deviation, and how many times count.

        Returns:
            None if no message came since the last call, or only one.
        """
        with self.lock:
            arrivals = self._arrivals(topic)
            if not arrivals.times or arrivals.msg_tn == arrivals.last_printed_tn:
                return None
            arrivals.last_printed_tn = arrivals.msg_tn
            times = list(arrivals.times)
        mean, deviation = spread(times)
        return (1.0 / mean if mean > 0 else 0.0), min(times), max(times), deviation, len(times)

    def print_hz(self, topic: str | None = None) -> None:
        """Print the rate, if messages came since the last call."""
        found = self.get_hz(topic)
        if found is not None:
            rate, shortest, longest, deviation, count = found
            seconds = (shortest / 1e9, longest / 1e9, deviation / 1e9)
            print(rate_text(rate * 1e9, *seconds, count + 1), end="")
