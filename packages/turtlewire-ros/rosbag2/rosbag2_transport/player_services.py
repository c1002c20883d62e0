"""Lets other nodes monitor and control a player: services, split events, ``/clock``."""

from __future__ import annotations

import threading
import time
from typing import TYPE_CHECKING, Any

from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.time import Time
from rosbag2_interfaces import srv
from rosbag2_interfaces.msg import ReadSplitEvent
from rosgraph_msgs.msg import Clock

if TYPE_CHECKING:
    from typing_extensions import Self

    from rclpy.node import Node
    from rosbag2_transport.options import PlayOptions
    from rosbag2_transport.player import BagPlayer
    from turtlewire.bag import BagMessage


class PlayerServices:
    """Answers on the node's executor.

    Args:
        node: The player's node.
        player: The player to control.
    """

    def __init__(self, node: Node, player: BagPlayer) -> None:
        self._node = node
        self._player = player
        self._files = player.files()
        self._file = 0
        self._splits = node.create_publisher(ReadSplitEvent, "events/read_split", 1)
        player.on_publish.append(self._report_split)
        for type_, name, callback in (
            (srv.Pause, "pause", self._pause),
            (srv.Resume, "resume", self._resume),
            (srv.TogglePaused, "toggle_paused", self._toggle_paused),
            (srv.IsPaused, "is_paused", self._is_paused),
            (srv.GetRate, "get_rate", self._get_rate),
            (srv.SetRate, "set_rate", self._set_rate),
            (srv.Play, "play", self._play),
            (srv.PlayNext, "play_next", self._play_next),
            (srv.Burst, "burst", self._burst),
            (srv.Seek, "seek", self._seek),
            (srv.Stop, "stop", self._stop),
        ):
            node.create_service(type_, f"~/{name}", callback)

    def _report_split(self, message: BagMessage) -> None:
        """Report when the playback continues with the next file."""
        following = self._file + 1
        while following < len(self._files) and message.log_time_ns >= self._files[following][0]:
            closed, opened = self._files[self._file][1], self._files[following][1]
            name = self._node.get_fully_qualified_name()
            self._splits.publish(
                ReadSplitEvent(closed_file=closed, opened_file=opened, node_name=name)
            )
            self._file, following = following, following + 1
        while self._file and message.log_time_ns < self._files[self._file][0]:
            self._file -= 1  # after a seek or at the next round

    def _pause(self, _request: Any, response: Any) -> Any:
        self._player.pause()
        return response

    def _resume(self, _request: Any, response: Any) -> Any:
        self._player.resume()
        return response

    def _toggle_paused(self, _request: Any, response: Any) -> Any:
        self._player.toggle_paused()
        return response

    def _is_paused(self, _request: Any, response: Any) -> Any:
        response.paused = self._player.clock.is_paused
        return response

    def _get_rate(self, _request: Any, response: Any) -> Any:
        response.rate = self._player.clock.rate
        return response

    def _set_rate(self, request: Any, response: Any) -> Any:
        response.success = self._player.set_rate(request.rate)
        return response

    def _play(self, _request: Any, response: Any) -> Any:
        # Always playing, because the node ends with the playback.
        warning = "Trying to play() while in playback, dismissing request."
        self._node.get_logger().warning(warning)
        response.success = False
        return response

    def _play_next(self, _request: Any, response: Any) -> Any:
        response.success = self._player.play_next()
        return response

    def _burst(self, request: Any, response: Any) -> Any:
        response.actually_burst = self._player.burst(request.num_messages)
        return response

    def _seek(self, request: Any, response: Any) -> Any:
        self._player.seek(Time.from_msg(request.time).nanoseconds)
        response.success = True
        return response

    def _stop(self, _request: Any, response: Any) -> Any:
        self._player.stop()
        return response


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

    def __exit__(self, *_error: object) -> None:
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
