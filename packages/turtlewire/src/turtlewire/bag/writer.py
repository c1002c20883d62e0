"""A bag to write: a folder that rosbag2, Foxglove and others read."""

from __future__ import annotations

import atexit
import errno
import os
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any
from weakref import WeakSet

from turtlewire.bag.definitions import known_hash
from turtlewire.bag.file_series import FileSeries
from turtlewire.bag.mcap_writer import CHUNK_BYTES, McapWriter
from turtlewire.bag.message import channel_of_text
from turtlewire.bag.metadata import NEWEST_VERSION, BagMetadata, TopicInfo
from turtlewire.bag.writer_checks import (
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

    from turtlewire.bag.mcap_records import RawChunk
    from turtlewire.bag.message import BagChannel
    from turtlewire.bag.sqlite_writer import SqliteWriter
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
        self.on_split: Callable[[str, str], None] | None = None
        self.on_begin: Callable[[int], None] | None = None
        self.on_compress: Callable[[str], None] | None = None
        self._last_time = _LAST_TIMES[storage]
        self._max_file_bytes = max_file_bytes
        self._max_file_ns = max_file_ns
        self._splits = bool(max_file_bytes or max_file_ns)
        self._compresses_messages = compression_mode == "MESSAGE"
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
        chunks = {
            "compression": compression,
            "level": level,
            "chunk_bytes": chunk_bytes,
            "checksums": checksums,
        }
        self._files = FileSeries(self.path, self.metadata, chunks, max_files)
        self._process = os.getpid()
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
        return {topic.name: topic for topic in self._files.topics()}

    @property
    def file_path(self) -> str:
        """The file that is being written.

        Raises:
            BagError: The bag is closed.
        """
        return self._files.open_file().path

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
        known = self._files.channels.get(name)
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
        self._files.add_channel(key, channel)
        file, schema, record = self._files.current, channel.schema, channel.record
        return (
            isinstance(file, McapWriter)
            and record is not None
            and record.id == self._files.ids[key]
            and schema.id == file.schema_ids.get(schema, 0)
        )

    def remove_topic(self, name: str) -> None:
        """Take a topic without messages out of the bag's metadata.

        Raises:
            BagError: The topic was not added.
        """
        if name not in self._files.channels:
            raise BagError(f"the topic '{name}' was not added")
        self._files.remove_channel(name)

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
        files = self._files
        number = files.ids.get(topic)
        if number is None and (type_name := getattr(type(data), "_TYPE_NAME", None)):
            refuse_other_types(topic, type_name)
            self.add_topic(topic, type_name)
            number = files.ids[topic]
        if number is None or files.current is None:
            files.open_file()
            if not isinstance(data, (bytes, bytearray, memoryview)):
                raise TypeError(
                    f"{topic} accepts a message or its CDR bytes, not {given(data, topic)}"
                )
            raise BagError(f"the topic '{topic}' was not added").with_hint(
                "Call add_topic() first: bytes do not say which type they have."
            )
        if not isinstance(data, bytes) or not data:
            data = as_cdr(topic, files.channels[topic].topic.type, data)
        if type(log_time_ns) is not int or not 0 <= log_time_ns <= self._last_time:
            log_time_ns = self._stamp(log_time_ns, "log_time_ns")
        if not publish_time_ns:
            publish_time_ns = log_time_ns
        elif type(publish_time_ns) is not int or not 0 <= publish_time_ns <= self._last_time:
            publish_time_ns = self._stamp(publish_time_ns, "publish_time_ns")
        if self._compresses_messages:
            data = compressed_message(topic, data)
        if self._splits:
            self._split_if_due(files.current, log_time_ns)
            number = files.ids[topic]
        files.current.write(number, log_time_ns, publish_time_ns, data)

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
        file = self._files.open_file()
        file.write(self._files.ids[key], log_time_ns, publish_time_ns, data)

    def copy_chunk(self, chunk: RawChunk) -> None:
        """Append a chunk of another MCAP file as it is.

        All of its channels must have been added, and `add_channel` have returned True.
        """
        file = self._files.open_file()
        assert isinstance(file, McapWriter)
        file.copy_chunk(chunk)

    def copy_extra(self, record: memoryview) -> None:
        """Append an Attachment or Metadata record of another MCAP file as it is."""
        file = self._files.open_file()
        assert isinstance(file, McapWriter)
        file.copy_extra(record)

    @property
    def size(self) -> int:
        """Bytes in the current file, waiting for it, and in the summary of an MCAP file."""
        file = self._files.open_file()
        return file.size + file.summary_bytes

    def flush(self) -> None:
        """Hand all messages to the operating system: they survive this process."""
        self._files.open_file().flush()

    def split(self) -> tuple[str, str]:
        """Finish the current file and begin another.

        Returns:
            Paths of the finished and of the new file.

        Raises:
            OSError: The disk is full, for example. The bag is closed then.
        """
        paths = self._files.split(self.on_compress)
        self._file_start_ns = None
        return paths

    def close(self) -> None:
        """Finish the file and write ``metadata.yaml``; closing twice does nothing.

        Raises:
            OSError: The disk is full, for example. What was written before stays readable.
        """
        self._files.close(self.on_compress)

    def abandon(self) -> None:
        """Close the current file as it is, before the folder is removed."""
        self._files.abandon()

    def _stamp(self, time: Any, argument: str) -> int:
        """Return a time as an integer, which can be written."""
        stamp = as_nanoseconds(time, argument)
        if stamp < 0:
            raise ValueError(f"{argument} is {stamp}: bags have no times before 1970")
        if stamp > self._last_time:
            raise ValueError(f"{argument} is {stamp}, more nanoseconds than a bag can store")
        return stamp

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


def _make_folder(path: str) -> None:
    try:
        os.makedirs(path)
    except FileExistsError:
        text = "a bag needs a new folder; choose another path, or remove this one first"
        raise FileExistsError(errno.EEXIST, text, path) from None
