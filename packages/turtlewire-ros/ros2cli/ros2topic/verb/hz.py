"""``ros2 topic hz``."""

from __future__ import annotations

import argparse
import functools
import math
import statistics
import threading
import time
from collections.abc import Callable, Collection, Sequence
from typing import TYPE_CHECKING, Any

from ros2cli.arguments import argument, positive_int
from ros2cli.discovery import SPIN_ARGUMENTS
from ros2cli.json_lines import JSON_ARGUMENT, print_json
from ros2cli.output import clear_terminal
from ros2topic.several import SEVERAL_TOPICS, choose, print_table, refused, subscribe
from ros2topic.verb import VerbExtension
from turtlewire.distro import KILTED, since

DEFAULT_WINDOW_SIZE = 10000

_COLUMNS = ("topic", "rate", "min_delta", "max_delta", "std_dev", "window")

ARGUMENTS = (
    *SEVERAL_TOPICS,
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
    JSON_ARGUMENT,
)


def main(args: argparse.Namespace) -> str | None:
    """Print the rates every second, while messages come."""
    from ros2cli.node.direct import DirectNode
    from ros2topic.verb.echo import make_filter

    if told := refused(args):
        return told
    keep = make_filter(args.filter_expr)
    topics: list[str] = []
    with DirectNode(args) as direct:
        if not choose(direct, args, "hz"):
            return None
        hz = ROSTopicHz(direct.node, args.window, keep, args.wall_time or not args.use_sim_time)
        # Before the subscriptions, because a topic may have to be waited for.
        direct.node.create_timer(
            1.0, lambda: hz.print_json(topics) if args.json else hz.print_hz(topics, args.all)
        )
        subscribe(
            direct,
            args,
            topics,
            lambda topic: functools.partial(hz.callback_hz, topic=topic),
            # Undecoded, unless a filter needs the fields.
            raw=keep is None,
        )
        direct.spin()
    return None


def spread(values: Collection[float]) -> tuple[float, float]:
    """Return mean and standard deviation."""
    mean = statistics.fmean(values)
    return mean, math.sqrt(statistics.fmean((value - mean) ** 2 for value in values))


class _Arrivals:
    """The arrival times of the messages of one topic, in nanoseconds of the clock."""

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
        """Return the times between the messages."""
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
                # A window of n messages has n - 1 intervals.
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

    def print_hz(
        self, topics: str | Sequence[str] | None = None, clear_screen: bool = False
    ) -> None:
        """Print the rates of topics, if messages came since the last call.

        Args:
            topics: The topic, or several, which are shown as a table; ``topic`` in Jazzy.
            clear_screen: Whether the terminal is cleared first.
        """
        names = [topics] if topics is None or isinstance(topics, str) else topics
        found = self._news(names)
        if not found:
            return
        if clear_screen:
            clear_terminal()
        shown = [(name, *_texts(*figures)) for name, figures in found]
        if len(names) > 1:
            print_table(_COLUMNS, [[str(cell) for cell in row] for row in shown])
            return
        _, rate, shortest, longest, deviation, window = shown[0]
        print(
            f"average rate: {rate}\n"
            f"\tmin: {shortest}s max: {longest}s std dev: {deviation}s window: {window}"
        )

    if not (TYPE_CHECKING or since(KILTED)):
        __print_hz = print_hz

        def print_hz(
            self, topic: str | Sequence[str] | None = None, clear_screen: bool = False
        ) -> None:
            """Print the rates as Kilted's method does."""
            self.__print_hz(topic, clear_screen)

    def print_json(self, topics: Sequence[str]) -> None:
        """Print a JSON object for each topic that had messages since the last call.

        The rate is in hertz, and the times are in seconds.
        """
        for name, (rate, shortest, longest, deviation, count) in self._news(topics):
            figures = (rate * 1e9, shortest / 1e9, longest / 1e9, deviation / 1e9, count + 1)
            print_json(dict(zip(_COLUMNS, (name, *figures), strict=True)))

    def _news(
        self, topics: Sequence[str | None]
    ) -> list[tuple[str | None, tuple[float, int, int, float, int]]]:
        return [(name, each) for name in topics if (each := self.get_hz(name)) is not None]


def _texts(
    rate: float, shortest: int, longest: int, deviation: float, count: int
) -> tuple[str, ...]:
    return (
        f"{rate * 1e9:.3f}",
        f"{shortest / 1e9:.3f}",
        f"{longest / 1e9:.3f}",
        f"{deviation / 1e9:.5f}",
        str(count + 1),
    )


class HzVerb(VerbExtension, module=__name__):
    """Show the rates of topics."""
