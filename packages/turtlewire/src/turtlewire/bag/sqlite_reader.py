"""Reads one ``.db3`` file of rosbag2, of schema versions 1 to 4.

Versions differ in missing tables: without the table ``schema`` it is version 2 or 1, without the
column ``offered_qos_profiles`` version 1; definitions and embedded metadata exist since version 4.

In a truncated file, the rows before the first lost one are read: they are stored in the order in
which they were written, and sqlite3 can iterate over them without the index.
"""

from __future__ import annotations

import os
import sqlite3
from collections import Counter
from collections.abc import Collection, Iterator
from contextlib import ExitStack, closing, suppress
from itertools import islice
from typing import TYPE_CHECKING, Any, TypeVar
from urllib.parse import quote

from turtlewire.bag.metadata import TopicInfo, full_type_name, parse_metadata
from turtlewire.bag.qos_yaml import load_yaml, profiles_from_yaml
from turtlewire.bag.sqlite_table import (
    BEFORE_ALL_IDS,
    BLOCK_BYTES,
    DatabaseFile,
    log_exists,
    table_blocks,
)
from turtlewire.errors import BagError

if TYPE_CHECKING:
    from turtlewire.bag.metadata import BagMetadata
    from turtlewire.bag.record_messages import LoggedBytes, RawMessage

__all__ = ["SqliteFile"]

#: Messages in the first block, and the most in a later one.
_FIRST_BLOCK = 64
_LARGEST_BLOCK = 512
_Row = TypeVar("_Row", bound="tuple[Any, ...]")

#: What the sqlite3 module raises for damaged files: broken table names are not UTF-8.
_DAMAGE = (sqlite3.Error, UnicodeDecodeError)


class SqliteFile:
    """An open sqlite3 file of a bag.

    Attributes:
        path: Where it is; of a decompressed copy, the compressed file.
        topics: Its topics by id, without their counts, which `counts` returns.
        problems: What is damaged, one sentence each.

    Raises:
        BagError: The file is not a file of rosbag2.
        OSError: The file does not exist.
    """

    def __init__(self, path: str, name: str = "") -> None:
        self.path = name or path
        self.problems: list[str] = []
        if not os.path.exists(path):
            raise FileNotFoundError(f"{path} does not exist")
        # A file with a write-ahead log next to it was not closed: sqlite must be allowed to replay
        # it. This process may be writing it, and must not close another descriptor of it.
        has_log = log_exists(path)
        mode = "rw" if has_log else "ro"
        self._opened = ExitStack()
        self._file = None if has_log else self._opened.enter_context(DatabaseFile.opened(path))
        #: Log time and id of the rows that can be read, in order; None if the file is whole.
        self._whole_rows: list[tuple[int, int, int]] | None = None
        self._counts: dict[int, int] | None = None
        self._page_bytes = missing = 0
        try:
            url = f"file:{quote(os.path.abspath(path))}?mode={mode}"
            self._database = sqlite3.connect(url, uri=True, check_same_thread=False)
            self._opened.enter_context(closing(self._database))
            self._database.text_factory = _text
            missing = self._missing_bytes()
            if missing:  # sqlite3 opens such a file only for repair
                self._database.execute("PRAGMA writable_schema = ON")
            self.topics = self._read_topics()
            if missing:
                self._read_to_the_damage(f"its last {missing:,} bytes are missing")
        except (*_DAMAGE, KeyError, TypeError, BagError) as error:
            self.close()
            lacks = f" (its last {missing:,} bytes are missing)" if missing else ""
            raise BagError(f"{self.path} is not a sqlite3 file of a bag: {error}{lacks}") from None
        except BaseException:
            self.close()
            raise

    @property
    def is_whole(self) -> bool:
        """Return whether the rows of all of its messages can be read."""
        self.counts()
        return self._whole_rows is None

    def close(self) -> None:
        """Release the file."""
        self._opened.close()

    def _read_topics(self) -> dict[int, TopicInfo]:
        return {
            row["id"]: TopicInfo(
                str(row["name"]),
                str(row["type"]),
                str(row["serialization_format"]),
                profiles_from_yaml(row.get("offered_qos_profiles"), self.path),
                str(row.get("type_description_hash") or ""),
            )
            for row in self._rows("SELECT * FROM topics ORDER BY id")
        }

    def _missing_bytes(self) -> int:
        """Return the number of bytes missing by the header; 0 while a log file is present."""
        if self._file is None:
            ((self._page_bytes,),) = self._tuples("PRAGMA page_size")
            return 0
        header = self._file.header()
        page = int.from_bytes(header[16:18], "big")
        self._page_bytes = 1 << 16 if page <= 1 else page
        told = self._page_bytes * int.from_bytes(header[28:32], "big")
        return max(0, told - self._size())

    def _size(self) -> int:
        return os.path.getsize(self.path) if self._file is None else self._file.size

    def counts(self) -> dict[int, int]:
        """Return the number of readable messages by topic id, for which all rows are read once."""
        if self._counts is None:
            try:
                query = "SELECT topic_id, COUNT(*) FROM messages GROUP BY topic_id"
                self._counts = dict(self._tuples(query))
            except sqlite3.DatabaseError:
                return self._read_to_the_damage("it is damaged")
        return self._counts

    def _read_to_the_damage(self, what: str) -> dict[int, int]:
        """Find the messages before the damage, and return their number by topic id."""
        rows = self._whole_rows = self._rows_before_the_damage()
        self.problems.append(f"{self.path}: {what}; the first {len(rows):,} messages are read")
        self._counts = Counter(topic for _, _, topic in rows)
        return self._counts

    def _rows_before_the_damage(self) -> list[tuple[int, int, int]]:
        """Log time, id and topic of the messages up to the first that is lost, in order of time."""
        found: list[tuple[int, int, int]] = []
        sizes: list[int] = []
        with suppress(*_DAMAGE):
            # SUBSTR makes sqlite3 read a message to its end, which may lie on a page that is lost.
            query = (
                "SELECT CAST(timestamp AS INTEGER), id, topic_id, LENGTH(data), SUBSTR(data, -1) "
                "FROM messages NOT INDEXED ORDER BY id"
            )
            for log_time, number, topic, size, _ in self._tuples(query):
                if log_time is None or topic is None or size is None:
                    break
                found.append((log_time, number, topic))
                sizes.append(size)
        # sqlite3 reads the missing part of a cut page as zeros: do not trust such a page.
        doubtful = self._page_bytes if self._size() % self._page_bytes else 0
        while found and doubtful > 0:
            found.pop()
            doubtful -= sizes.pop()
        return sorted(found)

    def _tuples(self, query: str, arguments: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
        yield from self._database.execute(query, arguments)

    def _rows(self, query: str) -> list[dict[str, Any]]:
        cursor = self._database.execute(query)
        names = [column[0] for column in cursor.description]
        return [dict(zip(names, row, strict=True)) for row in cursor]

    def _has_table(self, name: str) -> bool:
        query = "SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = ?"
        return any(self._tuples(query, (name,)))

    def times(self) -> tuple[int, int]:
        """Log times of the oldest and newest message; zeros without messages."""
        # A damaged file may hold other types than its columns say.
        if self._whole_rows is not None:
            rows = self._whole_rows
            return (rows[0][0], rows[-1][0]) if rows else (0, 0)
        query = (  # two queries, because each reads a single entry of the index
            "SELECT CAST((SELECT MIN(timestamp) FROM messages) AS INTEGER), "
            "CAST((SELECT MAX(timestamp) FROM messages) AS INTEGER)"
        )
        try:
            oldest, newest = next(self._tuples(query))
        except _DAMAGE as error:
            raise BagError(f"{self.path}: {error}") from None
        return oldest or 0, newest or 0

    def embedded_metadata(self) -> BagMetadata | None:
        """The metadata that the recorder wrote last; None before schema version 4, or damaged."""
        try:
            if not self._has_table("metadata"):
                return None
            rows = [row[0] for row in self._tuples("SELECT metadata FROM metadata ORDER BY id")]
            texts = [text for text in rows if isinstance(text, str)]
            return parse_metadata(load_yaml(texts[-1], self.path), self.path) if texts else None
        except (*_DAMAGE, BagError) as error:
            self.problems.append(f"{self.path}: the metadata in it cannot be read: {error}")
            return None

    def definitions(self) -> dict[str, tuple[str, str]]:
        """Encoding and text of each type's definition; empty before schema version 4."""
        try:
            if not self._has_table("message_definitions"):
                return {}
            rows = self._rows("SELECT * FROM message_definitions")
        except _DAMAGE as error:
            self.problems.append(f"{self.path}: its definitions cannot be read: {error}")
            return {}
        return {
            full_type_name(str(row["topic_type"])): (
                str(row["encoding"]),
                str(row["encoded_message_definition"]),
            )
            for row in rows
        }

    def blocks(
        self, topic_ids: Collection[int], start_ns: int, end_ns: int
    ) -> Iterator[list[RawMessage]]:
        """Yield the messages of topics in order of time, some at a time.

        Raises:
            BagError: The file is damaged; the messages before the damage were yielded.
        """
        if self._whole_rows is not None:
            yield from self._blocks_before_the_damage(topic_ids, start_ns, end_ns)
            return
        if topic_ids:
            yield from self._in_blocks(self._query(topic_ids, start_ns, end_ns))

    def unordered_blocks(
        self, topic_ids: Collection[int], start_ns: int, end_ns: int
    ) -> Iterator[list[RawMessage] | list[LoggedBytes]]:
        """Yield the messages of topics in any order, which is faster; raises as `blocks` does."""
        if self._whole_rows is not None or not topic_ids:
            yield from self.blocks(topic_ids, start_ns, end_ns)
            return
        window = _window(start_ns, end_ns)
        first, last = self.times()
        if self._file and start_ns <= first and last <= end_ns:  # the index is of no use
            after = yield from table_blocks(self._database, self._file, topic_ids, window)
            if after is None:
                return
        else:
            after = BEFORE_ALL_IDS
        columns = "CAST(timestamp AS INTEGER), IFNULL(CAST(data AS BLOB), x'')"
        where = f"timestamp BETWEEN ? AND ? AND id > ? AND topic_id IN ({_numbers(topic_ids)})"
        query = f"SELECT {columns} FROM messages WHERE {where}"  # noqa: S608 - numbers
        yield from self._in_blocks(self._tuples(query, (*window, after)))

    def _in_blocks(self, rows: Iterator[_Row]) -> Iterator[list[_Row]]:
        size = _FIRST_BLOCK
        block: list[_Row] = []
        while True:
            block = []
            try:
                # extend() keeps what came before an error.
                block.extend(islice(rows, size))
            except _DAMAGE as error:
                yield block
                raise BagError(f"{self.path}: {error}; the messages before it were read") from None
            if not block:
                return
            yield block
            fitting = BLOCK_BYTES // max(1, len(block[-1][-1]))
            size = min(max(1, fitting), _LARGEST_BLOCK)

    def _query(
        self, topic_ids: Collection[int], start_ns: int, end_ns: int
    ) -> Iterator[RawMessage]:
        """Yield messages; at damage there is an exception of sqlite3."""
        window = _window(start_ns, end_ns)
        where = (
            f"timestamp BETWEEN ? AND ? AND topic_id IN ({_numbers(topic_ids)}) "
            "ORDER BY timestamp, id"
        )
        time, data = "CAST(timestamp AS INTEGER)", "IFNULL(CAST(data AS BLOB), x'')"
        if len(topic_ids) == 1:  # each column takes time
            (topic,) = topic_ids
            query = f"SELECT {time}, {data} FROM messages WHERE {where}"  # noqa: S608 - numbers
            for log_time, content in self._database.execute(query, window):
                yield log_time, topic, log_time, content
        else:
            query = f"SELECT {time}, topic_id, {data} FROM messages WHERE {where}"  # noqa: S608
            for log_time, number, content in self._database.execute(query, window):
                yield log_time, number, log_time, content

    def _blocks_before_the_damage(
        self, topic_ids: Collection[int], start_ns: int, end_ns: int
    ) -> Iterator[list[RawMessage]]:
        query = "SELECT IFNULL(CAST(data AS BLOB), x'') FROM messages WHERE id = ?"
        lost = 0
        for log_time, number, topic in self._whole_rows or ():
            if not start_ns <= log_time <= end_ns or topic not in topic_ids:
                continue
            try:
                rows = list(self._tuples(query, (number,)))
            except _DAMAGE:
                lost += 1
                continue
            yield [(log_time, topic, log_time, data) for (data,) in rows]
        if lost:
            raise BagError(f"{self.path}: {lost:,} of these messages cannot be read after all")


def _numbers(topic_ids: Collection[int]) -> str:
    return ", ".join(map(str, topic_ids))


def _window(start_ns: int, end_ns: int) -> tuple[int, int]:
    limit = (1 << 63) - 1
    return min(start_ns, limit), min(end_ns, limit)


def _text(data: bytes) -> str:
    return data.decode("utf-8", "replace")
