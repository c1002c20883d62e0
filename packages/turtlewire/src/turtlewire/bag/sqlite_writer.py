"""Writes one ``.db3`` file of rosbag2 (schema version 4)."""

from __future__ import annotations

import errno
import os
import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from typing import TYPE_CHECKING

from turtlewire.bag.metadata import dump_metadata
from turtlewire.bag.qos_yaml import profiles_to_text
from turtlewire.new_file import new_file

if TYPE_CHECKING:
    from turtlewire.bag.message import BagChannel
    from turtlewire.bag.metadata import BagMetadata

__all__ = ["SqliteWriter", "merge_by_copy"]

_SCHEMA = """
CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
CREATE TABLE metadata(
    id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, metadata TEXT NOT NULL);
CREATE TABLE topics(
    id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,
    serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL,
    type_description_hash TEXT NOT NULL);
CREATE TABLE message_definitions(
    id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL, encoding TEXT NOT NULL,
    encoded_message_definition TEXT NOT NULL, type_description_hash TEXT NOT NULL);
CREATE TABLE messages(
    id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL,
    data BLOB NOT NULL);
CREATE INDEX timestamp_idx ON messages (timestamp ASC);
"""
_SCHEMA_VERSION = 4
_BATCH_BYTES = 768 * 1024


@contextmanager
def _as_os_error(path: str) -> Iterator[None]:
    """Raise errors of the database as OSError, except errors of its caller."""
    try:
        yield
    except sqlite3.ProgrammingError:  # the database is closed, for example
        raise
    except sqlite3.DatabaseError as error:
        number = errno.ENOSPC if "full" in str(error) else errno.EIO
        raise OSError(number, str(error), path) from error


class SqliteWriter:
    """A sqlite3 file that is being written.

    While it is open, a write-ahead log lies next to it, so a killed process loses only what was
    not flushed. Closing merges the log into the file, or leaves that to a process that reads it.

    Args:
        path: The file; it must not exist.
        ros_distro: Name of the ROS distribution that records.

    Raises:
        FileExistsError: The file already exists.
        OSError: From each method: the file cannot be written, for example because the disk is full.
    """

    #: There is no summary, unlike in MCAP files.
    summary_bytes = 0

    def __init__(self, path: str, ros_distro: str) -> None:
        if os.path.exists(path):
            raise FileExistsError(f"{path} exists already")
        self.path = path
        with _as_os_error(path):
            self._database = sqlite3.connect(path, isolation_level=None, check_same_thread=False)
        try:
            with _as_os_error(path):
                self._database.executescript("PRAGMA journal_mode = WAL; PRAGMA synchronous = OFF;")
                self._database.executescript(_SCHEMA)
            self._insert("schema VALUES (?, ?)", (_SCHEMA_VERSION, ros_distro))
        except BaseException:
            self._database.close()
            raise
        self._pending: list[tuple[int, int, bytes]] = []
        self._pending_bytes = 0
        self._file_bytes = 0
        self._types: set[str] = set()
        self.message_count = 0
        self.start_ns = (1 << 64) - 1
        self.end_ns = 0
        self.channel_counts: dict[int, int] = {}

    @property
    def size(self) -> int:
        """Bytes of the messages in the file and waiting for it."""
        return self._file_bytes + self._pending_bytes

    def add_definition(self, type_name: str, encoding: str, text: str, type_hash: str) -> None:
        """Add the definition of a type, once."""
        if type_name not in self._types:
            self._types.add(type_name)
            self._insert(
                "message_definitions VALUES (NULL, ?, ?, ?, ?)",
                (type_name, encoding, text, type_hash),
            )

    def add_topic(
        self, name: str, type_name: str, qos: str, type_hash: str, encoding: str = "cdr"
    ) -> int:
        """Add a topic; returns its id."""
        topic_id = self._insert(
            "topics VALUES (NULL, ?, ?, ?, ?, ?)", (name, type_name, encoding, qos, type_hash)
        )
        self.channel_counts[topic_id] = 0
        return topic_id

    def define(self, channel: BagChannel, version: int) -> int:
        """Add a topic and the definition of its type; see `McapWriter.define`."""
        topic, schema = channel.topic, channel.schema
        text = schema.data.decode("utf-8", "replace")
        self.add_definition(topic.type, schema.encoding, text, topic.type_hash)
        qos = profiles_to_text(topic.qos, version)
        return self.add_topic(
            topic.name, topic.type, qos, topic.type_hash, topic.serialization_format
        )

    def write(self, topic_id: int, log_time_ns: int, _publish_time_ns: int, data: bytes) -> None:
        """Add a message; the publish time has no place in this format."""
        self._pending.append((topic_id, log_time_ns, data))
        self._pending_bytes += len(data)
        if self._pending_bytes >= _BATCH_BYTES:
            self.flush()

    def embed(self, metadata: BagMetadata) -> None:
        """Add the bag's metadata; the last one counts."""
        row = (metadata.version, dump_metadata(metadata))
        self._insert("metadata VALUES (NULL, ?, ?)", row)

    def _insert(self, values: str, row: tuple[str | int, ...]) -> int:
        """Insert a row; return its id."""
        with _as_os_error(self.path):
            return self._database.execute(f"INSERT INTO {values}", row).lastrowid or 0

    def flush(self) -> None:
        """Write the pending messages in one transaction."""
        if not self._pending:
            return
        with _as_os_error(self.path), self._database:  # commits, or rolls back after an error
            self._database.execute("BEGIN")
            self._database.executemany(
                "INSERT INTO messages (topic_id, timestamp, data) VALUES (?, ?, ?)", self._pending
            )
        for topic_id, log_time, _ in self._pending:
            self.channel_counts[topic_id] += 1
            self.start_ns = min(self.start_ns, log_time)
            self.end_ns = max(self.end_ns, log_time)
        self.message_count += len(self._pending)
        self._file_bytes += self._pending_bytes
        self.discard()

    def discard(self) -> None:
        """Forget the pending messages, for example because the disk is full."""
        self._pending.clear()
        self._pending_bytes = 0

    def close(self) -> None:
        """Write pending messages, merge the log and close the file."""
        try:
            self.flush()
            self._merge_log()
        finally:
            self._database.close()

    def abandon(self) -> None:
        """Close the file without completing it, because it will be deleted."""
        self._database.close()

    def _merge_log(self) -> None:
        with _as_os_error(self.path):
            try:
                self._database.execute("PRAGMA journal_mode = DELETE")
            except sqlite3.OperationalError as error:
                # Another process reads the file: the last reader that closes it merges the log.
                if "locked" not in str(error):
                    raise


def merge_by_copy(path: str) -> None:
    """Make a closed file whole whose log waits for its readers: they keep the former file.

    Raises:
        OSError: The file cannot be read, its copy not be written, or the system does not replace
            files that are open.
    """
    if not os.path.exists(path + "-wal"):
        return
    with (
        _as_os_error(path),
        new_file(path) as copy,
        closing(sqlite3.connect(path)) as source,
        closing(sqlite3.connect(copy)) as target,
    ):
        source.backup(target)
        target.execute("PRAGMA journal_mode = DELETE")
    for log in (path + "-wal", path + "-shm"):
        with suppress(FileNotFoundError):
            os.remove(log)
