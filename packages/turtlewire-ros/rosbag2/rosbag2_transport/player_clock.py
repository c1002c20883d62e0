"""Publishes the time of a playback on ``/clock``."""

from __future__ import annotations

import threading
import time
from types import TracebackType
from typing import TYPE_CHECKING

from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.time import Time
from rosgraph_msgs.msg import Clock

if TYPE_CHECKING:
    from typing_extensions import Self

    from rclpy.node import Node
    from rosbag2_transport.options import PlayOptions
    from rosbag2_transport.player import BagPlayer
    from turtlewire.bag import BagMessage


class ClockPublisher:
    """Publishes at a frequency, with messages, or both; a context manager.

    Args:
        node: The player's node.
        player: Whose time it is.
        options: When to publish; perhaps never.
    """

    def __init__(self, node: Node, player: BagPlayer, options: PlayOptions) -> None:
        self._player = player
        self._frequency = options.clock_publish_frequency
        self._triggers = set(options.clock_trigger_topics)
        self._by_all = options.clock_publish_on_topic_publish
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run, name="bag-clock", daemon=True)
        if self._frequency > 0 or self._by_all or self._triggers:
            qos = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
            self._publisher = node.create_publisher(Clock, "/clock", qos)
        if self._by_all or self._triggers:
            player.on_publish.append(self._publish_with)

    def __enter__(self) -> Self:
        if self._frequency > 0:
            self._thread.start()
        return self

    def __exit__(
        self,
        _type: type[BaseException] | None,
        _error: BaseException | None,
        _traceback: TracebackType | None,
    ) -> None:
        self._ended.set()
        if self._thread.is_alive():
            self._thread.join()

    def _run(self) -> None:
        """Publish at deadlines that do not depend on how long publishing takes."""
        period = 1 / self._frequency
        due = time.monotonic()
        while not self._ended.wait(max(0.0, due - time.monotonic())):
            with self._player.changed:
                now_ns = self._player.clock.now_ns()
            self._publish(now_ns)
            # After a delay, at most one message is made up for.
            due = max(due + period, time.monotonic() - period)

    def _publish_with(self, message: BagMessage) -> None:
        if self._by_all or message.topic in self._triggers:
            self._publish(message.log_time_ns)

    def _publish(self, time_ns: int) -> None:
        self._publisher.publish(Clock(clock=Time(nanoseconds=time_ns).to_msg()))
