"""The bags of one playback, as if they were one, and their latched messages."""

from __future__ import annotations

import heapq
import itertools
import os
from collections import deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack
from typing import TYPE_CHECKING

from turtlewire.bag import Bag

if TYPE_CHECKING:
    from turtlewire.bag import BagMessage, TopicInfo

#: A bag of sqlite3 does not say when a message was sent. What a recorder receives within this
#: time of its start was sent before.
_SQLITE_NS = 1_000_000_000


class PlayedBags:
    """Bags whose messages are played in one order. Not thread-safe, as a `Bag`.

    Args:
        paths: The bags.
        sent_window: 0 for the order in which the messages were received. Otherwise their order is
            that in which they were sent, as far as this number of messages tells, and their log
            time is that time.

    Raises:
        BagError: A bag cannot be read.
        FileNotFoundError: A bag does not exist.
    """

    def __init__(self, paths: Sequence[str], sent_window: int = 0) -> None:
        self._sent_window = sent_window
        with ExitStack() as opened:
            self._bags = [opened.enter_context(Bag(path)) for path in paths]
            self._opened = opened.pop_all()
        filled = [bag for bag in self._bags if len(bag)] or self._bags
        #: Log time of the oldest message.
        self.start_ns = min(bag.start_ns for bag in filled)
        #: Log time of the newest message.
        self.end_ns = max(bag.end_ns for bag in filled)
        #: The topics by name; of one that is in several bags, as the first describes it.
        self.topics: dict[str, TopicInfo] = {}
        for bag in self._bags:
            self.topics = bag.topics | self.topics

    def close(self) -> None:
        """Release the files."""
        self._opened.close()

    @property
    def has_sqlite(self) -> bool:
        """True if a bag does not say when its messages were sent."""
        return any(bag.metadata.storage == "sqlite3" for bag in self._bags)

    def files(self) -> list[tuple[int, str]]:
        """Return the log time of the first message, and the path, of each file in order."""
        return sorted(
            (file.start_ns, os.path.join(bag.path, file.path))
            for bag in self._bags
            for file in bag.metadata.files
        )

    def learn_types(self) -> None:
        """Make all types that only the bags define known to `turtlewire.msg`.

        Raises:
            InterfaceError: A definition cannot be parsed.
        """
        for bag in self._bags:
            bag.learn_types()

    def messages(
        self, topics: Iterable[str], *, start_ns: int | None = None, end_ns: int | None = None
    ) -> Iterator[BagMessage]:
        """Yield the messages of topics in order.

        Args:
            topics: Names of the topics.
            start_ns: The first time that is taken; None: from the beginning.
            end_ns: The last time that is taken; None: to the end.

        Raises:
            BagError: After all messages that can be read: a part of a bag is damaged.
        """
        wanted = set(topics)
        streams = [
            bag.messages(wanted & bag.topics.keys(), start_ns=start_ns, end_ns=end_ns)
            for bag in self._bags
        ]
        merged = heapq.merge(*streams, key=lambda message: message.log_time_ns)
        return self._as_sent(merged) if self._sent_window else merged

    def _as_sent(self, messages: Iterator[BagMessage]) -> Iterator[BagMessage]:
        # The number keeps the order of messages that were sent at the same time.
        numbered = (
            (message.publish_time_ns, number, message._replace(log_time_ns=message.publish_time_ns))
            for number, message in enumerate(messages)
        )
        waiting = list(itertools.islice(numbered, self._sent_window))
        heapq.heapify(waiting)
        for entry in numbered:
            yield heapq.heappushpop(waiting, entry)[2]
        while waiting:
            yield heapq.heappop(waiting)[2]


class Latched:
    """The latched messages that have been sent, and that are missing at a time.

    Listeners need them wherever a playback begins.

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
        """Skip the next message of a topic, which listeners already have."""
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
        """Add the messages that were sent before a time and received after it."""
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
