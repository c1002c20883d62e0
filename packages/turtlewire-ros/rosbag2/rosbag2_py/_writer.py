"""Writers of bags, message by message."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosbag2_py._compression_options import CompressionMode, CompressionOptions
from rosbag2_py._open_writer import make_writer
from rosbag2_py._storage import check_format
from turtlewire.errors import BagError

if TYPE_CHECKING:
    from rosbag2_py._metadata import TopicMetadata
    from rosbag2_py._storage import ConverterOptions, StorageOptions
    from turtlewire.bag import BagWriter


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
