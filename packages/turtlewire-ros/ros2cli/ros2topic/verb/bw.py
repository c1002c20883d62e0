"""The class of ``ros2 topic bw``, and the bandwidth of a topic for other programs."""

from __future__ import annotations

import threading
import time
from typing import Any

from ros2cli.builtin import BuiltinVerb
from ros2cli.commands.topic.statistics import Sizes
from ros2topic.verb import VerbExtension

__all__ = [
    "DEFAULT_WINDOW_SIZE",
    "BwVerb",
    "ROSTopicBandwidth",
    "str_bytes",
    "str_kilobytes",
    "str_megabytes",
]

DEFAULT_WINDOW_SIZE = 100


class BwVerb(BuiltinVerb, VerbExtension):
    """Show the bandwidth of a topic."""

    _module = "topic.bw"


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
        node: Accepted as in ROS 2; the wall clock counts.
        window_size: How many messages count.
    """

    def __init__(self, node: Any, window_size: int) -> None:
        self.lock = threading.Lock()
        self.window_size = window_size
        self._sizes = Sizes(window_size)

    def callback(self, data: bytes) -> None:
        """Note the bytes of a message."""
        with self.lock:
            self._sizes.add(time.monotonic(), len(data))

    def get_bw(self) -> tuple[float, int, float, int, int] | None:
        """Bytes a second, how many messages count, mean, least and largest size [bytes].

        Returns:
            None before the second message.
        """
        with self.lock:
            now = time.monotonic()
            return self._sizes.summary(now) if len(self._sizes) > 1 else None

    def print_bw(self) -> None:
        """Print the bandwidth, from the second message on."""
        with self.lock:
            print(self._sizes.report(time.monotonic()), end="")
