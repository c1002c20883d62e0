"""The files of a bag: their kinds, names, order and common metadata."""

from __future__ import annotations

import os
import re
import time
from collections.abc import Iterator
from typing import TYPE_CHECKING

from turtlewire.bag.mcap_records import MAGIC
from turtlewire.bag.mcap_storage import McapStorage
from turtlewire.bag.metadata import BagMetadata, FileInfo, TopicInfo
from turtlewire.bag.ros1_file import MAGIC as ROS1_MAGIC
from turtlewire.bag.ros1_storage import Ros1Storage
from turtlewire.bag.sqlite_storage import SqliteStorage
from turtlewire.bag.sqlite_table import DatabaseFile, log_exists
from turtlewire.distro import LYRICAL
from turtlewire.errors import BagError

if TYPE_CHECKING:
    from turtlewire.bag.storage import StorageFile

__all__ = ["file_name", "joined", "open_storage", "overlapping", "storage_files"]

_TIME = re.compile(r"_\d{4}(?:_\d\d){2}-\d\d(?:_\d\d){2}$")
_LYRICAL_NAME = re.compile(r"(\d+)_.*_\d{4}(?:_\d\d){2}-\d\d(?:_\d\d){2}")
_SQLITE_MAGIC = b"SQLite format 3\0"
_ZIP_MAGIC = b"PK\x03\x04"


def storage_files(folder: str) -> list[str]:
    """Return the storage files of a folder without metadata, in the order of their numbers.

    If a killed recorder has left a file and its compressed copy, only the file counts.
    """
    endings = (".mcap", ".db3", ".mcap.zstd", ".db3.zstd")
    found = {entry.name for entry in os.scandir(folder) if entry.is_file()}
    names = [
        name
        for name in found
        if name.endswith(endings)
        and not (name.endswith(".zstd") and name.removesuffix(".zstd") in found)
    ]
    return sorted(names, key=lambda name: (_number(name), name))


def _number(name: str) -> int:
    """Return the number in ``my_bag_12.mcap`` or, as of Lyrical, ``12_my_bag_TIME.mcap``.

    -1 without one.
    """
    stem = name.split(".", maxsplit=1)[0]
    if match := _LYRICAL_NAME.fullmatch(stem):
        return int(match[1])
    number = stem.rpartition("_")[2]
    return int(number) if number.isdecimal() else -1


def file_name(folder: str, number: int, ros_distro: str) -> str:
    """Return the name of a new storage file of a bag, without its suffix.

    Args:
        folder: The folder of the bag.
        number: Its place among the bag's files.
        ros_distro: The distribution whose names are used.
    """
    base = os.path.basename(folder)
    if ros_distro != str(LYRICAL):
        return f"{base}_{number}"
    # Folders named by `ros2 bag record` end with a time, which the file name adds itself.
    return f"{number}_{_TIME.sub('', base)}_{time.strftime('%Y_%m_%d-%H_%M_%S')}"


def overlapping(metadata: BagMetadata) -> Iterator[list[str]]:
    """Paths of the files in order of time; those whose times overlap come together."""
    paths, files = metadata.paths, metadata.files
    if len(files) != len(paths):  # metadata before version 5 does not contain the times of files
        yield paths
        return
    group: list[str] = []
    end = 0
    for file, path in sorted(zip(files, paths, strict=True), key=lambda pair: pair[0].start_ns):
        if group and file.start_ns > end:
            yield group
            group = []
        group.append(path)
        end = max(end, file.start_ns + file.duration_ns)
    if group:
        yield group


def joined(paths: list[str], parts: list[BagMetadata]) -> BagMetadata:
    """Return the metadata of a bag that consists of these files."""
    files = [
        FileInfo(path.removesuffix(".zstd"), part.start_ns, part.duration_ns, part.message_count)
        for path, part in zip(paths, parts, strict=True)
    ]
    topics: dict[str, TopicInfo] = {}
    for topic in (topic for part in parts for topic in part.topics):
        known = topics.setdefault(topic.name, topic)
        if known is not topic:
            known.message_count += topic.message_count
    whole_files = paths[0].endswith(".zstd")
    filled = [part for part in parts if part.message_count]
    start = min((part.start_ns for part in filled), default=0)
    end = max((part.start_ns + part.duration_ns for part in filled), default=0)
    return BagMetadata(
        storage=parts[0].storage,
        paths=paths,
        files=files,
        topics=list(topics.values()),
        start_ns=start,
        duration_ns=end - start,
        message_count=sum(part.message_count for part in parts),
        compression_format="zstd" if whole_files else parts[0].compression_format,
        compression_mode="FILE" if whole_files else parts[0].compression_mode,
        custom_data=parts[0].custom_data,
        ros_distro=parts[0].ros_distro,
    )


def open_storage(path: str, name: str = "") -> StorageFile:
    """Open a ``.mcap`` or ``.db3`` file; its first bytes decide which format it has.

    Args:
        path: The file.
        name: The path in errors; by default the same.

    Raises:
        FileNotFoundError: The file does not exist.
        BagError: The file has none of these formats.
    """
    if log_exists(path) and os.path.getsize(path):
        return SqliteStorage(path, name)  # closing the file would end the locks of our writer
    with DatabaseFile.opened(path) as file:
        start = file.header()[: len(_SQLITE_MAGIC)]
    if start.startswith(MAGIC):
        return McapStorage(path, name)
    if start == _SQLITE_MAGIC:
        return SqliteStorage(path, name)
    if start.startswith(ROS1_MAGIC):
        return Ros1Storage(path, name)
    is_saved = start.startswith(_ZIP_MAGIC)
    raise BagError(f"{name or path} is neither an MCAP nor a sqlite3 file").with_hint(
        "If Buffer.save wrote it, read it with Buffer.load." if is_saved else ""
    )
