"""Writers of bags, message by message."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from rosbag2_py._compression_options import CompressionMode, CompressionOptions
from turtlewire.bag import BagWriter
from turtlewire.errors import BagError

if TYPE_CHECKING:
    from typing import Any

    from rosbag2_py._metadata import TopicMetadata
    from rosbag2_py._storage import ConverterOptions, StorageOptions

__all__ = [
    "SequentialCompressionWriter",
    "SequentialWriter",
    "get_registered_compressors",
    "get_registered_serializers",
    "get_registered_writers",
]

_SMALLEST_SPLIT = {"mcap": 1024, "sqlite3": 86_016}

#: What the presets of rosbag2's MCAP storage mean.
_PRESETS: dict[str, dict[str, Any]] = {
    "": {},
    "none": {},
    "fastwrite": {},
    "zstd_fast": {"compression": "zstd", "level": -5},
    "zstd_small": {"compression": "zstd", "level": 19, "chunk_bytes": 4 << 20},
    "resilient": {},
}


def get_registered_writers() -> set[str]:
    """The storages that can be written."""
    return {"mcap", "sqlite3"}


def get_registered_compressors() -> set[str]:
    """The compressions of whole files and single messages."""
    return {"zstd"}


def get_registered_serializers() -> set[str]:
    """Serialization formats other than the own one: there are none."""
    return set()


class SequentialWriter:
    """Writes a bag; `close` or ``del`` finishes it."""

    def __init__(self) -> None:
        self._writer: BagWriter | None = None
        self._mode = ""

    def __del__(self) -> None:
        self.close()

    def open(
        self, storage_options: StorageOptions, _converter_options: ConverterOptions | None = None
    ) -> None:
        """Begin a bag.

        Raises:
            RuntimeError: It exists, or the options do not fit.
        """
        storage = storage_options.storage_id or "mcap"
        size = storage_options.max_bagfile_size
        if size and size < (smallest := _SMALLEST_SPLIT.get(storage, 0)):
            raise RuntimeError(
                "Invalid bag splitting size given. "
                f"Please provide a value greater than {smallest}. Specified value of {size}"
            )
        if storage_options.storage_preset_profile not in _PRESETS:
            raise RuntimeError(
                f"unknown storage preset profile '{storage_options.storage_preset_profile}'"
            )
        preset = _PRESETS[storage_options.storage_preset_profile] if storage == "mcap" else {}
        try:
            self._writer = BagWriter(
                storage_options.uri,
                storage=storage,
                compression_mode=self._mode,
                max_file_bytes=size,
                max_file_ns=storage_options.max_bagfile_duration * 1_000_000_000,
                custom_data=storage_options.custom_data,
                ros_distro=os.environ.get("ROS_DISTRO", "jazzy"),
                **preset,
            )
        except FileExistsError as error:
            raise RuntimeError(
                f"Bag directory already exists ({storage_options.uri}), "
                "can't overwrite existing bag"
            ) from error
        except BagError as error:
            raise RuntimeError(str(error)) from error

    def _opened(self) -> BagWriter:
        if self._writer is None:
            raise RuntimeError("Bag is not open. Call open() before writing.")
        return self._writer

    def create_topic(self, topic_with_type: TopicMetadata) -> None:
        """Add a topic.

        Raises:
            RuntimeError: The bag is not open, or the topic exists with another type.
        """
        try:
            self._opened().add_topic(
                topic_with_type.name,
                topic_with_type.type,
                qos=[profile.to_wire() for profile in topic_with_type.offered_qos_profiles],
                hash_of_type=topic_with_type.type_description_hash or None,
            )
        except BagError as error:
            raise RuntimeError(str(error)) from error

    def remove_topic(self, topic_with_type: TopicMetadata) -> None:
        """Remove a topic without messages.

        Raises:
            RuntimeError: The bag is not open or has no such topic.
        """
        try:
            self._opened().remove_topic(topic_with_type.name)
        except BagError as error:
            raise RuntimeError(str(error)) from error

    def write(
        self, topic_name: str, message: bytes, recv_timestamp: int, send_timestamp: int = 0
    ) -> None:
        """Write the CDR bytes of a message.

        Args:
            topic_name: A topic that was created.
            message: The bytes.
            recv_timestamp: When it was received, nanoseconds since 1970.
            send_timestamp: When it was sent; 0 if it is not known.

        Raises:
            RuntimeError: The bag is not open or the topic was not created.
        """
        writer = self._opened()
        if topic_name not in writer.topics:
            raise RuntimeError(
                f"Failed to write on topic '{topic_name}'. Call create_topic() before first write."
            )
        writer.write(topic_name, bytes(message), recv_timestamp, send_timestamp or None)

    def split_bagfile(self) -> None:
        """Begin a new file."""
        self._opened().split()

    def take_snapshot(self) -> bool:
        """Write the messages that wait to the file; here they are always written."""
        self._opened().flush()
        return True

    def close(self) -> None:
        """Finish the bag; closing twice does nothing."""
        if self._writer is not None:
            self._writer.close()
            self._writer = None


class SequentialCompressionWriter(SequentialWriter):
    """A writer that compresses whole files or single messages.

    Raises:
        RuntimeError: The format is not zstd.
    """

    def __init__(self, compression_options: CompressionOptions | None = None) -> None:
        super().__init__()
        options = compression_options or CompressionOptions()
        if options.compression_mode is not CompressionMode.NONE:
            if options.compression_format not in get_registered_compressors():
                raise RuntimeError(f"unknown compression format '{options.compression_format}'")
            self._mode = options.compression_mode.name
