"""``ros2 topic hz``."""

from __future__ import annotations

import functools
import math
import statistics
import threading
import time
from typing import TYPE_CHECKING, Any

from ros2cli.arguments import argument
from ros2cli.builtin import verb_of_module
from ros2cli.completion import topic_names
from ros2cli.discovery import SPIN_ARGUMENTS
from ros2cli.values import positive_int
from ros2topic.verb import VerbExtension

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable, Collection

__all__ = ["ARGUMENTS", "DEFAULT_WINDOW_SIZE", "HzVerb", "ROSTopicHz", "main", "spread"]

DEFAULT_WINDOW_SIZE = 10000

ARGUMENTS = (
    argument("topic_name", help="Name of the topic, for example /tf", completer=topic_names),
    argument(
        "-w",
        "--window",
        metavar="WINDOW",
        type=positive_int,
        default=DEFAULT_WINDOW_SIZE,
        help="How many messages count",
    ),
    argument(
        "--filter",
        dest="filter_expr",
        metavar="EXPR",
        help="Only messages m for which this Python expression is true",
    ),
    argument("--wall-time", action="store_true", help="Use the wall clock with simulated time too"),
    *SPIN_ARGUMENTS,
)


def main(args: argparse.Namespace) -> None:
    """Print the rate every second, while messages come."""
    from rclpy.qos import qos_profile_sensor_data
    from ros2cli.node.direct import DirectNode
    from ros2topic.api import type_of_topic
    from ros2topic.verb.echo import make_filter

    keep = make_filter(args.filter_expr)
    with DirectNode(args) as direct:
        topic = direct.node.resolve_topic_name(args.topic_name)
        kind = type_of_topic(direct, topic, blocking=True)
        wall_time = args.wall_time or not args.use_sim_time
        hz = ROSTopicHz(direct.node, args.window, keep, wall_time)
        direct.node.create_subscription(
            kind,
            topic,
            functools.partial(hz.callback_hz, topic=topic),
            qos_profile_sensor_data,
            raw=keep is None,
        )
        direct.node.create_timer(1.0, functools.partial(hz.print_hz, topic))
        direct.spin()


def spread(values: Collection[float]) -> tuple[float, float]:
    """Return mean and standard deviation."""
    mean = statistics.fmean(values)
    return mean, math.sqrt(statistics.fmean((value - mean) ** 2 for value in values))


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
        # A steady clock that reads as the wall clock does: NTP's corrections are not intervals.
        self._wall_offset_ns = time.time_ns() - time.monotonic_ns()
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

    def _now_ns(self) -> int:
        if self.use_wtime:
            return time.monotonic_ns() + self._wall_offset_ns
        now: int = self._clock.now().nanoseconds
        return now

    def callback_hz(self, m: Any, topic: str | None = None) -> None:
        """Record a message. When simulated time restarts, earlier messages are forgotten."""
        if self.filter_expr is not None and not self.filter_expr(m):
            return
        now = self._now_ns()
        with self.lock:
            arrivals = self._arrivals(topic)
            if arrivals.msg_t0 < 0 or now < arrivals.msg_tn:
                arrivals.msg_t0 = now
                arrivals.times = []
            else:
                arrivals.times.append(now - arrivals.msg_tn)
                del arrivals.times[: -max(self.window_size - 1, 1)]
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
            print(
                f"average rate: {rate * 1e9:.3f}\n"
                f"\tmin: {shortest / 1e9:.3f}s max: {longest / 1e9:.3f}s"
                f" std dev: {deviation / 1e9:.5f}s window: {count + 1}"
            )


@verb_of_module
class HzVerb(VerbExtension):
    """Show the rate of a topic."""
