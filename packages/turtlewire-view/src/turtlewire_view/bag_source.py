"""A bag as a source: all of its frames at once, its messages as its time passes."""

from __future__ import annotations

import os
import struct
import threading
from bisect import bisect_right
from collections.abc import Callable
from contextlib import closing

from turtlewire.bag import open_bag
from turtlewire.bag.metadata import is_decodable, not_in_cdr
from turtlewire.bag.playback import PlayClock, ReadAhead
from turtlewire.errors import BagError
from turtlewire.tf.buffer import Buffer
from turtlewire_view.live import MAX_FRAMES, frames_left_out, stamp_range_ns
from turtlewire_view.source import OfflineSource, TimelineState, Topic

__all__ = ["BagSource", "StampsOfLog"]

#: How often the picture changes while the bag plays [s].
_FRAME_S = 1 / 30
#: How far back the last message of a topic is looked for after a jump; beyond them, everywhere.
_WINDOWS_NS = (2 * 10**9, 30 * 10**9)
_SLOWEST, _FASTEST = 0.01, 100.0


class BagSource(OfflineSource):
    """The frames and messages of a bag. Plays once a page looks at it, and stops at its end.

    All pages share its time. A thread delivers the messages of the topics that are subscribed.

    Args:
        path: A folder of rosbag2, or a file of one.
        max_frames: How many frames are shown; the page says when there are more. None: no limit.

    Raises:
        FileNotFoundError: ``path`` does not exist.
        BagError: ``path`` is not a bag.
    """

    kind = "bag"
    _WHAT = "a bag"
    joints = None

    def __init__(
        self, path: str | os.PathLike[str], *, max_frames: int | None = MAX_FRAMES
    ) -> None:
        self._path = path
        with open_bag(path) as bag:
            self._start_ns, self._end_ns = bag.start_ns, bag.end_ns
            unreadable = not_in_cdr(bag.topics.values())
            self._topics = [
                Topic(name, info.type, 1)
                for name, info in sorted(bag.topics.items())
                if is_decodable(info)
            ]
        self.name = os.path.basename(os.path.normpath(os.fspath(path)))
        self.buffer = self._read_frames(max_frames)
        self._left_out = (unreadable, frames_left_out(self.buffer))
        self._fault = ""  # why it cannot be read now
        self._stamps = StampsOfLog(path) if self._has_other_stamps() else None
        self._changed: Callable[[], None] = lambda: None
        self._news = threading.Condition()
        self._clock = PlayClock(self._start_ns, is_paused=True)
        self._sinks: dict[str, list[Callable[[bytes], None]]] = {}
        self._was_seen = False
        self._wanted = 0  # counts changes of what is to be read, or from when
        self._from_ns = self._start_ns
        self._closed = False
        self._thread = threading.Thread(target=self._run, name="turtlewire-view-bag", daemon=True)
        self._thread.start()

    @property
    def problem(self) -> str:
        """The parts of the bag that are not shown, and why; empty if all are shown."""
        return " ".join(filter(None, (*self._left_out, self._fault)))

    def now_ns(self) -> int:
        """Return the time of the bag that is shown."""
        with self._news:
            return min(self._clock.now_ns(), self._end_ns)

    def new_timeline(self) -> BagSource:
        """Return the bag itself: all pages share its time, which begins with the first of them."""
        with self._news:
            was_seen, self._was_seen = self._was_seen, True
        if not was_seen:
            self.play()
        return self

    def topics(self) -> list[Topic]:
        """Return the topics of the bag."""
        return self._topics

    def subscribe(
        self, topic: str, type_name: str, on_message: Callable[[bytes], None]
    ) -> Callable[[], None]:
        """Deliver the topic's last message before now, and those that follow, on a thread."""
        del type_name  # a topic of a bag has one
        with self._news:
            self._sinks.setdefault(topic, []).append(on_message)
            self._read_again()

        def end() -> None:
            with self._news:
                self._sinks[topic].remove(on_message)
                if not self._sinks[topic]:
                    del self._sinks[topic]
                self._read_again()

        return end

    def publish(self, topic: str, type_name: str, cdr: bytes) -> int:  # noqa: ARG002 - Source's
        """Refused.

        Raises:
            BagError: Always.
        """
        raise BagError(f"You cannot publish into a bag, so nothing was published on {topic}.")

    def on_change(self, call: Callable[[], None]) -> None:
        """Call ``call()`` on the player's thread."""
        self._changed = call

    def stamp_ns(self) -> int:
        """Return the time of the bag, or what its transforms' stamps were then."""
        now_ns = self.now_ns()
        return now_ns if self._stamps is None else self._stamps.at(now_ns)

    def state(self) -> TimelineState:
        """Return the bag's time."""
        with self._news:
            now = min(self._clock.now_ns(), self._end_ns)
            playing, speed = not self._clock.is_paused, self._clock.rate
        start, end = self._start_ns / 1e9, self._end_ns / 1e9
        return TimelineState(now / 1e9, start, end, False, playing, speed, False)

    def pause(self) -> None:
        """Hold the bag."""
        with self._news:
            self._clock.pause()
            self._news.notify_all()

    def play(self) -> None:
        """Go on, from the begin if the end was reached."""
        with self._news:
            if self._clock.now_ns() >= self._end_ns:
                self._clock.jump(self._start_ns)
                self._read_again()
            self._clock.resume()
            self._news.notify_all()

    def seek(self, stamp_ns: int) -> None:
        """Jump, and show what was published last before."""
        with self._news:
            self._clock.jump(min(max(stamp_ns, self._start_ns), self._end_ns))
            self._read_again()

    def set_speed(self, factor: float) -> None:
        """Set the playback speed, between 0.01 and 100."""
        with self._news:
            self._clock.set_rate(min(max(factor, _SLOWEST), _FASTEST))
            self._news.notify_all()

    def close(self) -> None:
        """End the thread."""
        with self._news:
            self._closed = True
            self._news.notify_all()
        self._thread.join()

    def _read_frames(self, max_frames: int | None) -> Buffer:
        types = {topic.name: topic.type_name for topic in self._topics}
        if not {"/tf", "/tf_static"} & types.keys():
            return Buffer(None)
        return Buffer.from_bag(self._path, max_frames=max_frames)

    def _has_other_stamps(self) -> bool:
        """Return True if the transforms lie outside the time in which the bag was recorded."""
        found = stamp_range_ns(self.buffer)
        return found is not None and (found[1] < self._start_ns or found[0] > self._end_ns)

    def _read_again(self) -> None:
        """Restart the thread at the shown time. The caller holds the lock."""
        self._wanted += 1
        self._from_ns = self._clock.now_ns()
        self._news.notify_all()

    def _run(self) -> None:
        while True:
            with self._news:
                if self._closed:
                    return
                wanted, start_ns = self._wanted, self._from_ns
                sinks = {topic: list(calls) for topic, calls in self._sinks.items()}
            self._fault = ""
            try:
                self._deliver_last(sinks, start_ns)
                self._changed()
                self._play_from(start_ns, sinks, wanted)
            except BagError as error:  # everything readable was delivered; the frames stay
                self._fault = str(error)
            except OSError as error:  # the files are gone, for example
                self._fault = f"The bag cannot be read: {error}"
            self._play(None, sinks, wanted)

    def _deliver_last(self, sinks: dict[str, list[Callable[[bytes], None]]], at_ns: int) -> None:
        """The last message of each topic before the time."""
        missing = set(sinks)
        with open_bag(self._path) as bag:
            for window_ns in (*_WINDOWS_NS, at_ns):
                start_ns = max(self._start_ns, at_ns - window_ns)
                if not missing or start_ns > at_ns:
                    return
                last = {
                    message.topic: message.upgraded_data()
                    for message in bag.messages(missing, start_ns=start_ns, end_ns=at_ns)
                }
                for topic, data in last.items():
                    _give(sinks[topic], data)
                missing -= last.keys()

    def _play_from(
        self, start_ns: int, sinks: dict[str, list[Callable[[bytes], None]]], wanted: int
    ) -> None:
        """Deliver what follows when it is due, until something else is wanted."""
        if sinks:
            with open_bag(self._path) as bag:
                ahead = ReadAhead(bag.messages(set(sinks), start_ns=start_ns + 1))
                with closing(ahead):
                    self._play(ahead, sinks, wanted)

    def _play(
        self,
        ahead: ReadAhead | None,
        sinks: dict[str, list[Callable[[bytes], None]]],
        wanted: int,
    ) -> None:
        """Show the passing time until something else is wanted."""
        while self._is_wanted(wanted):
            self._deliver_due(ahead, sinks)
            self._changed()
            self._wait(wanted)

    def _deliver_due(
        self, ahead: ReadAhead | None, sinks: dict[str, list[Callable[[bytes], None]]]
    ) -> None:
        now_ns = self.now_ns()
        while ahead is not None and (message := ahead.peek()) and message.log_time_ns <= now_ns:
            ahead.pop()
            _give(sinks[message.topic], message.upgraded_data())

    def _wait(self, wanted: int) -> None:
        """Wait for the next frame, or for a request while nothing moves."""
        with self._news:
            if self._clock.now_ns() >= self._end_ns and not self._clock.is_paused:
                self._clock.pause()
                self._clock.jump(self._end_ns)
                return  # the end is shown before anything is waited for
            held = self._clock.is_paused

            def is_time() -> bool:
                return self._closed or self._wanted != wanted or self._clock.is_paused != held

            self._news.wait_for(is_time, None if held else _FRAME_S)

    def _is_wanted(self, wanted: int) -> bool:
        with self._news:
            return not self._closed and self._wanted == wanted


def _give(sinks: list[Callable[[bytes], None]], data: bytes) -> None:
    for sink in sinks:
        sink(data)


_TF = "/tf"
#: After the encapsulation: the number of transforms, seconds and nanoseconds of the first one.
_HEAD = {0: struct.Struct(">IiI"), 1: struct.Struct("<IiI")}
_AFTER_ENCAPSULATION = 4


class StampsOfLog:
    """The stamp that transforms had at a log time of a bag.

    A simulation's transforms have its time, but ``ros2 bag record`` notes the system time unless it
    is started with ``--use-sim-time``. A bag that was recorded while another one was played is the
    same.

    Args:
        path: The bag; all messages of its ``/tf`` are looked at.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self._log_ns: list[int] = []
        self._stamps_ns: list[int] = []
        with open_bag(path) as bag:
            for message in bag.messages({_TF}):
                stamp_ns = _first_stamp_ns(message.data)
                if stamp_ns is not None:
                    self._log_ns.append(message.log_time_ns)
                    self._stamps_ns.append(stamp_ns)

    def at(self, log_time_ns: int) -> int:
        """Return the last stamp that was received until then; 0 before the first."""
        count = bisect_right(self._log_ns, log_time_ns)
        return self._stamps_ns[count - 1] if count else 0


def _first_stamp_ns(data: bytes) -> int | None:
    """Return the stamp of the first transform of a serialized message; None if it has none."""
    if len(data) < _AFTER_ENCAPSULATION + _HEAD[1].size:
        return None
    count, seconds, nanoseconds = _HEAD[data[1] & 1].unpack_from(data, _AFTER_ENCAPSULATION)
    return seconds * 10**9 + nanoseconds if count else None
