"""Latched messages of a bag, which a listener needs wherever a playback begins."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rosbag2_transport.played_bags import PlayedBags
    from turtlewire.bag import BagMessage

#: A bag of sqlite3 does not say when a message was sent. What a recorder receives within this
#: time of its start was sent before.
_SQLITE_NS = 1_000_000_000


class Latched:
    """The latched messages that have been sent, and that are missing at a time.

    Args:
        bag: The bags; another object than the one that is played.
        depths: How many messages of each latched topic listeners keep, by topic.
    """

    def __init__(self, bag: PlayedBags, depths: Mapping[str, int]) -> None:
        self._bag = bag
        self._depths = depths
        self._passed = dict.fromkeys(depths, 0)
        self._sent = dict.fromkeys(depths, 0)

    def move(self, time_ns: int, *, look_ahead: bool = False) -> list[BagMessage]:
        """Continue at another time of the bag.

        Args:
            time_ns: The time; messages of that log time are still to come.
            look_ahead: Whether messages that were sent before that time and received later also
                count: nothing else would bring them while a playback is paused.

        Returns:
            The messages from before that listeners do not have as their newest.
        """
        if not self._depths:
            return []
        before = self._before(time_ns)
        self._passed = {topic: count for topic, (count, _) in before.items()}
        wanted = dict(before)
        if look_ahead:
            self._extend(wanted, time_ns)
        missing: list[BagMessage] = []
        for topic, (count, newest) in wanted.items():
            sent = self._sent[topic]
            # Listeners have a prefix of the wanted messages, or too many of them.
            new = count - sent if count >= sent else count
            missing += list(newest)[max(0, len(newest) - new) :] if new else []
            self._sent[topic] = count
        return sorted(missing, key=lambda message: message.log_time_ns)

    def forget(self) -> None:
        """Send all again at the next move: listeners that restart with each round need it."""
        self._sent = dict.fromkeys(self._depths, 0)

    def is_known(self, topic: str) -> bool:
        """Return True if listeners have the next message of a topic already."""
        return topic in self._passed and self._passed[topic] < self._sent[topic]

    def pass_by(self, topic: str) -> None:
        """Go past the next message of a topic, which listeners have now."""
        if topic in self._passed:
            self._passed[topic] += 1
            self._sent[topic] = max(self._sent[topic], self._passed[topic])

    def _before(self, time_ns: int) -> dict[str, tuple[int, deque[BagMessage]]]:
        """Return the number and newest messages of each topic before a time."""
        found: dict[str, tuple[int, deque[BagMessage]]] = {
            topic: (0, deque(maxlen=depth)) for topic, depth in self._depths.items()
        }
        if time_ns > self._bag.start_ns:
            for message in self._bag.messages(self._depths, end_ns=time_ns - 1):
                count, newest = found[message.topic]
                newest.append(message)
                found[message.topic] = count + 1, newest
        return found

    def _extend(self, wanted: dict[str, tuple[int, deque[BagMessage]]], time_ns: int) -> None:
        """Add messages that were sent before a time and received after it."""
        is_sqlite = self._bag.has_sqlite
        open_topics = set(self._depths)
        for message in self._bag.messages(self._depths, start_ns=time_ns):
            if message.topic not in open_topics:
                continue
            early = is_sqlite and message.log_time_ns <= time_ns + _SQLITE_NS
            if message.publish_time_ns < time_ns or early:
                count, newest = wanted[message.topic]
                newest.append(message)
                wanted[message.topic] = count + 1, newest
            else:
                open_topics.discard(message.topic)
                if not open_topics:
                    return
