"""Reads the table of messages of a ``.db3`` file natively.

The compiled core reads the pages of the file: the module sqlite3 needs more time for a row than
decoding its message takes.
"""

from __future__ import annotations

import mmap
import os
import sqlite3
import threading
from collections.abc import Collection, Generator, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, ClassVar

from turtlewire.platforms import asked_core

if TYPE_CHECKING:
    from turtlewire._native import MessageTable
    from turtlewire.bag.record_messages import LoggedBytes

__all__ = ["BEFORE_ALL_IDS", "BLOCK_BYTES", "DatabaseFile", "log_exists", "table_blocks"]

BEFORE_ALL_IDS = -(1 << 63)

#: The bytes that a block of messages should have.
BLOCK_BYTES = 1 << 18
_COLUMNS = [("id", "INTEGER", 1), ("topic_id", "INTEGER", 0), ("timestamp", "INTEGER", 0)]


def log_exists(path: str) -> bool:
    """Return true if a write-ahead log lies next to a database, or to the target of a link."""
    return os.path.exists(os.path.realpath(path) + "-wal")


class DatabaseFile:
    """A file that sqlite may have open as well. The readers of this process share it.

    On POSIX systems, a process that closes any descriptor of a file loses all its locks of that
    file, including sqlite's. So there is one descriptor, which the last reader closes.
    """

    _shared: ClassVar[dict[tuple[int, int], DatabaseFile]] = {}  # by device and inode
    _lock: ClassVar[threading.Lock] = threading.Lock()

    def __init__(self, path: str) -> None:
        self.path = path
        self._file = open(path, "rb")  # noqa: SIM115
        self._maps: list[mmap.mmap] = []  # each has a descriptor, too
        self._readers = 0

    @classmethod
    @contextmanager
    def opened(cls, path: str) -> Iterator[DatabaseFile]:
        """Open a file, or share it if another reader has it open.

        Raises:
            OSError: The file cannot be opened.
        """
        status = os.stat(path)
        key = (status.st_dev, status.st_ino)
        with cls._lock:
            file = cls._shared[key] = cls._shared.get(key) or cls(path)
            file._readers += 1
        try:
            yield file
        finally:
            with cls._lock:
                file._readers -= 1
                if not file._readers:
                    del cls._shared[key]
                    file._maps.clear()  # a map lives on while a table reads it
                    file._file.close()

    @property
    def size(self) -> int:
        """The size in bytes. Needs no name, which a decompressed copy has lost."""
        return os.fstat(self._file.fileno()).st_size

    def header(self) -> bytes:
        """Return the first bytes, as many as there are."""
        # Forked processes share the position in the file: a read could begin anywhere.
        return self.pages()[:32] if self.size else b""

    def pages(self) -> mmap.mmap:
        """Return the content, in a new map if the size has changed."""
        with self._lock:
            if not self._maps or len(self._maps[-1]) != self.size:
                self._maps.append(mmap.mmap(self._file.fileno(), 0, access=mmap.ACCESS_READ))
            return self._maps[-1]


def table_blocks(
    database: sqlite3.Connection,
    file: DatabaseFile,
    topics: Collection[int],
    window: tuple[int, int],
) -> Generator[list[LoggedBytes], None, int | None]:
    """Yield the messages of topics in the order of the table, some at a time.

    Args:
        database: The open database; while messages are read, other processes cannot change it.
        file: The same file.
        topics: The ids of the topics.
        window: The first and the last log time.

    Returns:
        None if all messages were read. Otherwise the id of the last row that was read: the rows
        after it are for SQL, because they are damaged or not in rosbag2's form.
    """
    if asked_core() == "python" or log_exists(file.path):
        return BEFORE_ALL_IDS
    guard = database.cursor()
    try:
        root = _root_page(database)
        guard.execute("SELECT id FROM messages").fetchone()  # an open statement locks the file
    except (sqlite3.Error, UnicodeDecodeError):  # SQL will say what is damaged
        return BEFORE_ALL_IDS
    try:
        table = root and _table(file, root)
        if not table:
            return BEFORE_ALL_IDS
        is_more = True
        while is_more:
            block: list[LoggedBytes] = []
            is_more = table.read(topics, *window, BLOCK_BYTES, block)
            yield block
        return None if table.is_whole else table.last_id
    finally:
        guard.close()


def _root_page(database: sqlite3.Connection) -> int | None:
    """Return the first page of the table; None if its columns are not rosbag2's."""
    columns = [
        (name, kind.upper(), key)
        for _, name, kind, _, _, key in database.execute("PRAGMA table_info(messages)")
    ]
    if columns != [*_COLUMNS, ("data", "BLOB", 0)]:
        return None
    query = "SELECT rootpage FROM sqlite_master WHERE type = 'table' AND name = 'messages'"
    return next((root for (root,) in database.execute(query) if isinstance(root, int)), None)


def _table(file: DatabaseFile, root: int) -> MessageTable | None:
    try:
        from turtlewire._native import MessageTable
    except ImportError:
        return None
    pages = file.pages()
    page = int.from_bytes(pages[16:18], "big")
    page = 1 << 16 if page == 1 else page
    try:
        return MessageTable(pages, page, page - pages[20], root)
    except ValueError:  # the header is damaged
        return None
