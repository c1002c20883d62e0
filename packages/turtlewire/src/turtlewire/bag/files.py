"""The files that a bag consists of: their names, their order, and what they hold together."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from turtlewire.bag.metadata import BagMetadata, FileInfo, TopicInfo

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["joined", "overlapping", "storage_files"]


def storage_files(folder: str) -> list[str]:
    """Return the storage files of a folder without metadata, in the order of their numbers."""
    endings = (".mcap", ".db3", ".mcap.zstd", ".db3.zstd")
    names = [name for name in os.listdir(folder) if name.endswith(endings)]
    return sorted(names, key=lambda name: (_number(name), name))


def _number(name: str) -> int:
    """Return the number at the end of ``my_bag_12.mcap``; -1 without one."""
    number = name.split(".", maxsplit=1)[0].rpartition("_")[2]
    return int(number) if number.isdecimal() else -1


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
