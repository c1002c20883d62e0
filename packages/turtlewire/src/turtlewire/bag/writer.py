"""A bag to write: a folder that rosbag2, Foxglove and others read."""

from __future__ import annotations

import atexit
import errno
import os
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING, Any
from weakref import WeakSet

from turtlewire.bag.compression import write_zstd_file
from turtlewire.bag.definitions import known_hash
from turtlewire.bag.files import file_name
from turtlewire.bag.mcap_writer import CHUNK_BYTES, McapWriter
from turtlewire.bag.message import channel_of_text
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
    check_name,
    check_options,
    check_sizes,
    checked_type_name,
    compressed_message,
    given,
    known_definition,
)
from turtlewire.call_errors import hint_at
from turtlewire.errors import BagError
from turtlewire.path_arguments import path_text
from turtlewire.tf.datetimes import as_nanoseconds
from turtlewire.tf.tf_topics import refuse_other_types

if TYPE_CHECKING:
    from typing_extensions import Self

    from turtlewire.bag.mcap_records import RawChunk, Schema
    from turtlewire.bag.message import BagChannel
    from turtlewire.msg import Message
    from turtlewire.tf.datetimes import Stamp
    from turtlewire.wire.qos import QoS

__all__ = ["BagWriter"]

#: The latest time that a file has, by storage.
_LAST_TIMES = {"mcap": (1 << 64) - 1, "sqlite3": (1 << 63) - 1}


# Weak, because `__del__` finishes a writer without references.
_open_writers: WeakSet[BagWriter] = WeakSet()


@atexit.register
def _close_writers() -> None:
    """Finish the bags of a program that ends; in ``__del__`` it would be too late for files."""
    for writer in list(_open_writers):
        writer.__del__()


@hint_at(
    {
        "add_connection create_topic register_schema register_channel": "add_topic",
        "write_message add_message put": "write(topic, message, log_time_ns=...)",
        "finish": "close()",
    }
)
class BagWriter:
    """Writes a bag; use it in a ``with`` statement or call `close`.

    A writer that was not closed is closed when it is deleted or the program ends; errors, of a full
    disk for example, are only printed then. A program that is killed leaves a bag without an index,
    which ``ros2 bag reindex`` repairs.

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
        max_files: The oldest file is removed when there would be more than this number; 0 keeps
            all.
        checksums: Whether chunks of an MCAP file carry a CRC-32.
        custom_data: Texts to keep in the metadata.
        ros_distro: Name of the distribution in the metadata; ``"lyrical"`` also names files as
            Lyrical does, with a number in front and the time behind.
        metadata_version: 1 to 9; older versions have fewer keys and write QoS as numbers.

    Attributes:
        path: The folder, absolute.
        metadata: What the finished files hold.
        on_split: Called with the paths of the finished and of the new file when a file begins
            because the one before has its size or lasts long enough.
        on_begin: Called before the first message of such a file, with its log time.
        on_compress: Called with the path of a finished file before it is compressed as a whole.

    Raises:
        FileExistsError: ``path`` exists.
        BagError: A combination of arguments that rosbag2 does not know.
    """

    _file: McapWriter | SqliteWriter | None = None
    _process = 0

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
        max_files: int = 0,
        checksums: bool = True,
        custom_data: dict[str, str] | None = None,
        ros_distro: str = "",
        metadata_version: int = NEWEST_VERSION,
    ) -> None:
        check_options(storage, compression, level, compression_mode, metadata_version)
        check_sizes(chunk_bytes, max_file_bytes, max_file_ns, max_files)
        self.path = os.path.abspath(path_text(path, what="path of a new folder"))
        check_name(os.path.basename(self.path))
        self._chunks: dict[str, Any] = {
            "compression": compression,
            "level": level,
            "chunk_bytes": chunk_bytes,
            "checksums": checksums,
        }
        self.on_split: Callable[[str, str], None] | None = None
        self.on_begin: Callable[[int], None] | None = None
        self.on_compress: Callable[[str], None] | None = None
        self._last_time = _LAST_TIMES[storage]
        self._max_file_bytes = max_file_bytes
        self._max_file_ns = max_file_ns
        self._splits = bool(max_file_bytes or max_file_ns)
        self._max_files = max_files
        self._opened_files = 0
        self._counts_of_files: list[dict[str, int]] = []
        self._compresses_messages = compression_mode == "MESSAGE"
        self._channels: dict[str, BagChannel] = {}
        self._ids: dict[str, int] = {}
        self._schemas: dict[Schema, int] = {}
        self._file_start_ns: int | None = None
        self.metadata = BagMetadata(
            storage,
            version=metadata_version,
            compression_format="zstd" if compression_mode else "",
            compression_mode=compression_mode,
            custom_data=dict(custom_data or {}),
            ros_distro=ros_distro,
        )
        _make_folder(self.path)
        self._process = os.getpid()
        self._file = self._open_file()
        _open_writers.add(self)

    def __del__(self) -> None:
        if self._process == os.getpid():  # a copy in a forked process must not write to the file
            self.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_error: object) -> None:
        self.close()

    @property
    def topics(self) -> dict[str, TopicInfo]:
        """The topics that were added, by name."""
        return {topic.name: topic for topic in _by_name(self._channels.values())}

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
            definition: Encoding and text of the type's definition; None uses the known type's.

        Raises:
            BagError: The topic has another type already, or the type name is invalid.

        Warns:
            UserWarning: The type is not known; the bag gets no definition of it.
        """
        type_name = checked_type_name(type_name)
        known = self._channels.get(name)
        if known is not None:
            if known.topic.type != type_name:
                raise BagError(f"{name} has the type {known.topic.type} already, not {type_name}")
            return
        if definition is None:
            definition = known_definition(type_name)
        if hash_of_type is None:
            hash_of_type = known_hash(type_name)
        topic = TopicInfo(name, type_name, "cdr", list(qos), hash_of_type)
        self.add_channel(name, channel_of_text(topic, definition))

    def add_channel(self, key: str, channel: BagChannel) -> bool:
        """Add a topic as another bag has it, for `append` and `copy_chunk`.

        Args:
            key: Names the channel; a topic with two definitions has two channels.
            channel: The topic and its definition.

        Returns:
            True if the channel and its schema have the same numbers as in the other MCAP file.

        Raises:
            BagError: The bag is closed.
        """
        file = self._open()
        own = replace(channel, topic=replace(channel.topic, message_count=0))
        self._channels[key] = own
        self._ids[key] = self._define(file, own)
        schema, record = channel.schema, channel.record
        return (
            record is not None
            and record.id == self._ids[key]
            and schema.id == self._schemas.get(schema, 0)
        )

    def remove_topic(self, name: str) -> None:
        """Take a topic without messages out of the bag's metadata.

        Raises:
            BagError: The topic was not added.
        """
        if self._channels.pop(name, None) is None:
            raise BagError(f"the topic '{name}' was not added")
        del self._ids[name]

    def write(
        self,
        topic: str,
        data: bytes | Message,
        log_time_ns: Stamp,
        publish_time_ns: Stamp | None = None,
    ) -> None:
        """Write one message.

        Args:
            topic: A topic that was added. The topic of a message object is added by its first
                message.
            data: The message, or its CDR bytes.
            log_time_ns: When it was received, nanoseconds since 1970 or a ``datetime64``.
            publish_time_ns: When it was sent; None if it is not known.

        Raises:
            BagError: The topic was not added, the bag is closed, there are no bytes, or a message
                to compress is larger than readers take.
            TypeError: The data are neither bytes nor a message of the type, a time is not a
                number, or a message that is no ``TFMessage`` begins ``/tf`` or ``/tf_static``.
            ValueError: A time lies before 1970.
            OSError: The disk is full, for example. What was written before stays readable.
        """
        if not isinstance(topic, str):
            raise TypeError(f"topic must be str, not {type(topic).__name__}")
        number = self._ids.get(topic)
        if number is None and (type_name := getattr(type(data), "_TYPE_NAME", None)):
            refuse_other_types(topic, type_name)
            self.add_topic(topic, type_name)
            number = self._ids[topic]
        if number is None or self._file is None:
            self._open()
            if not isinstance(data, (bytes, bytearray, memoryview)):
                raise TypeError(
                    f"{topic} accepts a message or its CDR bytes, not {given(data, topic)}"
                )
            raise BagError(f"the topic '{topic}' was not added").with_hint(
                "Call add_topic() first: bytes do not say which type they have."
            )
        if not isinstance(data, bytes) or not data:
            data = as_cdr(topic, self._channels[topic].topic.type, data)
        if type(log_time_ns) is not int or not 0 <= log_time_ns <= self._last_time:
            log_time_ns = self._stamp(log_time_ns, "log_time_ns")
        if not publish_time_ns:
            publish_time_ns = log_time_ns
        elif type(publish_time_ns) is not int or not 0 <= publish_time_ns <= self._last_time:
            publish_time_ns = self._stamp(publish_time_ns, "publish_time_ns")
        if self._compresses_messages:
            data = compressed_message(topic, data)
        if self._splits:
            self._split_if_due(self._file, log_time_ns)
            number = self._ids[topic]
        self._file.write(number, log_time_ns, publish_time_ns, data)

    def append(self, key: str, data: bytes, log_time_ns: int, publish_time_ns: int) -> None:
        """Write a message as another bag has it.

        Args:
            key: The channel; see `add_channel`.
            data: Its bytes, which are not checked.
            log_time_ns: When it was received.
            publish_time_ns: When it was sent.

        Raises:
            BagError: A message to compress is larger than readers take, or sqlite3 has no such
                time.
        """
        if self._compresses_messages:
            data = compressed_message(key, data)
        if log_time_ns > self._last_time:
            raise BagError(
                f"{self.metadata.storage} files have no log time {log_time_ns}"
            ).with_hint("Write an MCAP file instead.")
        self._open().write(self._ids[key], log_time_ns, publish_time_ns, data)

    def copy_chunk(self, chunk: RawChunk) -> None:
        """Append a chunk of another MCAP file as it is.

        All of its channels must have been added, and `add_channel` have returned True.
        """
        file = self._open()
        assert isinstance(file, McapWriter)
        file.copy_chunk(chunk)

    def copy_extra(self, record: memoryview) -> None:
        """Append an Attachment or Metadata record of another MCAP file as it is."""
        file = self._open()
        assert isinstance(file, McapWriter)
        file.copy_extra(record)

    @property
    def size(self) -> int:
        """Bytes in the current file, waiting for it, and in the summary of an MCAP file."""
        file = self._open()
        return file.size + (file.summary_bytes if isinstance(file, McapWriter) else 0)

    def flush(self) -> None:
        """Hand all messages to the operating system: they survive this process."""
        self._open().flush()

    def split(self) -> tuple[str, str]:
        """Finish the current file and begin another.

        Returns:
            Paths of the finished and of the new file.

        Raises:
            OSError: The disk is full, for example. The bag is closed then.
        """
        file, self._file = self._open(), None
        try:
            finished = self._finish_file(file)
            self._remove_old_files()
            self._file = self._open_file()
        finally:
            if self._file is None:  # nothing can be written any more
                write_metadata(self.path, self._whole_metadata())
        self._file_start_ns = None
        for key, channel in self._channels.items():
            self._ids[key] = self._define(self._file, channel)
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

    def abandon(self) -> None:
        """Close the current file as it is, before the folder is removed."""
        if self._file is not None:
            file, self._file = self._file, None
            file.abandon()

    def _stamp(self, time: Any, argument: str) -> int:
        """Return a time as an integer, which can be written."""
        stamp = as_nanoseconds(time, argument)
        if stamp < 0:
            raise ValueError(f"{argument} is {stamp}: bags have no times before 1970")
        if stamp > self._last_time:
            raise ValueError(f"{argument} is {stamp}, more nanoseconds than a bag can store")
        return stamp

    # -- one file

    def _open(self) -> McapWriter | SqliteWriter:
        if self._file is None:
            raise BagError(f"{self.path} is closed")
        return self._file

    def _open_file(self) -> McapWriter | SqliteWriter:
        storage = self.metadata.storage
        name = file_name(self.path, self._opened_files, self.metadata.ros_distro)
        self._opened_files += 1
        path = os.path.join(self.path, f"{name}.{ENDINGS[storage]}")
        file = (
            McapWriter(path, **self._chunks)
            if storage == "mcap"
            else SqliteWriter(path, self.metadata.ros_distro)
        )
        try:
            self._embed(file, self._whole_metadata())
        except BaseException:
            file.abandon()
            raise
        self._schemas.clear()
        return file

    def _define(self, file: McapWriter | SqliteWriter, channel: BagChannel) -> int:
        """Register a channel in a file; returns its number there."""
        topic, schema, record = channel.topic, channel.schema, channel.record
        qos = profiles_to_text(topic.qos, self.metadata.version)
        encoding = topic.serialization_format
        if isinstance(file, SqliteWriter):
            text = schema.data.decode("utf-8", "replace")
            file.add_definition(topic.type, schema.encoding, text, topic.type_hash)
            return file.add_topic(topic.name, topic.type, qos, topic.type_hash, encoding)
        number = self._schemas.get(schema, 0)
        if not number and schema.name:
            wanted = schema.id or None
            number = file.add_schema(schema.name, schema.encoding, schema.data, wanted)
            self._schemas[schema] = number
        if record is None:
            metadata = {"offered_qos_profiles": qos, "topic_type_hash": topic.type_hash}
            return file.add_channel(number, topic.name, metadata, encoding)
        return file.add_channel(
            number, topic.name, record.metadata, record.message_encoding, record.id
        )

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
            if self.on_begin is not None:
                self.on_begin(log_time_ns)

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
        counts_of_file = {key: counts.get(self._ids[key], 0) for key in self._channels}
        for key, channel in self._channels.items():
            channel.topic.message_count += counts_of_file[key]
        self._counts_of_files.append(counts_of_file)
        name = os.path.basename(file.path)
        start = file.start_ns if file.message_count else 0
        duration = file.end_ns - start
        self.metadata.files.append(FileInfo(name, start, duration, file.message_count))
        self.metadata.paths.append(name)

    def _remove_old_files(self) -> None:
        """Remove the oldest files, so that one more is not too many."""
        while self._max_files and len(self.metadata.paths) >= self._max_files:
            with suppress(FileNotFoundError):  # the user has moved it away
                os.remove(os.path.join(self.path, self.metadata.paths.pop(0)))
            self.metadata.files.pop(0)
            for key, count in self._counts_of_files.pop(0).items():
                if key in self._channels:
                    self._channels[key].topic.message_count -= count

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
        self.metadata.topics = _by_name(self._channels.values())
        return self.metadata


def _by_name(channels: Iterable[BagChannel]) -> list[TopicInfo]:
    """Return the topics; the channels of one topic count together."""
    topics: dict[str, TopicInfo] = {}
    for topic in (channel.topic for channel in channels):
        known = topics.get(topic.name)
        topics[topic.name] = (
            replace(known, message_count=known.message_count + topic.message_count)
            if known
            else topic
        )
    return list(topics.values())


def _make_folder(path: str) -> None:
    try:
        os.makedirs(path)
    except FileExistsError:
        text = "a bag needs a new folder; choose another path, or remove this one first"
        raise FileExistsError(errno.EEXIST, text, path) from None
