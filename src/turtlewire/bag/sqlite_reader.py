"""Reads one ``.db3`` file of rosbag2, of schema versions 1 to 4.

Versions differ in what they lack: without the table ``schema`` it is version 2 or 1, without the
column ``offered_qos_profiles`` version 1; definitions and embedded metadata exist since version 4.
"""

from __future__ import annotations

import os
import sqlite3
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

from turtlewire.bag.metadata import TopicInfo, parse_metadata
from turtlewire.bag.qos_yaml import load_yaml, profiles_from_yaml
from turtlewire.errors import BagError

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator

    from turtlewire.bag.metadata import BagMetadata

__all__ = ["SqliteFile"]

#: What the sqlite3 module raises for damaged files: broken table names are no UTF-8.
_DAMAGE = (sqlite3.Error, UnicodeDecodeError)


class SqliteFile:
    """An open sqlite3 file of a bag.

    Attributes:
        path: Where it is.
        topics: Its topics by id.
        problems: What is damaged, one sentence each.

    Raises:
        BagError: It is no file of rosbag2.
        OSError: It does not exist.
    """

    def __init__(self, path: str) -> None:
        self.path = path
        self.problems: list[str] = []
        if not os.path.exists(path):
            raise FileNotFoundError(f"{path} does not exist")
        # A file with a write-ahead log beside it was not closed: sqlite must be allowed to replay
        # it.
        mode = "ro" if not os.path.exists(path + "-wal") else "rw"
        self._database = sqlite3.connect(
            f"file:{quote(os.path.abspath(path))}?mode={mode}", uri=True, check_same_thread=False
        )
        self._database.text_factory = _text
        try:
            self.topics = self._read_topics()
        except (*_DAMAGE, KeyError, TypeError, BagError) as error:
            self._database.close()
            raise BagError(f"{path} is not a sqlite3 file of a bag: {error}") from None

    def close(self) -> None:
        """Release the file."""
        self._database.close()

    def _read_topics(self) -> dict[int, TopicInfo]:
        rows = self._rows("SELECT * FROM topics ORDER BY id")
        counts = dict(self._tuples("SELECT topic_id, COUNT(*) FROM messages GROUP BY topic_id"))
        topics = {}
        for row in rows:
            topics[row["id"]] = TopicInfo(
                str(row["name"]),
                str(row["type"]),
                str(row["serialization_format"]),
                profiles_from_yaml(row.get("offered_qos_profiles"), self.path),
                str(row.get("type_description_hash") or ""),
                counts.get(row["id"], 0),
            )
        return topics

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
        query = (
            "SELECT MIN(CAST(timestamp AS INTEGER)), MAX(CAST(timestamp AS INTEGER)) FROM messages"
        )
        try:
            oldest, newest = next(self._tuples(query))
        except _DAMAGE as error:
            raise BagError(f"{self.path}: {error}") from None
        return oldest or 0, newest or 0

    def embedded_metadata(self) -> BagMetadata | None:
        """The metadata that the recorder wrote last; None before schema version 4."""
        if not self._has_table("metadata"):
            return None
        texts = [str(row[0]) for row in self._tuples("SELECT metadata FROM metadata ORDER BY id")]
        return parse_metadata(load_yaml(texts[-1], self.path), self.path) if texts else None

    def definitions(self) -> dict[str, tuple[str, str]]:
        """Encoding and text of each type's definition; empty before schema version 4."""
        if not self._has_table("message_definitions"):
            return {}
        return {
            str(row["topic_type"]): (str(row["encoding"]), str(row["encoded_message_definition"]))
            for row in self._rows("SELECT * FROM message_definitions")
        }

    def messages(
        self, topic_ids: Collection[int] | None, start_ns: int, end_ns: int
    ) -> Iterator[tuple[int, int, bytes]]:
        """Log time, topic id and bytes of the messages in order of time.

        Raises:
            BagError: The file is damaged; the messages before the damage were yielded.
        """
        where = "timestamp BETWEEN ? AND ?"
        if topic_ids is not None:
            where += f" AND topic_id IN ({', '.join(map(str, topic_ids))})"
        limit = (1 << 63) - 1
        try:
            rows = self._database.execute(
                "SELECT CAST(timestamp AS INTEGER), topic_id, CAST(data AS BLOB) "  # noqa: S608
                f"FROM messages WHERE {where} "  # of the arguments only numbers are in the text
                "ORDER BY timestamp, id",
                (min(start_ns, limit), min(end_ns, limit)),
            )
            # `yield from` would close the cursor at its end, which fails after close().
            for row in rows:  # noqa: UP028
                yield row
        except _DAMAGE as error:
            raise BagError(f"{self.path}: {error}; the messages before it were read") from None


def _text(data: bytes) -> str:
    return data.decode("utf-8", "replace")
