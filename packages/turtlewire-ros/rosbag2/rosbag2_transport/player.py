"""Plays bags at their own pace, paused, faster, from another position, or message by message.

All times of the bag are log times in nanoseconds. One thread plays; commands come from any other.
The playing thread waits for a deadline or a command; a command wakes it.
"""

from __future__ import annotations

import contextlib
import sqlite3
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING

from rosbag2_transport.options import MessageOrder
from rosbag2_transport.play_filter import mistakes, played_topics
from rosbag2_transport.played_bags import Latched, PlayedBags
from rosbag2_transport.player_outputs import PlayerOutputs
from turtlewire.bag.playback import PlayClock, ReadAhead
from turtlewire.errors import BagError

if TYPE_CHECKING:
    from rclpy.node import Node
    from rosbag2_transport.options import PlayOptions
    from turtlewire.bag import BagMessage

_SECOND = 1_000_000_000
_FOREVER = 1 << 62
#: How long the end waits for reliable subscriptions, unless the options say otherwise.
_LAST_MESSAGES_NS = _SECOND
_ACKNOWLEDGED_NS = _SECOND // 10


class BagPlayer:
    """Plays bags. Thread-safe, except that one thread plays at a time.

    Args:
        node: The node whose publishers it uses.
        paths: The bags.
        options: Options of the playback.

    Attributes:
        changed: Guards everything; notified after each command.
        clock: The time of the bag.
        start_ns: Log time of the first message.
        end_ns: Log time of its last message, or the time at which the options end the playback.
        on_publish: Called with each message before it is published.

    Raises:
        FileNotFoundError: The bag does not exist.
        BagError: The bag cannot be read.
        RuntimeError: An option is wrong.
    """

    def __init__(self, node: Node, paths: Sequence[str], options: PlayOptions) -> None:
        self._logger = node.get_logger()
        self._options = options
        as_sent = options.message_order == MessageOrder.SENT_TIMESTAMP
        self._bag = PlayedBags(paths, options.read_ahead_queue_size if as_sent else 0)
        # Latched messages are looked up while the others are read ahead by a thread.
        self._side_bag = PlayedBags(paths)
        self.start_ns, self.end_ns = self._bag.start_ns, self._bag.end_ns
        self._topics = played_topics(self._bag, options)
        for mistake in mistakes(self._bag, options):
            self._logger.warning(mistake)
        self._outputs = PlayerOutputs(node, self._bag, self._topics, options)
        self._latched = Latched(self._side_bag, self._outputs.latched)
        self.changed = threading.Condition()
        self._first_ns = self._clamped(self.start_ns + int(options.start_offset * _SECOND))
        self._until_ns = self._play_until()
        if self._until_ns >= 0:
            self.end_ns = max(self.start_ns, min(self._until_ns, self.end_ns))
        self.clock = PlayClock(self._first_ns, options.rate, is_paused=options.start_paused)
        self.on_publish: list[Callable[[BagMessage], None]] = []
        self._source: ReadAhead | None = None
        self._stopped = self._playing = self._ready = False
        self._failure: Exception | None = None
        self.set_rate(options.rate)
        self._logger.info(f"Playback until timestamp: {self._until_ns}")

    def _clamped(self, time_ns: int) -> int:
        # After the last message, nothing is left to play.
        return max(self.start_ns, min(time_ns, self.end_ns + 1))

    def _play_until(self) -> int:
        """Return the time to end at; -1 for the end of the bag."""
        options = self._options
        until = options.playback_until_timestamp
        if options.playback_duration >= 0:
            # As in rosbag2, the later of the two limits counts.
            until = max(until, self._first_ns + int(options.playback_duration * _SECOND))
        return until if until >= 0 else -1

    def files(self) -> list[tuple[int, str]]:
        """Return the log time of the first message, and the path, of each file in order."""
        return self._bag.files()

    def close(self) -> None:
        """Release the bag and leave the graph."""
        self.stop()
        with self.changed:
            self._close_source()
        self._outputs.close()
        self._bag.close()
        self._side_bag.close()

    # -- playing

    def play(self) -> None:
        """Play to the end, again and again with the option ``loop``; `stop` ends it early.

        Raises:
            BagError: The bag is damaged; after what can be read.
        """
        if self.begin():
            self.run()

    def begin(self) -> bool:
        """Prepare :meth:`run`, so that a `stop` in between also counts.

        Returns:
            False if it plays already.
        """
        with self.changed:
            if self._playing:
                return False
            self._playing, self._stopped, self._ready = True, False, False
            self._failure = None
            return True

    def run(self) -> None:
        """Play as :meth:`play` does, after :meth:`begin`."""
        try:
            self._outputs.wait_for_listeners()
            while self._play_once() and self._options.loop:
                with self.changed:
                    self._latched.forget()
            self._wait_for_acknowledgments()
        finally:
            with self.changed:
                if self._stopped:
                    self._logger.info("Stopping playback.")
                self._playing, self._stopped = False, True
                self.changed.notify_all()
        if self._failure is not None:
            raise self._failure

    def _play_once(self) -> bool:
        """Play from the first message to the last one; False when it was stopped."""
        self._sleep()
        with self.changed:
            self._move(self._first_ns)
            self._ready = True
            self.changed.notify_all()
        while True:
            with self.changed:
                if self._stopped:
                    return False
                message = self._next()
                if message is None:
                    if not self.clock.is_paused:
                        return True
                    self.changed.wait()  # a seek may come
                    continue
                if self.clock.is_paused:
                    self.changed.wait()
                    continue
                seconds = self.clock.seconds_until(message.log_time_ns)
                if seconds > 0:
                    self.changed.wait(seconds)
                    continue
                self._publish(message)

    def _sleep(self) -> None:
        """Wait for the delay before each round; the clock runs during it, as in ROS 2."""
        if self._options.delay <= 0:
            return
        delay_ns = int(self._options.delay * _SECOND)
        self._logger.info(f"Sleep {delay_ns} ns")
        with self.changed:
            self.changed.wait_for(lambda: self._stopped, delay_ns / _SECOND)

    def _next(self) -> BagMessage | None:
        """Return the next message that listeners do not have yet; None at the end."""
        if self._source is None:
            return None
        while (message := self._source.peek()) is not None:
            if self._until_ns >= 0 and message.log_time_ns > self._until_ns:
                return None
            if self._latched.is_known(message.topic):
                self._latched.pass_by(message.topic)
                self._source.pop()
                continue
            break
        return message

    def _publish(self, message: BagMessage) -> None:
        if self._source is not None:
            self._source.pop()
        self._latched.pass_by(message.topic)
        for call in self.on_publish:
            call(message)
        self._outputs.publish(message)

    def _move(self, time_ns: int) -> None:
        """Continue at another time; listeners get the latched messages from before."""
        self._close_source()
        for message in self._latched.move(time_ns, look_ahead=self.clock.is_paused):
            self._outputs.publish(message)
        messages = self._bag.messages(self._topics, start_ns=time_ns)
        self._source = ReadAhead(messages, self._options.read_ahead_queue_size)
        self._source.wait_until_ready()  # otherwise, the first messages would be late
        # Last, so that time begins when the messages are ready.
        self.clock.jump(time_ns)

    def _close_source(self) -> None:
        if self._source is not None:
            self._source.close()
            self._source = None

    def _wait_for_acknowledgments(self) -> None:
        """Wait for what the option asks, or a moment; `stop` ends it."""
        asked = self._options.wait_acked_timeout
        # As in ROS 2, 0 means no limit.
        timeout_ns = _LAST_MESSAGES_NS if asked < 0 else asked * 1_000_000 or _FOREVER
        end_ns = time.monotonic_ns() + timeout_ns
        while not self._stopped:
            left_ns = end_ns - time.monotonic_ns()
            # In pieces: the middleware's wait cannot be interrupted.
            if self._outputs.wait_for_acknowledgments(max(0, min(left_ns, _ACKNOWLEDGED_NS))):
                return
            if left_ns <= 0:
                break
        if asked >= 0 and not self._stopped:
            self._logger.error(
                "Timed out while waiting for all published messages to be acknowledged"
            )

    # -- commands

    def stop(self) -> None:
        """End a playback."""
        with self.changed:
            self._stopped = True
            self.changed.notify_all()

    def pause(self) -> None:
        """Hold the clock."""
        with self.changed:
            if not self.clock.is_paused:
                self.clock.pause()
                self._logger.info("Pausing play.")
                self.changed.notify_all()

    def resume(self) -> None:
        """Let the clock run again."""
        with self.changed:
            if self.clock.is_paused:
                self.clock.resume()
                self._logger.info("Resuming play.")
                self.changed.notify_all()

    def toggle_paused(self) -> None:
        """Pause or resume."""
        (self.resume if self.clock.is_paused else self.pause)()

    def set_rate(self, rate: float) -> bool:
        """Play faster or slower; False for a rate that is not more than 0."""
        with self.changed:
            if not 0 < rate < float("inf"):
                self._logger.warning(f"Failed to set rate to invalid value {rate:g}")
                return False
            self.clock.set_rate(rate)
            self._logger.info(f"Set rate to {rate:g}")
            self.changed.notify_all()
            return True

    @contextlib.contextmanager
    def _command(self) -> Iterator[None]:
        """End the playback with the error if the bag is damaged; the command does not raise."""
        with self.changed:
            try:
                yield
            except (BagError, OSError, sqlite3.Error) as error:
                self._failure, self._stopped = error, True
            self.changed.notify_all()

    def seek(self, time_ns: int) -> None:
        """Continue at a time of the bag; one outside means its start or end."""
        with self._command():
            self._wait_until_ready()
            self._move(self._clamped(time_ns))

    def play_next(self) -> bool:
        """Publish the next message of a paused playback; False at the end or if it runs."""
        with self.changed:
            if not self.clock.is_paused:
                self._logger.warning("Called play next, but not in paused state.")
                return False
            self._wait_until_ready()
            with self._command():
                return self._play_now()
            return False

    def burst(self, count: int) -> int:
        """Publish the next messages of a paused playback at once.

        Args:
            count: How many; 0 for all.

        Returns:
            How many there were.
        """
        with self.changed:
            if not self.clock.is_paused:
                self._logger.warning("Burst can only be used when in the paused state.")
                return 0
            self._wait_until_ready()
            done = 0
            with self._command():
                while (not count or done < count) and self._play_now():
                    done += 1
            self._logger.info(f"Burst {done} messages.")
            return done

    def wait_until_started(self, timeout: float | None) -> bool:
        """Wait for the first message's turn; False if the timeout passes first."""
        with self.changed:
            return self.changed.wait_for(lambda: self._ready, timeout)

    def _wait_until_ready(self) -> None:
        """Wait for the end of the delay."""
        self.changed.wait_for(lambda: self._ready or self._stopped)

    def _play_now(self) -> bool:
        message = self._next()
        if message is None:
            return False
        self.clock.jump(message.log_time_ns)
        self._publish(message)
        return True
