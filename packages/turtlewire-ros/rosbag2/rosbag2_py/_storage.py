"""Options and descriptions of bags, as the C++ classes that rosbag2_py exposes."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from datetime import timedelta
from typing import TYPE_CHECKING

from rclpy.duration import Duration
from rclpy.qos import QoSProfile
from rclpy.time import Time
from rosbag2_py._metadata import (
    BagMetadata,
    FileInformation,
    TopicInformation,
    TopicMetadata,
)
from rosbag2_transport.options import NumberedEnum
from turtlewire.bag import metadata as engine
from turtlewire.bag.qos_yaml import profiles_from_yaml
from turtlewire.errors import BagError

if TYPE_CHECKING:
    from turtlewire.wire.qos import QoS


def get_default_storage_id() -> str:
    """Return the storage of new bags: ``mcap``."""
    return "mcap"


@dataclass(slots=True)
class StorageOptions:
    """The path of a bag and the options of its storage.

    Attributes:
        uri: Folder of the bag, or one of its files.
        storage_id: ``mcap`` or ``sqlite3``; empty to find out when reading.
        max_bagfile_size: Size in bytes at which a new file begins; 0 for never.
        max_bagfile_duration: Seconds after which a new file begins; 0 for never.
        max_cache_size: Bytes kept back before writing; 0 writes at once.
        storage_preset_profile: For MCAP ``fastwrite``, ``zstd_fast`` or ``zstd_small``.
        storage_config_uri: A YAML file with options of the storage.
        snapshot_mode: Whether only snapshots are written.
        start_time_ns: Log time of the first message that is converted; negative for all.
        end_time_ns: Log time of the last message that is converted; negative for all.
        custom_data: Texts kept in the metadata.
        max_bag_files: The oldest file is removed when there would be more than this number; 0 keeps
            all.
        max_cache_duration: Seconds that the messages of a snapshot may span; 0 for no limit.
            Without snapshots it has no effect, because all is written within half a second.
    """

    uri: str
    storage_id: str = ""
    max_bagfile_size: int = 0
    max_bagfile_duration: int = 0
    max_cache_size: int = 0
    storage_preset_profile: str = ""
    storage_config_uri: str = ""
    snapshot_mode: bool = False
    start_time_ns: int = -1
    end_time_ns: int = -1
    custom_data: dict[str, str] = field(default_factory=dict)
    max_bag_files: int = 0
    max_cache_duration: int = 0


@dataclass(slots=True)
class ConverterOptions:
    """Serialization formats: only ``cdr``, or an empty string for it."""

    input_serialization_format: str = ""
    output_serialization_format: str = ""


def check_format(name: str) -> None:
    """Reject serialization formats other than ``cdr`` and an empty string.

    Raises:
        RuntimeError: No converter exists for the format.
    """
    if name not in ("", "cdr"):
        raise RuntimeError(f"Could not find converter for format {name}; there is only cdr")


@dataclass(slots=True)
class StorageFilter:
    """A filter of the messages that a reader returns; empty fields do not restrict it.

    Attributes:
        topics: Names of topics. Service events pass as long as ``services_events`` is empty.
        services_events: Names of service event topics.
        regex: A pattern that matches whole names.
        exclude_topics: Names of topics that are left out.
        exclude_service_events: Names of service event topics that are left out.
        regex_to_exclude: A pattern that matches whole names that are left out.
    """

    topics: list[str] = field(default_factory=list)
    services_events: list[str] = field(default_factory=list)
    regex: str = ""
    exclude_topics: list[str] = field(default_factory=list)
    exclude_service_events: list[str] = field(default_factory=list)
    regex_to_exclude: str = ""


class ReadOrderSortBy(NumberedEnum):
    """The time that orders messages."""

    ReceivedTimestamp = 0
    PublishedTimestamp = 1
    File = 2


@dataclass(slots=True)
class ReadOrder:
    """The order in which a reader returns messages."""

    sort_by: ReadOrderSortBy = ReadOrderSortBy.ReceivedTimestamp
    reverse: bool = False


@dataclass(slots=True)
class MessageDefinition:
    """The definition of a type, as a bag carries it."""

    topic_type: str
    encoding: str
    encoded_message_definition: str
    type_hash: str


class MetadataIo:
    """Reads and writes ``metadata.yaml``."""

    def read_metadata(self, uri: str) -> BagMetadata:
        """Return the metadata of a bag's folder.

        Raises:
            RuntimeError: The metadata is missing or invalid.
        """
        try:
            found = engine.read_metadata(uri)
        except BagError as error:
            raise RuntimeError(f"Exception on parsing info file: {error}") from error
        if found is None:
            raise RuntimeError(f"Could not read metadata for {uri}: there is no metadata.yaml")
        return from_engine(found, folder_size(uri))

    def write_metadata(self, uri: str, metadata: BagMetadata) -> None:
        """Write the metadata into a bag's folder."""
        engine.write_metadata(uri, to_engine(metadata))

    def metadata_file_exists(self, uri: str) -> bool:
        """Return True if a folder has metadata."""
        return os.path.exists(os.path.join(uri, engine.METADATA_FILE))

    def serialize_metadata(self, metadata: BagMetadata) -> str:
        """Return the metadata as YAML."""
        return engine.dump_metadata(to_engine(metadata))

    def deserialize_metadata(self, serialized_metadata: str) -> BagMetadata:
        """Return the metadata in YAML.

        Raises:
            RuntimeError: The metadata are invalid.
        """
        from turtlewire.bag.qos_yaml import load_yaml

        try:
            content = load_yaml(serialized_metadata, "the metadata")
            # A text has no files, so the size is unknown.
            return from_engine(engine.parse_metadata(content, "the metadata"), 0)
        except BagError as error:
            raise RuntimeError(str(error)) from error


def to_rclcpp_qos_vector(qos_profiles: str, _version: int) -> list[QoSProfile]:
    """Return the profiles in a bag's YAML; its policies may be words or numbers, by version."""
    return [profile_of(qos) for qos in profiles_from_yaml(qos_profiles, "the QoS profiles")]


def convert_rclcpp_qos_to_rclpy_qos(qos: QoSProfile) -> QoSProfile:
    """Return the profile itself: there is no second class for C++ here."""
    return qos


def profile_of(qos: QoS) -> QoSProfile:
    """Return a recorded QoS as rclpy's class."""
    return QoSProfile.from_wire(qos)


def folder_size(path: str) -> int:
    """Return the bytes of a file, or of all files in a folder."""
    if not os.path.isdir(path):
        return os.path.getsize(path)
    return sum(entry.stat().st_size for entry in os.scandir(path) if entry.is_file())


def from_engine(metadata: engine.BagMetadata, size: int) -> BagMetadata:
    """Return the engine's metadata as rosbag2's class."""
    return BagMetadata(
        version=metadata.version,
        bag_size=size,
        storage_identifier=metadata.storage,
        relative_file_paths=list(metadata.paths),
        files=[
            FileInformation(
                file.path,
                Time(nanoseconds=file.start_ns),
                # As in rosbag2, whose durations of files have no nanoseconds.
                timedelta(microseconds=file.duration_ns // 1000),
                file.message_count,
            )
            for file in metadata.files
        ],
        duration=Duration(nanoseconds=metadata.duration_ns),
        starting_time=Time(nanoseconds=metadata.start_ns),
        message_count=metadata.message_count,
        topics_with_message_count=[
            TopicInformation(topic_of(number, topic), topic.message_count)
            for number, topic in enumerate(metadata.topics)
        ],
        compression_format=metadata.compression_format,
        compression_mode=metadata.compression_mode,
        custom_data=dict(metadata.custom_data),
        ros_distro=metadata.ros_distro,
    )


def topic_of(number: int, topic: engine.TopicInfo) -> TopicMetadata:
    """Return the engine's topic as rosbag2's class."""
    return TopicMetadata(
        number,
        topic.name,
        topic.type,
        topic.serialization_format,
        [profile_of(qos) for qos in topic.qos],
        topic.type_hash,
    )


def to_engine(metadata: BagMetadata) -> engine.BagMetadata:
    """Return rosbag2's metadata as the engine's class."""
    return engine.BagMetadata(
        storage=metadata.storage_identifier,
        paths=list(metadata.relative_file_paths),
        files=[
            engine.FileInfo(
                file.path,
                file.starting_time.nanoseconds,
                file.duration // timedelta(microseconds=1) * 1000,
                file.message_count,
            )
            for file in metadata.files
        ],
        topics=[
            engine.TopicInfo(
                item.topic_metadata.name,
                item.topic_metadata.type,
                item.topic_metadata.serialization_format,
                [profile.to_wire() for profile in item.topic_metadata.offered_qos_profiles],
                item.topic_metadata.type_description_hash,
                item.message_count,
            )
            for item in metadata.topics_with_message_count
        ],
        start_ns=metadata.starting_time.nanoseconds,
        duration_ns=metadata.duration.nanoseconds,
        message_count=metadata.message_count,
        version=metadata.version,
        compression_format=metadata.compression_format,
        compression_mode=metadata.compression_mode,
        custom_data=dict(metadata.custom_data),
        ros_distro=metadata.ros_distro,
    )
