"""Reads rosbag2's table of messages natively from the pages of a sqlite3 file.

The module sqlite3 needs more time for a row than decoding its message takes.
"""

from __future__ import annotations

import mmap
import os
import sqlite3
from typing import TYPE_CHECKING

from turtlewire.platforms import asked_core

if TYPE_CHECKING:
    from collections.abc import Collection, Generator

    from turtlewire._native import MessageTable
    from turtlewire.bag.record_messages import LoggedBytes

__all__ = ["BEFORE_ALL_IDS", "table_blocks"]

BEFORE_ALL_IDS = -(1 << 63)

_BLOCK_BYTES = 1 << 18
_COLUMNS = [("id", "INTEGER", 1), ("topic_id", "INTEGER", 0), ("timestamp", "INTEGER", 0)]


def table_blocks(
    database: sqlite3.Connection, path: str, topics: Collection[int], window: tuple[int, int]
) -> Generator[list[LoggedBytes], None, int | None]:
    """Yield the messages of topics in the order of the table, some at a time.

    Args:
        database: The open file; while messages are read, other processes cannot change it.
        path: Where it is.
        topics: The ids of the topics.
        window: The first and the last log time.

    Returns:
        None if all messages were read. Otherwise the id of the last row that was read: the rows
        after it are for SQL, because they are damaged or not in rosbag2's form.
    """
    if asked_core() == "python" or os.path.exists(path + "-wal"):
        return BEFORE_ALL_IDS
    guard = database.cursor()
    try:
        root = _root_page(database)
        guard.execute("SELECT id FROM messages").fetchone()  # an open statement locks the file
    except (sqlite3.Error, UnicodeDecodeError):  # SQL will say what is damaged
        return BEFORE_ALL_IDS
    try:
        table = root and _table(path, root)
        if not table:
            return BEFORE_ALL_IDS
        is_more = True
        while is_more:
            block: list[LoggedBytes] = []
            is_more = table.read(topics, *window, _BLOCK_BYTES, block)
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


def _table(path: str, root: int) -> MessageTable | None:
    try:
        from turtlewire._native import MessageTable
    except ImportError:
        return None
    with open(path, "rb") as file:
        pages = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)  # the table keeps it
    page = int.from_bytes(pages[16:18], "big")
    page = 1 << 16 if page == 1 else page
    try:
        return MessageTable(pages, page, page - pages[20], root)
    except ValueError:  # of a damaged header
        return None
