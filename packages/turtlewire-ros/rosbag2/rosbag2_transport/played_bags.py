"""The bags of one playback, as if they were one."""

from __future__ import annotations

import heapq
import itertools
import os
from collections.abc import Iterable, Iterator, Sequence
from contextlib import ExitStack
from typing import TYPE_CHECKING

from turtlewire.bag import Bag

if TYPE_CHECKING:
    from turtlewire.bag import BagMessage, TopicInfo


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
