"""``ros2 topic bw``."""

from __future__ import annotations

import argparse
import functools
import statistics
import threading
import time
from collections.abc import Callable, Sequence
from typing import Any

from ros2cli.arguments import argument, positive_int
from ros2cli.discovery import SPIN_ARGUMENTS
from ros2cli.json_lines import JSON_ARGUMENT, print_json
from ros2cli.output import clear_terminal
from ros2cli.qos import QOS_ARGUMENTS
from ros2topic.several import SEVERAL_TOPICS, choose, print_table, refused, subscribe
from ros2topic.verb import VerbExtension

DEFAULT_WINDOW_SIZE = 100

_COLUMNS = ("topic", "bandwidth", "window", "mean", "min", "max")

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
    *QOS_ARGUMENTS,
    *SPIN_ARGUMENTS,
    JSON_ARGUMENT,
)


def main(args: argparse.Namespace) -> str | None:
    """Print the bandwidths every second, while messages come."""
    from ros2cli.node.direct import DirectNode

    if told := refused(args):
        return told
    topics: list[str] = []
    with DirectNode(args) as direct:
        if not choose(direct, args, "bw"):
            return None
        bandwidth = ROSTopicBandwidth(direct.node, args.window)

        def callback(topic: str) -> Callable[[bytes], None]:
            if not args.all and not args.json:
                print(f"Subscribed to [{topic}]")
            return functools.partial(bandwidth.callback, topic=topic)

        # Before the subscriptions, because a topic may have to be waited for.
        direct.node.create_timer(
            1.0,
            lambda: (
                bandwidth.print_json(topics) if args.json else bandwidth.print_bw(topics, args.all)
            ),
        )
        subscribe(direct, args, topics, callback, raw=True)
        direct.spin()
    return None


def str_bytes(num_bytes: float) -> str:
    """Return a size as text, for example ``12 B``."""
    return f"{num_bytes:.0f} B"


def str_kilobytes(num_bytes: float) -> str:
    """Return a size as text, for example ``1.23 KB``."""
    return f"{num_bytes / 1e3:.2f} KB"


def str_megabytes(num_bytes: float) -> str:
    """Return a size as text, for example ``1.23 MB``."""
    return f"{num_bytes / 1e6:.2f} MB"


class _Arrivals:
    """The arrival times and sizes of the messages of one topic."""

    def __init__(self) -> None:
        self.times: list[float] = []
        self.sizes: list[int] = []
        self.last_printed_tn = 0.0


class ROSTopicBandwidth:
    """The bandwidths of topics; `callback` is that of their subscriptions, with ``raw=True``.

    Each method takes the name of the topic; a program with one topic leaves it out.

    Args:
        node: Accepted as in ROS 2; a steady clock counts.
        window_size: How many messages count.
    """

    def __init__(self, node: Any, window_size: int) -> None:
        self.lock = threading.Lock()
        self.window_size = window_size
        self._of: dict[str | None, _Arrivals] = {}

    def _arrivals(self, topic: str | None) -> _Arrivals:
        return self._of.setdefault(topic, _Arrivals())

    def get_times(self, topic: str | None = None) -> list[float]:
        """Return when the messages came, in seconds of a steady clock."""
        return self._arrivals(topic).times

    def set_times(self, value: list[float], topic: str | None = None) -> None:
        """Replace when the messages came."""
        self._arrivals(topic).times = value

    def get_sizes(self, topic: str | None = None) -> list[int]:
        """Return the bytes of the messages."""
        return self._arrivals(topic).sizes

    def set_sizes(self, value: list[int], topic: str | None = None) -> None:
        """Replace the bytes of the messages."""
        self._arrivals(topic).sizes = value

    def get_last_printed_tn(self, topic: str | None = None) -> float:
        """Return when the newest message came that a table has shown."""
        return self._arrivals(topic).last_printed_tn

    def set_last_printed_tn(self, value: float, topic: str | None = None) -> None:
        """Replace when the newest message came that a table has shown."""
        self._arrivals(topic).last_printed_tn = value

    def callback(self, data: bytes, topic: str | None = None) -> None:
        """Note the bytes of a message."""
        with self.lock:
            times, sizes = self.get_times(topic), self.get_sizes(topic)
            times.append(time.monotonic())
            sizes.append(len(data))
            if len(times) > self.window_size:
                times.pop(0)
                sizes.pop(0)

    def get_bw(self, topic: str | None = None) -> tuple[float, int, float, int, int] | None:
        """Return bytes per second, the number of messages, and mean, least and largest size.

        Returns:
            None before the second message.
        """
        with self.lock:
            times, sizes = list(self.get_times(topic)), list(self.get_sizes(topic))
        if len(times) < 2:
            return None
        # Two messages may arrive within the clock's resolution.
        rate = sum(sizes) / max(time.monotonic() - times[0], 1e-9)
        return rate, len(sizes), statistics.fmean(sizes), min(sizes), max(sizes)

    def print_bw(
        self, topics: Sequence[str | None] | None = None, clear_screen: bool = False
    ) -> None:
        """Print the bandwidths of topics, from their second messages on.

        Args:
            topics: Their names. Several are shown as a table, without those that had no message
                since the last call.
            clear_screen: Whether the terminal is cleared first.
        """
        topics = topics or [None]
        found = self._shown(topics)
        if not found:
            return
        if clear_screen:
            clear_terminal()
        if len(topics) > 1:
            print_table(_COLUMNS, [(str(name), *_texts(*figures)) for name, figures in found])
            return
        rate, count, mean, least, most = _texts(*found[0][1])
        print(f"{rate} from {count} messages\n\tMessage size mean: {mean} min: {least} max: {most}")

    def print_json(self, topics: Sequence[str]) -> None:
        """Print a JSON object for each topic that `print_bw` shows, in bytes and bytes per second.

        Args:
            topics: Their names.
        """
        for name, figures in self._shown(topics):
            print_json(dict(zip(_COLUMNS, (name, *figures), strict=True)))

    def _shown(
        self, topics: Sequence[str | None]
    ) -> list[tuple[str | None, tuple[float, int, float, int, int]]]:
        shown = topics if len(topics) == 1 else [name for name in topics if self._has_news(name)]
        return [(name, each) for name in shown if (each := self.get_bw(name)) is not None]

    def _has_news(self, topic: str | None) -> bool:
        with self.lock:
            times = self.get_times(topic)
            last = times[-1] if times else 0.0
            known = self.get_last_printed_tn(topic)
            self.set_last_printed_tn(last, topic)
        return last != known


def _texts(rate: float, count: int, *sizes: float) -> tuple[str, ...]:
    text = str_bytes if rate < 1e3 else str_kilobytes if rate < 1e6 else str_megabytes
    return (f"{text(rate)}/s", str(count), *map(text, sizes))


class BwVerb(VerbExtension, module=__name__):
    """Show the bandwidths of topics."""
