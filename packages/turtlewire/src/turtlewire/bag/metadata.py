"""``metadata.yaml`` of a bag, of every version from 1 to 9.

Source: rosbag2 (Jazzy, version 9). Versions differ in the keys that exist and in how the QoS of the
publishers is written: a text that holds YAML up to version 8, plain YAML since; numbers for the
policies up to 8, words since. The content determines the form, as in rosbag2.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import yaml

from turtlewire.bag.qos_yaml import (
    load_yaml,
    profiles_from_yaml,
    profiles_to_text,
    qos_to_yaml,
)
from turtlewire.errors import BagError
from turtlewire.new_file import new_file
from turtlewire.terminal.printable import printable

if TYPE_CHECKING:
    from turtlewire.wire.qos import QoS

__all__ = [
    "METADATA_FILE",
    "NEWEST_VERSION",
    "BagMetadata",
    "FileInfo",
    "TopicInfo",
    "dump_metadata",
    "full_type_name",
    "is_cdr",
    "is_decodable",
    "not_in_cdr",
    "parse_metadata",
    "read_metadata",
    "write_metadata",
]

METADATA_FILE = "metadata.yaml"
NEWEST_VERSION = 9

_KEY = "rosbag2_bagfile_information"
#: The version in which each key came, of those that were not there from the start.
_SINCE = {
    "compression_format": 3,
    "compression_mode": 3,
    "offered_qos_profiles": 4,
    "files": 5,
    "custom_data": 6,
    "type_description_hash": 7,
    "ros_distro": 8,
}
#: The start time that rosbag2 writes while there are no messages.
_UNKNOWN_START = (1 << 63) - 1
_MOST_NAMES = 10


class _Dumper(getattr(yaml, "CSafeDumper", yaml.SafeDumper)):  # type: ignore[misc]
    def ignore_aliases(self, _data: Any) -> bool:  # rosbag2's parser shall see no anchors
        return True


@dataclass
class TopicInfo:
    """A topic of a bag.

    Attributes:
        name: ``/tf``.
        type: ``tf2_msgs/msg/TFMessage``; ``tf2_msgs/TFMessage`` of other tools becomes the same.
        serialization_format: ``cdr``; may be empty.
        qos: What each publisher offered while recording; empty if the bag does not say.
        type_hash: ``RIHS01_…``; may be empty.
        message_count: How many messages of it the bag holds.
    """

    name: str
    type: str
    serialization_format: str = "cdr"
    qos: list[QoS] = field(default_factory=list)
    type_hash: str = ""
    message_count: int = 0

    def __post_init__(self) -> None:
        if is_cdr(self):
            self.type = full_type_name(self.type)


@dataclass
class FileInfo:
    """One file of a bag; times are the log times of its messages, in nanoseconds."""

    path: str
    start_ns: int = 0
    duration_ns: int = 0
    message_count: int = 0


@dataclass
class BagMetadata:
    """The topics, times and files of a bag.

    Attributes:
        storage: ``mcap`` or ``sqlite3``.
        paths: Its files, relative to the bag's folder.
        files: Times and counts of its files, in the same order; empty before version 5. Their
            paths do not have the ``.zstd`` of files that were compressed whole.
        topics: Its topics.
        start_ns: Log time of the oldest message, nanoseconds since 1970; 0 without messages.
        duration_ns: From the oldest to the newest message.
        message_count: Number of all messages.
        version: Version of the metadata, as it was read and as it is written.
        compression_format: ``zstd`` or empty: compression of whole files or single messages.
        compression_mode: ``FILE``, ``MESSAGE`` or empty.
        custom_data: What the user attached.
        ros_distro: ``jazzy``; empty if the bag does not say.
    """

    storage: str
    paths: list[str] = field(default_factory=list)
    files: list[FileInfo] = field(default_factory=list)
    topics: list[TopicInfo] = field(default_factory=list)
    start_ns: int = 0
    duration_ns: int = 0
    message_count: int = 0
    version: int = NEWEST_VERSION
    compression_format: str = ""
    compression_mode: str = ""
    custom_data: dict[str, str] = field(default_factory=dict)
    ros_distro: str = ""


def full_type_name(name: str) -> str:
    """Return the full name of a message: ``geometry_msgs/Point`` is ``geometry_msgs/msg/Point``."""
    return name.replace("/", "/msg/") if name.count("/") == 1 else name


def is_cdr(topic: TopicInfo) -> bool:
    """Return True if messages of a topic are in CDR; an encoding without a name counts."""
    return topic.serialization_format in ("cdr", "")


def is_decodable(topic: TopicInfo) -> bool:
    """Return True if messages of a topic are in CDR and of a type that the bag names."""
    return is_cdr(topic) and bool(topic.type)


def not_in_cdr(topics: Iterable[TopicInfo], consequence: str = "neither decoded nor shown") -> str:
    """Name the topics that cannot be decoded, with encoding and type; empty if all can.

    Args:
        topics: The topics, of which some may be decodable.
        consequence: What does not happen to the messages of the others.
    """
    others = sorted((each for each in topics if not is_decodable(each)), key=lambda each: each.name)
    foreign = [
        f"{each.name} ({each.serialization_format} {each.type})"
        for each in others
        if not is_cdr(each)
    ]
    nameless = [each.name for each in others if is_cdr(each)]
    sentences = []
    if foreign:
        sentences.append(
            f"Not in ROS 2's encoding, CDR, and therefore {consequence}: {_listed(foreign)}."
        )
    if nameless:
        sentences.append(
            f"Without a type in the bag, and therefore {consequence}: {_listed(nameless)}."
        )
    return printable(" ".join(sentences))


def _listed(names: list[str]) -> str:
    rest = f" and {len(names) - _MOST_NAMES} more" if len(names) > _MOST_NAMES else ""
    return f"{', '.join(names[:_MOST_NAMES])}{rest}"


def read_metadata(folder: str) -> BagMetadata | None:
    """Read ``metadata.yaml`` of a bag's folder; None if the folder has none.

    Raises:
        BagError: The file is there and cannot be understood.
    """
    path = os.path.join(folder, METADATA_FILE)
    try:
        with open(path, encoding="utf-8") as file:
            return _parse_file(file.read(), path)
    except FileNotFoundError:
        return None
    except UnicodeDecodeError as error:
        damage = BagError(f"{path}: not UTF-8 at byte {error.start}")
    except BagError as error:
        damage = error
    raise damage.with_hint(f"`ros2 bag reindex {folder}` rebuilds it from the bag's files.")


def _parse_file(text: str, path: str) -> BagMetadata:
    content = load_yaml(text, path)
    if not isinstance(content, dict) or not isinstance(content.get(_KEY), dict):
        raise BagError(f"{path}: the key '{_KEY}' is missing")
    return parse_metadata(content[_KEY], path)


def parse_metadata(content: dict[str, Any], where: str) -> BagMetadata:
    """Metadata from its YAML without the top key, as MCAP and sqlite3 files also embed it.

    Raises:
        BagError: A key is missing or has another type than it must have.
    """
    try:
        return _metadata(content)
    except (KeyError, TypeError, ValueError, OverflowError, AttributeError) as error:
        reason = f"the key {error} is missing" if isinstance(error, KeyError) else str(error)
        raise BagError(f"{where}: {reason}") from None


def _metadata(content: dict[str, Any]) -> BagMetadata:
    start = int(content["starting_time"]["nanoseconds_since_epoch"])
    return BagMetadata(
        storage=str(content["storage_identifier"]),
        paths=[str(path) for path in content["relative_file_paths"]],
        files=[_file(entry) for entry in content.get("files") or ()],
        topics=[_topic(entry) for entry in content["topics_with_message_count"] or ()],
        start_ns=0 if start == _UNKNOWN_START else start,
        duration_ns=int(content["duration"]["nanoseconds"]),
        message_count=_count(content),
        version=int(content["version"]),
        compression_format=content.get("compression_format") or "",
        compression_mode=(content.get("compression_mode") or "").upper().replace("NONE", ""),
        custom_data={str(k): str(v) for k, v in (content.get("custom_data") or {}).items()},
        ros_distro=content.get("ros_distro") or "",
    )


def _count(entry: dict[str, Any]) -> int:
    count = int(entry["message_count"])
    if not 0 <= count <= sys.maxsize:
        raise ValueError(f"there cannot be {count} messages")
    return count


def _file(entry: dict[str, Any]) -> FileInfo:
    return FileInfo(
        str(entry["path"]),
        int(entry["starting_time"]["nanoseconds_since_epoch"]),
        int(entry["duration"]["nanoseconds"]),
        _count(entry),
    )


def _topic(entry: dict[str, Any]) -> TopicInfo:
    topic = entry["topic_metadata"]
    return TopicInfo(
        str(topic["name"]),
        str(topic["type"]),
        topic.get("serialization_format") or "",
        profiles_from_yaml(topic.get("offered_qos_profiles"), f"QoS of {topic['name']}"),
        topic.get("type_description_hash") or "",
        _count(entry),
    )


def write_metadata(folder: str, metadata: BagMetadata) -> None:
    """Write ``metadata.yaml`` into a bag's folder: the whole of it, or nothing.

    Raises:
        OSError: The disk is full, for example. A former ``metadata.yaml`` stays as it was.
    """
    path = os.path.join(folder, METADATA_FILE)
    with new_file(path) as unfinished, open(unfinished, "w", encoding="utf-8") as file:
        file.write(f"{_KEY}:\n")
        file.writelines(f"  {line}\n" for line in dump_metadata(metadata).splitlines())


def dump_metadata(metadata: BagMetadata) -> str:
    """Return the YAML of the metadata's version without its top key."""
    # yaml-cpp reads an unquoted empty string as null and rejects it, so PyYAML's '' is right here.
    return yaml.dump(_as_yaml(metadata), Dumper=_Dumper, sort_keys=False, width=1 << 20)


def _as_yaml(metadata: BagMetadata) -> dict[str, Any]:
    content = {
        "version": metadata.version,
        "storage_identifier": metadata.storage,
        "duration": {"nanoseconds": metadata.duration_ns},
        "starting_time": {
            "nanoseconds_since_epoch": metadata.start_ns
            if metadata.message_count
            else _UNKNOWN_START
        },
        "message_count": metadata.message_count,
        "topics_with_message_count": [
            {
                "topic_metadata": _topic_as_yaml(topic, metadata.version),
                "message_count": topic.message_count,
            }
            for topic in metadata.topics
        ],
        "compression_format": metadata.compression_format,
        "compression_mode": metadata.compression_mode,
        "relative_file_paths": metadata.paths,
        "files": [
            {
                "path": file.path,
                "starting_time": {"nanoseconds_since_epoch": file.start_ns},
                "duration": {"nanoseconds": file.duration_ns},
                "message_count": file.message_count,
            }
            for file in metadata.files
        ],
        "custom_data": metadata.custom_data or None,
        "ros_distro": metadata.ros_distro,
    }
    return {key: value for key, value in content.items() if metadata.version >= _SINCE.get(key, 1)}


def _topic_as_yaml(topic: TopicInfo, version: int) -> dict[str, Any]:
    content: dict[str, Any] = {
        "name": topic.name,
        "type": topic.type,
        "serialization_format": topic.serialization_format,
        "offered_qos_profiles": profiles_to_text(topic.qos, version)
        if version < NEWEST_VERSION
        else [qos_to_yaml(qos, version) for qos in topic.qos],
        "type_description_hash": topic.type_hash,
    }
    return {key: value for key, value in content.items() if version >= _SINCE.get(key, 1)}
