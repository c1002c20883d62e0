"""Readers of bags, message by message."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from itertools import chain
from typing import TYPE_CHECKING

from rclpy.logging import get_logger
from rosbag2_py._storage import (
    ConverterOptions,
    MessageDefinition,
    ReadOrder,
    ReadOrderSortBy,
    StorageFilter,
    StorageOptions,
    check_format,
    folder_size,
    from_engine,
    topic_of,
)
from rosbag2_transport.topic_filter import is_service_event
from turtlewire.bag import Bag, open_bag
from turtlewire.bag.metadata import not_in_cdr
from turtlewire.errors import BagError

if TYPE_CHECKING:
    from rosbag2_py._metadata import BagMetadata, TopicMetadata
    from turtlewire.bag import BagMessage, TopicInfo

_FOREVER = (1 << 64) - 1


def get_registered_readers() -> set[str]:
    """Return the storages that can be read."""
    return {"mcap", "sqlite3"}


class SequentialReader:
    """Reads the messages of a bag one after the other."""

    def __init__(self) -> None:
        self._bag: Bag | None = None
        self._filter = StorageFilter()
        self._order = ReadOrder()
        self._messages: Iterator[BagMessage] = iter(())
        self._next: BagMessage | None = None
        self._position_ns = 0
        self._last: BagMessage | None = None

    def open(
        self, storage_options: StorageOptions, converter_options: ConverterOptions | None = None
    ) -> None:
        """Open a bag; it begins at its first message.

        Raises:
            RuntimeError: The bag does not exist, cannot be read, or not in the requested format.
        """
        if converter_options is not None:
            check_format(converter_options.output_serialization_format)
        try:
            self._bag = open_bag(storage_options.uri)
        except (BagError, OSError) as error:
            raise RuntimeError(
                f"No plugin detected that could open file {storage_options.uri}"
            ) from error
        if foreign := not_in_cdr(self._bag.topics.values()):
            get_logger("rosbag2_storage").warning(foreign)
        self._start(0)

    def open_uri(self, uri: str) -> None:
        """Open a bag by its folder or file alone; see `open`."""
        self.open(StorageOptions(uri=uri))

    def close(self) -> None:
        """Release the bag's files."""
        if self._bag is not None:
            self._bag.close()
            self._bag = None
        self._next = None

    def _opened(self) -> Bag:
        if self._bag is None:
            raise RuntimeError("Bag is not open. Call open() before reading.")
        return self._bag

    def _start(self, position_ns: int) -> None:
        """Read on at a log time, in the chosen order."""
        bag = self._opened()
        self._position_ns = position_ns
        names = [name for name, topic in bag.topics.items() if self._passes(topic)]
        if self._order.reverse:
            # Without a seek, the reader is at the first message, and none precedes it.
            before = bag.messages(names, end_ns=position_ns)
            # The engine reads forwards only.
            self._messages = reversed(list(before))
        else:
            self._messages = bag.messages(names, start_ns=position_ns)
        self._advance()

    def _advance(self) -> None:
        try:
            self._next = next(self._messages, None)
        except BagError as error:
            raise RuntimeError(str(error)) from error

    def _passes(self, topic: TopicInfo) -> bool:
        wanted = self._filter
        if is_service_event(topic.name, topic.type):
            listed, excluded = wanted.services_events, wanted.exclude_service_events
        else:
            listed, excluded = wanted.topics, wanted.exclude_topics
        if topic.name in excluded or _matches(wanted.regex_to_exclude, topic.name):
            return False
        # As in ROS 2, a name passes by the pattern or by the list.
        if wanted.regex:
            return _matches(wanted.regex, topic.name) or topic.name in listed
        return not listed or topic.name in listed

    def has_next(self) -> bool:
        """Return True if there is another message."""
        self._opened()
        return self._next is not None

    def read_next(self) -> tuple[str, bytes, int]:
        """Return topic, CDR bytes and log time [ns] of the next message.

        If the bag defines the type otherwise, the bytes follow the installed definition.

        Raises:
            RuntimeError: No message is left, or the bag is damaged.
        """
        message = self._next
        if message is None:
            raise RuntimeError("Bag is at end. No next message.")
        self._last = message
        # One message is read ahead, because `has_next` has to know it.
        self._advance()
        return message.topic, message.upgraded_data(), message.log_time_ns

    def get_metadata(self) -> BagMetadata:
        """Return topics, times and files of the bag."""
        bag = self._opened()
        return from_engine(bag.metadata, folder_size(bag.path))

    def get_all_topics_and_types(self) -> list[TopicMetadata]:
        """Return the bag's topics."""
        topics = self._opened().topics.values()
        return [topic_of(number, topic) for number, topic in enumerate(topics)]

    def get_all_message_definitions(self) -> list[MessageDefinition]:
        """Return the definitions of the bag's types."""
        hashes = {topic.type: topic.type_hash for topic in self._opened().topics.values()}
        return [
            MessageDefinition(name, encoding, text, hashes.get(name, ""))
            for name, (encoding, text) in self._opened().definitions().items()
        ]

    def set_filter(self, storage_filter: StorageFilter) -> None:
        """Restrict the messages that are still to come."""
        self._filter = storage_filter
        self._continue()

    def reset_filter(self) -> None:
        """Lift the restriction for the messages that are still to come."""
        self.set_filter(StorageFilter())

    def _continue(self) -> None:
        """Go on after the message that was read last."""
        last = self._last
        if last is None:
            self._start(self._position_ns)
            return
        # A log time is all that a reader can go to, and several messages may have it.
        self._start(last.log_time_ns)
        passed: list[BagMessage] = []
        while self._next is not None and self._next.log_time_ns == last.log_time_ns:
            passed.append(self._next)
            self._advance()
        behind = passed[passed.index(last) + 1 :] if last in passed else []
        if behind:
            rest = self._messages if self._next is None else chain((self._next,), self._messages)
            self._messages = chain(behind, rest)
            self._advance()

    def set_read_order(self, order: ReadOrder) -> bool:
        """Choose the order of the messages.

        Returns:
            Whether that order is possible. Messages cannot be sorted by their publication, and
            sqlite3 bags do not define an order, as in ROS 2; the order stays as it was then.
        """
        bag = self._opened()
        by_file = order.sort_by is ReadOrderSortBy.File
        if order.sort_by is ReadOrderSortBy.PublishedTimestamp or (
            by_file and bag.metadata.storage != "mcap"
        ):
            print(  # noqa: T201 - rosbag2 logs it
                f"[WARN] [rosbag2_storage]: {order.sort_by.name} read order is not supported",
                file=sys.stderr,
            )
            return False
        self._order = order
        self._start(self._position_ns)
        return True

    def seek(self, timestamp: int) -> None:
        """Go on with the first message at or after a log time [ns]; reversed, at or before it."""
        self._last = None
        self._start(max(0, min(timestamp, _FOREVER)))


class SequentialCompressionReader(SequentialReader):
    """A `SequentialReader` under the name for compressed bags; every reader decompresses."""


def _matches(pattern: str, name: str) -> bool:
    return bool(pattern) and re.fullmatch(pattern, name) is not None
