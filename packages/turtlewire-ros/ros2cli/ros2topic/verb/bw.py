"""``ros2 topic bw``."""

from __future__ import annotations

import collections
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

__all__ = [
    "ARGUMENTS",
    "DEFAULT_WINDOW_SIZE",
    "BwVerb",
    "ROSTopicBandwidth",
    "main",
    "str_bytes",
    "str_kilobytes",
    "str_megabytes",
]

DEFAULT_WINDOW_SIZE = 100

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
    *SPIN_ARGUMENTS,
)


def main(args: argparse.Namespace) -> None:
    """Print the bandwidth every second, while messages come."""
    from rclpy.qos import qos_profile_sensor_data
    from ros2cli.node.direct import DirectNode
    from ros2topic.api import type_of_topic

    with DirectNode(args) as direct:
        topic = direct.node.resolve_topic_name(args.topic_name)
        kind = type_of_topic(direct, topic, blocking=True)
        bandwidth = ROSTopicBandwidth(direct.node, args.window)
        print(f"Subscribed to [{topic}]")
        direct.node.create_subscription(
            kind, topic, bandwidth.callback, qos_profile_sensor_data, raw=True
        )
        direct.node.create_timer(1.0, bandwidth.print_bw)
        direct.spin()


def str_bytes(num_bytes: float) -> str:
    """For example ``12 B``."""
    return f"{num_bytes:.0f} B"


def str_kilobytes(num_bytes: float) -> str:
    """For example ``1.23 KB``."""
    return f"{num_bytes / 1e3:.2f} KB"


def str_megabytes(num_bytes: float) -> str:
    """For example ``1.23 MB``."""
    return f"{num_bytes / 1e6:.2f} MB"


class ROSTopicBandwidth:
    """The bandwidth of a topic; `callback` is that of its subscription, with ``raw=True``.

    Args:
        node: Accepted as in ROS 2; a steady clock counts.
        window_size: How many messages count.
    """

    def __init__(self, node: Any, window_size: int) -> None:
        self.lock = threading.Lock()
        self.window_size = window_size
        self._arrivals: collections.deque[tuple[float, int]] = collections.deque(maxlen=window_size)

    def callback(self, data: bytes) -> None:
        """Note the bytes of a message."""
        with self.lock:
            self._arrivals.append((time.monotonic(), len(data)))

    def get_bw(self) -> tuple[float, int, float, int, int] | None:
        """Bytes a second, how many messages count, mean, least and largest size [bytes].

        Returns:
            None before the second message.
        """
        with self.lock:
            if len(self._arrivals) < 2:
                return None
            first_s = self._arrivals[0][0]
            sizes = [size for _, size in self._arrivals]
        rate = sum(sizes) / max(time.monotonic() - first_s, 1e-9)
        return rate, len(sizes), statistics.fmean(sizes), min(sizes), max(sizes)

    def print_bw(self) -> None:
        """Print the bandwidth, from the second message on."""
        found = self.get_bw()
        if found is None:
            return
        rate, count, *sizes = found
        text = str_bytes if rate < 1e3 else str_kilobytes if rate < 1e6 else str_megabytes
        mean, least, most = map(text, sizes)
        print(
            f"{text(rate)}/s from {count} messages\n"
            f"\tMessage size mean: {mean} min: {least} max: {most}"
        )


@verb_of_module
class BwVerb(VerbExtension):
    """Show the bandwidth of a topic."""
