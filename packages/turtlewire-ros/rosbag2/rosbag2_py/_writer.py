"""Writers of bags, message by message, with the presets and configuration files of storages."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from rclpy.logging import get_logger
from rosbag2_py._compression_options import CompressionMode, CompressionOptions
from rosbag2_py._storage import check_format
from turtlewire.bag import BagWriter
from turtlewire.bag.qos_yaml import load_yaml
from turtlewire.distro import current_distro
from turtlewire.errors import BagError

if TYPE_CHECKING:
    from rosbag2_py._metadata import TopicMetadata
    from rosbag2_py._storage import ConverterOptions, StorageOptions

# rosbag2's limits in bytes.
_SMALLEST_SPLIT = {"mcap": 1024, "sqlite3": 86_016}

#: What the presets of MCAP mean.
PRESETS: dict[str, dict[str, Any]] = {
    "": {},
    "none": {},
    "fastwrite": {"checksums": False},
    "zstd_fast": {"compression": "zstd", "level": -5, "checksums": False},
    "zstd_small": {"compression": "zstd", "level": 19, "chunk_bytes": 4 << 20},
}
#: The presets of sqlite3, whose files always survive a killed process.
_SQLITE_PRESETS = ("", "none", "resilient")

_MESSAGE_COMPRESSION = (
    "MCAP storage plugin does not support message compression, consider using chunk compression "
    "by setting `compression: 'Zstd'` in storage config"
)

_COMPRESSIONS = {"None": "", "Lz4": "lz4", "Zstd": "zstd"}
_LEVELS = {"Fastest": -5, "Fast": -3, "Default": 1, "Slow": 5, "Slowest": 19}
#: Keys of a configuration of MCAP that change nothing here: indexes and summary are always written.
_WITHOUT_EFFECT = {
    *("noAttachmentCRC", "enableDataCRC", "noSummaryCRC", "noChunking", "noMessageIndex"),
    *("noSummary", "forceCompression", "noRepeatedSchemas", "noRepeatedChannels"),
    *("noAttachmentIndex", "noMetadataIndex", "noChunkIndex", "noStatistics", "noSummaryOffsets"),
}


def get_registered_writers() -> set[str]:
    """Return the storages that can be written."""
    return {"mcap", "sqlite3"}


def get_registered_compressors() -> set[str]:
    """Return the compressions of whole files and single messages."""
    return {"zstd"}


def get_registered_serializers() -> set[str]:
    """Return the serialization formats other than cdr: none exist."""
    return set()


class SequentialWriter:
    """Writes a bag; `close`, ``del`` or the end of the program finishes it."""

    def __init__(self) -> None:
        self._writer: BagWriter | None = None
        self._mode = ""

    def open(
        self, storage_options: StorageOptions, converter_options: ConverterOptions | None = None
    ) -> None:
        """Begin a bag.

        Raises:
            RuntimeError: The bag already exists, the options are incompatible, or a format is
                unknown.
        """
        if converter_options is not None:
            check_format(converter_options.input_serialization_format)
            check_format(converter_options.output_serialization_format)
        self._writer = make_writer(storage_options, self._mode)

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


def make_writer(storage_options: StorageOptions, compression_mode: str) -> BagWriter:
    """Return a new bag.

    Args:
        storage_options: Where and how.
        compression_mode: ``FILE``, ``MESSAGE`` or empty.

    Raises:
        RuntimeError: The bag already exists, or the options are incompatible.
    """
    storage = storage_options.storage_id or "mcap"
    size = storage_options.max_bagfile_size
    if size and size < (smallest := _SMALLEST_SPLIT.get(storage, 0)):
        raise RuntimeError(
            "Invalid bag splitting size given. "
            f"Please provide a value greater than {smallest}. Specified value of {size}"
        )
    if compression_mode == "MESSAGE" and storage == "mcap":
        raise RuntimeError(_MESSAGE_COMPRESSION)
    try:
        writer = BagWriter(
            storage_options.uri,
            storage=storage,
            compression_mode=compression_mode,
            max_file_bytes=size,
            max_file_ns=storage_options.max_bagfile_duration * 1_000_000_000,
            max_files=storage_options.max_bag_files,
            custom_data=storage_options.custom_data,
            ros_distro=str(current_distro()),
            **(_mcap_options(storage_options) if storage == "mcap" else {}),
        )
    except FileExistsError as error:
        raise RuntimeError(
            f"Bag directory already exists ({storage_options.uri}), can't overwrite existing bag"
        ) from error
    except OSError as error:
        raise RuntimeError(f"cannot make the bag {storage_options.uri}: {error}") from error
    except BagError as error:
        raise RuntimeError(str(error)) from error
    if storage == "sqlite3":
        if storage_options.storage_preset_profile not in _SQLITE_PRESETS:
            get_logger("rosbag2_storage").warning(
                f"sqlite3 has no preset profile '{storage_options.storage_preset_profile}', "
                "which is ignored; it has none and resilient"
            )
        path = os.path.join(storage_options.uri, os.path.basename(writer.file_path))
        get_logger("rosbag2_storage").info(f"Opened database '{path}' for READ_WRITE.")
    return writer


def _mcap_options(storage_options: StorageOptions) -> dict[str, Any]:
    preset = storage_options.storage_preset_profile
    if preset not in PRESETS:
        raise RuntimeError(
            f"unknown MCAP storage preset profile '{preset}'; choose from "
            f"{', '.join(name for name in PRESETS if name)}"
        )
    options = dict(PRESETS[preset])
    if storage_options.storage_config_uri:
        options.update(_configuration(storage_options.storage_config_uri))
    return options


def _configuration(path: str) -> dict[str, Any]:
    """Read a file with options of MCAP."""
    with open(path, encoding="utf-8") as file:
        content = load_yaml(file.read(), path) or {}
    if not isinstance(content, dict):
        raise BagError(f"{path}: expected keys and values, got a {type(content).__name__}")
    options: dict[str, Any] = {}
    for key, value in content.items():
        if key == "compression":
            options["compression"] = _choice(path, key, value, _COMPRESSIONS)
        elif key == "compressionLevel":
            options["level"] = _choice(path, key, value, _LEVELS)
        elif key == "chunkSize":
            options["chunk_bytes"] = int(value)
        elif key == "noChunkCRC":
            options["checksums"] = not value
        elif key not in _WITHOUT_EFFECT:
            raise BagError(f"{path}: unknown key '{key}'")
    return options


def _choice(path: str, key: str, value: Any, choices: dict[str, Any]) -> Any:
    if value not in choices:
        raise BagError(f"{path}: {key} is one of {', '.join(choices)}, not {value!r}")
    return choices[value]
