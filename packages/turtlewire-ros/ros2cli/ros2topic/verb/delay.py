"""``ros2 topic delay``."""

from __future__ import annotations

import argparse
import collections
import threading
from typing import Any

from ros2cli.arguments import argument, positive_int
from ros2cli.completion import topic_names
from ros2cli.discovery import SPIN_ARGUMENTS
from ros2cli.json_lines import JSON_ARGUMENT, print_json
from ros2cli.qos import QOS_ARGUMENTS, with_options
from ros2topic.verb import VerbExtension
from ros2topic.verb.hz import spread

DEFAULT_WINDOW_SIZE = 10000

_KEYS = ("topic", "average", "min", "max", "std_dev", "window")

ARGUMENTS = (
    argument(
        "topic_name", help="Name of a topic whose messages have a header", completer=topic_names
    ),
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


def main(args: argparse.Namespace) -> None:
    """Print the delay every second, while messages come."""
    from ros2cli.node.direct import DirectNode
    from ros2topic.api import type_of_topic

    with DirectNode(args) as direct:
        topic = direct.node.resolve_topic_name(args.topic_name)
        kind = type_of_topic(direct, topic, blocking=True, as_json=args.json)
        if "header" not in kind.get_fields_and_field_types():
            raise RuntimeError("msg does not have header")
        delay = ROSTopicDelay(direct.node, args.window)
        # Best effort matches every publisher, and a lost message does not change the delay.
        qos = with_options(args, "sensor_data")
        direct.node.create_subscription(kind, topic, delay.callback_delay, qos)
        direct.node.create_timer(
            1.0, lambda: delay.print_json(topic) if args.json else delay.print_delay()
        )
        direct.spin()


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
        self._delays: collections.deque[float] = collections.deque(maxlen=window_size)
        self._is_new = False

    def callback_delay(self, msg: Any) -> None:
        """Note a message.

        Raises:
            RuntimeError: The message has no header.
        """
        if not hasattr(msg, "header"):
            raise RuntimeError("msg does not have header")
        stamp = msg.header.stamp
        stamp_ns = stamp.sec * 1_000_000_000 + stamp.nanosec
        with self.lock:
            self._delays.append((self._clock.now().nanoseconds - stamp_ns) / 1e9)
            self._is_new = True

    def get_delay(self) -> tuple[float, float, float, float, int] | None:
        """Return mean, minimum, maximum and deviation of the delay [s], and the messages counted.

        Returns:
            None if no message came since the last call.
        """
        with self.lock:
            if not self._is_new:
                return None
            self._is_new = False
            delays = list(self._delays)
        mean, deviation = spread(delays)
        return mean, min(delays), max(delays), deviation, len(delays)

    def print_delay(self) -> None:
        """Print the delay, if messages came since the last call."""
        found = self.get_delay()
        if found is not None:
            mean, shortest, longest, deviation, count = found
            print(
                f"average delay: {mean:.3f}\n"
                f"\tmin: {shortest:.3f}s max: {longest:.3f}s"
                f" std dev: {deviation:.5f}s window: {count}"
            )

    def print_json(self, topic: str) -> None:
        """Print the delay [s] as a JSON object, if messages came since the last call.

        Args:
            topic: The name of the topic.
        """
        found = self.get_delay()
        if found is not None:
            print_json(dict(zip(_KEYS, (topic, *found), strict=True)))


class DelayVerb(VerbExtension, module=__name__):
    """Show the delay of a topic, by the stamps in its headers."""
