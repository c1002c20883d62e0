"""Repairs the folder of a recorder that was cut off, and a damaged file of a bag.

Other programs cannot read an MCAP file without its end, or a truncated database.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from contextlib import suppress
from typing import TYPE_CHECKING

from turtlewire.bag.extra_records import extra_records
from turtlewire.bag.mcap_storage import McapStorage
from turtlewire.bag.mcap_writer import McapWriter
from turtlewire.bag.metadata import NEWEST_VERSION, write_metadata
from turtlewire.bag.qos_yaml import profiles_to_text
from turtlewire.bag.reader import Bag
from turtlewire.bag.sqlite_storage import SqliteStorage
from turtlewire.bag.sqlite_writer import SqliteWriter
from turtlewire.errors import BagError
from turtlewire.new_file import new_file

if TYPE_CHECKING:
    from turtlewire.bag.mcap_reader import McapFile
    from turtlewire.bag.metadata import BagMetadata
    from turtlewire.bag.sqlite_reader import SqliteFile
    from turtlewire.bag.storage import StorageFile

__all__ = [
    "DAMAGED",
    "reindex",
    "repaired_copy",
]

#: What is appended to the name of a file that was replaced.
DAMAGED = ".damaged"

_FOREVER = (1 << 64) - 1


def repaired_copy(file: StorageFile) -> str:
    """Write the readable part of a damaged file to a copy next to it.

    Returns:
        The path of the copy; empty if the file is whole.

    Raises:
        OSError: The disk is full, for example; no copy is left.
    """
    copy = f"{file.path}.repaired"
    if isinstance(file, McapStorage) and not file.file.closed_properly:
        with new_file(copy) as path:
            _copy_mcap(file.file, path)
    elif isinstance(file, SqliteStorage) and not file.file.is_whole:
        with new_file(copy) as path:
            _copy_sqlite(file.file, path)
    else:
        return ""
    return copy


def _copy_mcap(file: McapFile, path: str) -> None:
    writer = McapWriter(path, compression="zstd")  # so that both files fit on the disk
    try:
        schemas = {0: 0}
        for number, schema in file.schemas.items():
            schemas[number] = writer.add_schema(schema.name, schema.encoding, schema.data)
        channels = {
            number: writer.add_channel(
                schemas.get(channel.schema_id, 0),
                channel.topic,
                channel.metadata,
                channel.message_encoding,
            )
            for number, channel in file.channels.items()
        }
        if entries := file.metadata.get("rosbag2"):
            writer.write_metadata("rosbag2", entries)
        for extra in extra_records(file, lambda _: None):  # the others cannot be copied
            writer.copy_extra(extra.record)
        for chunk in file.chunks:
            with suppress(BagError):  # the messages before the damage are read
                for log_time, number, publish_time, data in file.messages(chunk, channels):
                    writer.write(channels[number], log_time, publish_time, data)
    finally:
        writer.close()


def _copy_sqlite(file: SqliteFile, path: str) -> None:
    embedded = file.embedded_metadata()
    writer = SqliteWriter(path, embedded.ros_distro if embedded else "")
    try:
        if embedded:
            writer.embed(embedded)
        hashes = {topic.type: topic.type_hash for topic in file.topics.values()}
        for name, (encoding, text) in file.definitions().items():
            writer.add_definition(name, encoding, text, hashes.get(name, ""))
        topics = {
            number: writer.add_topic(
                topic.name,
                topic.type,
                profiles_to_text(topic.qos, NEWEST_VERSION),
                topic.type_hash,
                topic.serialization_format,
            )
            for number, topic in file.topics.items()
        }
        with suppress(BagError):  # unreadable rows are left out
            for block in file.blocks(topics, 0, _FOREVER):
                for log_time, number, publish_time, data in block:
                    writer.write(topics[number], log_time, publish_time, data)
    finally:
        writer.close()


def _remove_unfinished(path: str) -> None:
    """Remove unfinished copies of a file that a killed process has left."""
    for ending in (".part", ".part-journal", ".zstd.part"):
        with suppress(FileNotFoundError):
            os.remove(path + ending)


def reindex(
    path: str | os.PathLike[str], damaged: Callable[[str], None] | None = None
) -> BagMetadata:
    """Rebuild ``metadata.yaml`` of a folder, and repair the files that were not finished.

    A file that was cut off, by a crash or a full disk, is replaced by a whole one with all that can
    be read of it. The old file keeps the name with ``.damaged`` appended. Copies that a killed
    recorder did not finish are removed.

    Args:
        path: The folder.
        damaged: Called with a sentence for each part that cannot be read.

    Raises:
        FileNotFoundError: The folder does not exist.
        BagError: ``path`` is a file, or contains no file of a bag, or an invalid one.
    """
    if os.path.isfile(path):
        folder = os.path.dirname(os.path.abspath(os.fsdecode(path)))
        raise BagError(f"{os.fsdecode(path)} is a file").with_hint(
            f"Pass the folder of the bag: reindex({folder!r})"
        )
    problems, copies = [], []
    with Bag(path, trust_metadata=False) as bag:
        for file in bag.files():
            _remove_unfinished(file.path)
            if not file.path.endswith(".zstd"):
                try:
                    copies.append((file.path, repaired_copy(file)))
                except OSError as error:
                    problems.append(f"{file.path} is not repaired: {error}")
        problems = bag.problems + problems
    for name, copy in copies:
        if copy:
            os.replace(name, name + DAMAGED)
            os.replace(copy, name)
            problems.append(f"{name} is repaired; the damaged file is {name}{DAMAGED}")
    with Bag(path, trust_metadata=False) as bag:
        write_metadata(bag.path, bag.metadata)
        if damaged is not None:
            for problem in dict.fromkeys([*problems, *bag.problems]):
                damaged(problem)
        return bag.metadata
