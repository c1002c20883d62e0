"""A bag to write: a folder that rosbag2, Foxglove and others read."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from turtlewire.bag.compression import write_zstd_file
from turtlewire.bag.mcap_writer import CHUNK_BYTES, McapWriter
from turtlewire.bag.metadata import (
    NEWEST_VERSION,
    BagMetadata,
    FileInfo,
    TopicInfo,
    dump_metadata,
    write_metadata,
)
from turtlewire.bag.qos_yaml import profiles_to_text
from turtlewire.bag.sqlite_writer import SqliteWriter, merge_by_copy
from turtlewire.bag.writer_checks import (
    ENDINGS,
    as_cdr,
    check_options,
    check_sizes,
    compressed_message,
    known_definition,
)
from turtlewire.errors import BagError, InterfaceError
from turtlewire.msg import type_hash
from turtlewire.tf.datetimes import as_nanoseconds

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from types import TracebackType

    from typing_extensions import Self

    from turtlewire.msg import Message
    from turtlewire.wire.qos import QoS

__all__ = ["BagWriter"]


class BagWriter:
    """Writes a bag; use it in a ``with`` statement or call `close`.

    ::

        with turtlewire.bag.BagWriter("out") as writer:
            writer.add_topic("/chatter", "std_msgs/msg/String")
            writer.write("/chatter", String(data="hi"), log_time_ns=1_000_000_000)

    Not thread-safe.

    Args:
        path: The folder to make; it must not exist.
        storage: ``"mcap"`` or ``"sqlite3"``.
        compression: Compression of an MCAP file's chunks: ``""``, ``"zstd"`` or ``"lz4"``.
        level: Compression level of zstd.
        chunk_bytes: Size of a chunk of an MCAP file before compression.
        compression_mode: ``"FILE"`` compresses each finished file with zstd as a whole,
            ``"MESSAGE"`` each message (sqlite3 only), as rosbag2 does; ``""`` does neither.
        max_file_bytes: A new file begins when one has this size; 0 for one file.
        max_file_ns: A new file begins after this much recorded time; 0 for one file.
        checksums: Whether chunks of an MCAP file carry a CRC-32.
        custom_data: Texts to keep in the metadata.
        ros_distro: Name of the distribution in the metadata.
        metadata_version: 1 to 9; older versions have fewer keys and write QoS as numbers.

    Attributes:
        path: The folder, absolute.
        metadata: What the finished files hold.
        on_split: Called with the paths of the finished and of the new file when a file begins
            because the one before has its size or lasts long enough.
        on_compress: Called with the path of a finished file before it is compressed as a whole.

    Raises:
        FileExistsError: ``path`` exists.
        BagError: A combination of arguments that rosbag2 does not know.
    """

    def __init__(
        self,
        path: str | os.PathLike[str],
        *,
        storage: str = "mcap",
        compression: str = "",
        level: int = 1,
        chunk_bytes: int = CHUNK_BYTES,
        compression_mode: str = "",
        max_file_bytes: int = 0,
        max_file_ns: int = 0,
        checksums: bool = True,
        custom_data: dict[str, str] | None = None,
        ros_distro: str = "",
        metadata_version: int = NEWEST_VERSION,
    ) -> None:
        check_options(storage, compression, level, compression_mode, metadata_version)
        check_sizes(chunk_bytes, max_file_bytes, max_file_ns)
        self.path = os.path.abspath(os.fspath(path))
        self._chunks: dict[str, Any] = {
            "compression": compression,
            "level": level,
            "chunk_bytes": chunk_bytes,
            "checksums": checksums,
        }
        self.on_split: Callable[[str, str], None] | None = None
        self.on_compress: Callable[[str], None] | None = None
        self._max_file_bytes = max_file_bytes
        self._max_file_ns = max_file_ns
        self._splits = bool(max_file_bytes or max_file_ns)
        self._compresses_messages = compression_mode == "MESSAGE"
        self._topics: dict[str, TopicInfo] = {}
        self._definitions: dict[str, tuple[str, str]] = {}
        self._ids: dict[str, int] = {}
        self._file_start_ns: int | None = None
        self.metadata = BagMetadata(
            storage,
            version=metadata_version,
            compression_format="zstd" if compression_mode else "",
            compression_mode=compression_mode,
            custom_data=dict(custom_data or {}),
            ros_distro=ros_distro,
        )
        os.makedirs(self.path)
        self._file: McapWriter | SqliteWriter | None = self._open_file()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        _type: type[BaseException] | None,
        _error: BaseException | None,
        _traceback: TracebackType | None,
    ) -> None:
        self.close()

    @property
    def topics(self) -> dict[str, TopicInfo]:
        """The topics that were added, by name."""
        return dict(self._topics)

    @property
    def file_path(self) -> str:
        """The file that is being written.

        Raises:
            BagError: The bag is closed.
        """
        return self._open().path

    def add_topic(
        self,
        name: str,
        type_name: str,
        *,
        qos: Sequence[QoS] = (),
        hash_of_type: str | None = None,
        definition: tuple[str, str] | None = None,
    ) -> None:
        """Add a topic; adding the same one again changes nothing.

        Args:
            name: ``"/tf"``.
            type_name: ``"tf2_msgs/msg/TFMessage"``.
            qos: What its publishers offer.
            hash_of_type: ``"RIHS01_…"``; None computes it from the definition.
            definition: Encoding and text of the type's definition; None takes the known type's.

        Raises:
            BagError: The topic has another type already, or the type name is invalid.

        Warns:
            UserWarning: The type is not known; the bag gets no definition of it.
        """
        known = self._topics.get(name)
        if known is not None:
            if known.type != type_name:
                raise BagError(f"{name} has the type {known.type} already, not {type_name}")
            return
        if definition is None:
            definition = known_definition(type_name)
        if hash_of_type is None:
            hash_of_type = _known_hash(type_name)
        self._definitions[type_name] = definition
        topic = TopicInfo(name, type_name, "cdr", list(qos), hash_of_type)
        self._topics[name] = topic
        self._ids[name] = self._define(self._open(), topic)

    def remove_topic(self, name: str) -> None:
        """Take a topic without messages out of the bag's metadata.

        Raises:
            BagError: The topic was not added.
        """
        if self._topics.pop(name, None) is None:
            raise BagError(f"the topic '{name}' was not added")
        del self._ids[name]

    def write(
        self,
        topic: str,
        data: bytes | Message,
        log_time_ns: int,
        publish_time_ns: int | None = None,
    ) -> None:
        """Write one message.

        Args:
            topic: A topic that was added.
            data: The message, or its CDR bytes.
            log_time_ns: When it was received, nanoseconds since 1970 or a ``datetime64``.
            publish_time_ns: When it was sent; None if it is not known.

        Raises:
            BagError: The topic was not added, the bag is closed, there are no bytes, or a message
                to compress is larger than readers take.
            TypeError: The data are neither bytes nor a message of the type, or a time is not a
                number.
            ValueError: A time lies before 1970.
            OSError: The disk is full, for example. What was written before stays readable.
        """
        number = self._ids.get(topic)
        if number is None or self._file is None:
            self._open()
            raise BagError(f"the topic '{topic}' was not added").with_hint(
                "Call add_topic() first."
            )
        if not (data and isinstance(data, bytes)):
            data = as_cdr(topic, self._topics[topic].type, data)
        if type(log_time_ns) is not int or log_time_ns < 0:
            log_time_ns = _stamp(log_time_ns, "log_time_ns")
        if publish_time_ns and (type(publish_time_ns) is not int or publish_time_ns < 0):
            publish_time_ns = _stamp(publish_time_ns, "publish_time_ns")
        if self._compresses_messages:
            data = compressed_message(topic, data)
        if self._splits:
            self._split_if_due(self._file, log_time_ns)
            number = self._ids[topic]
        self._file.write(number, log_time_ns, publish_time_ns or log_time_ns, data)

    def flush(self) -> None:
        """Hand all messages to the operating system: they survive this process."""
        self._open().flush()

    def split(self) -> tuple[str, str]:
        """Finish the current file and begin another.

        Returns:
            Paths of the finished and of the new file.
        """
        finished = self._finish_file(self._open())
        self._file = self._open_file()
        self._file_start_ns = None
        for name, topic in self._topics.items():
            self._ids[name] = self._define(self._file, topic)
        return finished, self._file.path

    def close(self) -> None:
        """Finish the file and write ``metadata.yaml``; closing twice does nothing.

        Raises:
            OSError: The disk is full, for example. What was written before stays readable.
        """
        if self._file is not None:
            file, self._file = self._file, None
            try:
                self._finish_file(file)
            finally:
                write_metadata(self.path, self._whole_metadata())

    # -- one file

    def _open(self) -> McapWriter | SqliteWriter:
        if self._file is None:
            raise BagError(f"{self.path} is closed")
        return self._file

    def _open_file(self) -> McapWriter | SqliteWriter:
        storage = self.metadata.storage
        number = len(self.metadata.paths)
        name = f"{os.path.basename(self.path)}_{number}.{ENDINGS[storage]}"
        path = os.path.join(self.path, name)
        file = (
            McapWriter(path, **self._chunks)
            if storage == "mcap"
            else SqliteWriter(path, self.metadata.ros_distro)
        )
        self._embed(file, self._whole_metadata())
        return file

    def _define(self, file: McapWriter | SqliteWriter, topic: TopicInfo) -> int:
        """Register a topic in a file; returns its number there."""
        encoding, text = self._definitions[topic.type]
        qos = profiles_to_text(topic.qos, self.metadata.version)
        if isinstance(file, SqliteWriter):
            file.add_definition(topic.type, encoding, text, topic.type_hash)
            return file.add_topic(topic.name, topic.type, qos, topic.type_hash)
        schema = file.add_schema(topic.type, encoding, text.encode())
        metadata = {"offered_qos_profiles": qos, "topic_type_hash": topic.type_hash}
        return file.add_channel(schema, topic.name, metadata)

    def _split_if_due(self, file: McapWriter | SqliteWriter, log_time_ns: int) -> None:
        """Begin a new file with the message of this time if the current one is full."""
        if self._file_start_ns is None:
            self._file_start_ns = log_time_ns
        lasts = log_time_ns - self._file_start_ns
        if (self._max_file_bytes and file.size >= self._max_file_bytes) or (
            self._max_file_ns and lasts > self._max_file_ns
        ):
            paths = self.split()
            self._file_start_ns = log_time_ns
            if self.on_split is not None:
                self.on_split(*paths)

    def _finish_file(self, file: McapWriter | SqliteWriter) -> str:
        """Close a file and take it into the metadata; returns its path.

        What waits and cannot be written is lost, the rest is finished before the error is raised.
        """
        try:
            try:
                file.flush()
            finally:
                self._enter(file)
                self._embed(file, self._whole_metadata())
        finally:
            file.close()
        if self.metadata.compression_mode == "FILE":
            if self.on_compress is not None:
                self.on_compress(file.path)
            merge_by_copy(file.path)
            write_zstd_file(file.path, file.path + ".zstd")
            os.remove(file.path)
            self.metadata.paths[-1] += ".zstd"
        return os.path.join(self.path, self.metadata.paths[-1])

    def _enter(self, file: McapWriter | SqliteWriter) -> None:
        """Take what a file holds into the metadata."""
        file.discard()
        counts = file.channel_counts if isinstance(file, McapWriter) else file.topic_counts
        for name, topic in self._topics.items():
            topic.message_count += counts.get(self._ids[name], 0)
        name = os.path.basename(file.path)
        start = file.start_ns if file.message_count else 0
        duration = file.end_ns - start
        self.metadata.files.append(FileInfo(name, start, duration, file.message_count))
        self.metadata.paths.append(name)

    def _embed(self, file: McapWriter | SqliteWriter, metadata: BagMetadata) -> None:
        text = dump_metadata(metadata)
        if isinstance(file, SqliteWriter):
            file.write_metadata(metadata.version, text)
        else:
            file.write_metadata("rosbag2", {"serialized_metadata": text})

    def _whole_metadata(self) -> BagMetadata:
        """Return the metadata with the totals of the files that are finished."""
        filled = [file for file in self.metadata.files if file.message_count]
        start = min((file.start_ns for file in filled), default=0)
        end = max((file.start_ns + file.duration_ns for file in filled), default=0)
        self.metadata.start_ns, self.metadata.duration_ns = start, end - start
        self.metadata.message_count = sum(file.message_count for file in filled)
        self.metadata.topics = list(self._topics.values())
        return self.metadata


def _stamp(time: Any, argument: str) -> int:
    """Return a time as an integer, which can be written."""
    stamp = as_nanoseconds(time, argument)
    if stamp < 0:
        raise ValueError(f"{argument} is {stamp}: bags have no times before 1970")
    return stamp


def _known_hash(type_name: str) -> str:
    try:
        return type_hash(type_name)
    except InterfaceError:
        return ""
