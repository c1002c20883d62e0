"""A bag to read: a folder of rosbag2, or a single ``.mcap`` or ``.db3`` file."""

from __future__ import annotations

import heapq
import os
import shutil
import tempfile
import weakref
from collections.abc import Callable, Iterable, Iterator
from operator import attrgetter
from typing import TYPE_CHECKING

from turtlewire.bag.compression import unpack_file, unpacked
from turtlewire.bag.definitions import ENCODING, has_interface, in_ros2msg, learn_types
from turtlewire.bag.files import joined, open_storage, overlapping, storage_files
from turtlewire.bag.message_choice import (
    check_unit,
    full_type_names,
    nearest_names,
    one_or_several,
    window,
)
from turtlewire.bag.metadata import BagMetadata, TopicInfo, read_metadata
from turtlewire.bag.storage import messages_of_blocks
from turtlewire.call_errors import explain_call, explain_calls, hint_at
from turtlewire.errors import BagError, InterfaceError
from turtlewire.path_arguments import near_path, path_text
from turtlewire.wording import counted

if TYPE_CHECKING:
    from typing_extensions import Self

    from turtlewire.bag.columns import Columns
    from turtlewire.bag.message import BagMessage
    from turtlewire.bag.storage import StorageFile
    from turtlewire.tf.datetimes import Stamp

__all__ = ["Bag", "open_bag"]

_MOST_NAMES = 10


@hint_at(
    {
        "read_messages read read_next iter_messages": "messages(topics)",
        "connections channels get_all_topics_and_types": "topics",
        "get_message_count message_count": "len(bag), or bag.topics[name].message_count",
        "start_time": "start_ns",
        "end_time": "end_ns",
        "duration": "end_ns - start_ns",
        "transforms tf": "turtlewire.Buffer.from_bag(path)",
        "info": "turtlewire.bag.describe_bag(path)",
        "show": "turtlewire.show(path)",
    }
)
@explain_calls
class Bag:
    """A bag that is open for reading; use it in a ``with`` statement or call `close`.

    ::

        with turtlewire.bag.open_bag("my_bag") as bag:
            for message in bag.messages("/odom"):
                print(message.log_time_ns, message.decode().pose.pose.position)

    Not thread-safe; open a bag twice to read it in two threads.

    Args:
        path: The folder or file; see `open_bag`.
        trust_metadata: Whether ``metadata.yaml`` is read where it is; False takes what the files
            themselves tell.

    Attributes:
        path: The folder or file.
        metadata: What it holds; computed from the files where ``metadata.yaml`` is missing.
        problems: What is damaged or missing, one sentence each with file and position. What can be
            read is still read; `messages` raises a `BagError` at its end if a chunk in the
            middle was damaged.
    """

    def __init__(self, path: str | os.PathLike[str], *, trust_metadata: bool = True) -> None:
        self.path = path_text(path, what="path of a bag")
        self.problems: list[str] = []
        self._files: dict[str, StorageFile] = {}
        self._scratch: str | None = None
        self._types_seen: set[str] = set()
        self._expected_counts: dict[str, int] = {}
        if not os.path.exists(self.path):
            raise FileNotFoundError(f"there is no bag at {self.path}{near_path(self.path)}")
        is_folder = os.path.isdir(self.path)
        self._folder = self.path if is_folder else os.path.dirname(self.path)
        try:
            self.metadata = self._read_metadata(is_folder=is_folder, trusted=trust_metadata)
        except BaseException:
            self.close()
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_error: object) -> None:
        self.close()

    def __len__(self) -> int:
        return self.metadata.message_count

    def __iter__(self) -> Iterator[BagMessage]:
        return self.messages()

    def __contains__(self, topic: object) -> bool:
        return topic in self.topics

    def __repr__(self) -> str:
        seconds = self.metadata.duration_ns / 1e9
        return (
            f"<Bag {self.path!r}: {counted(len(self), 'message')} of "
            f"{counted(len(self.topics), 'topic')}, "
            f"{seconds:.3f} s>"
        )

    def _repr_html_(self) -> str:
        from turtlewire.bag.notebook import bag_html

        return bag_html(self.path, self.metadata, self.problems)

    def close(self) -> None:
        """Release the files; decompressed copies are deleted."""
        for file in self._files.values():
            file.close()
        self._files.clear()
        if self._scratch is not None:
            shutil.rmtree(self._scratch, ignore_errors=True)
            self._scratch = None

    @property
    def part_of(self) -> str:
        """The folder of the bag, if this is one of its files; else an empty string."""
        if os.path.isdir(self.path):
            return ""
        folder, name = os.path.split(os.path.abspath(self.path))
        try:
            whole = read_metadata(folder)
        except (BagError, OSError):  # of the folder, which this file does not need
            return ""
        return folder if whole and name in whole.paths and len(whole.paths) > 1 else ""

    @property
    def topics(self) -> dict[str, TopicInfo]:
        """The topics by name."""
        return {topic.name: topic for topic in self.metadata.topics}

    @property
    def start_ns(self) -> int:
        """Log time of the oldest message."""
        return self.metadata.start_ns

    @property
    def end_ns(self) -> int:
        """Log time of the newest message."""
        return self.metadata.start_ns + self.metadata.duration_ns

    def definitions(self) -> dict[str, tuple[str, str]]:
        """Encoding (``ros2msg``) and text of each type's definition, as far as the bag has them."""
        found: dict[str, tuple[str, str]] = {}
        for file in self.files():
            found.update(file.definitions())
        return found

    def learn_types(self) -> None:
        """Make all types that only this bag defines known to `turtlewire.msg`.

        `messages` does that for the types of its messages.

        Raises:
            InterfaceError: A definition cannot be parsed.
        """
        for name, definition in self.definitions().items():
            encoding, text = in_ros2msg(name, *definition)
            if encoding == ENCODING and text:
                learn_types(name, text)

    def files(self) -> Iterator[StorageFile]:
        """Yield the bag's files in their order, opened when they are reached.

        Raises:
            BagError: A file is missing or invalid.
        """
        for path in self.metadata.paths:
            yield self.file(path)

    def messages(
        self,
        topics: str | Iterable[str] | None = None,
        *,
        types: str | Iterable[str] | None = None,
        start_ns: Stamp | None = None,
        end_ns: Stamp | None = None,
    ) -> Iterator[BagMessage]:
        """Yield the messages in order of their log time.

        Args:
            topics: A topic or several; None means all.
            types: A message type or several; None means all.
            start_ns: The log time from which on messages are taken; None: from the beginning.
            end_ns: The last log time that is taken; None: to the end.

        Yields:
            The messages; at equal times in the order of the file.

        Raises:
            BagError: A topic or type does not exist; or, after all messages that can be read, a
                part of the bag is damaged or missing.
            TypeError: A topic or type is not a str.
            ValueError: ``end_ns`` lies before ``start_ns``, or the window is not in nanoseconds
                since 1970, as the times of the bag are.
        """
        start, end = window(start_ns, end_ns)
        check_unit(self.metadata, start_ns=start, end_ns=end)
        wanted = self._wanted(one_or_several(topics, "topics"), full_type_names(types))
        damage: list[BagError] = []
        for group in overlapping(self.metadata):
            files = self.readable_files(group, damage)
            streams = [self._messages_of(file, wanted, start, end, damage) for file in files]
            if len(streams) == 1:
                yield from streams[0]
            else:
                yield from heapq.merge(*streams, key=attrgetter("log_time_ns"))
        if damage:
            damage[0].others = tuple(damage[1:])
            raise damage[0]

    def columns(
        self,
        topic: str,
        *fields: str,
        start_ns: Stamp | None = None,
        end_ns: Stamp | None = None,
    ) -> Columns:
        """Return fields of all messages of a topic as NumPy arrays.

        ::

            imu = bag.columns("/imu", "linear_acceleration.x", "orientation")
            plt.plot(imu.stamps_ns / 1e9, imu["linear_acceleration.x"])

        The array of a field has one row for each message, in order of their log times:

        ========================  =============================================================
        field                     its array
        ========================  =============================================================
        number, bool              ``(N,)``, of the field's own dtype
        array of k numbers        ``(N, k)``, such as a covariance
        message of k numbers      ``(N, k)``: a Vector3, a Quaternion (xyzw), a Pose
        time, duration            ``(N,)`` nanoseconds, ``int64``
        text                      ``(N,)`` of ``str``
        sequence of numbers       ``(N,)`` objects: arrays ``(n,)``, read-only views of the bag's
                                  bytes; ``np.stack`` makes one array if their lengths are equal
        sequence of messages      the same with arrays ``(n, k)``, if they consist of k numbers
        ``data`` of an Image      the same with its pixels, ``(height, width[, channels])``
        ``data`` of PointCloud2   the same with its points, a structured array
        ========================  =============================================================

        Args:
            topic: The topic.
            fields: Names of fields; dots lead into nested messages.
            start_ns: The first log time, as in `messages`.
            end_ns: The last log time.

        Raises:
            BagError: The topic or a field does not exist, a field cannot be a column, or a part of
                the bag is damaged.
            CdrError: A message is malformed.
            InterfaceError: The type is not known and the bag does not define it.
            ValueError: No field was named, or the window is refused as in `messages`.
        """
        from turtlewire.bag.columns import read_columns  # it needs NumPy

        start, end = window(start_ns, end_ns)
        check_unit(self.metadata, start_ns=start, end_ns=end)
        wanted = self._wanted({topic}, None)
        for file in self.readable_files(self.metadata.paths, []):
            self._learn_unknown_types(file, wanted)
        return read_columns(self, topic, fields, start, end)

    def readable_files(self, paths: list[str], damage: list[BagError]) -> list[StorageFile]:
        """Return the files that can be opened; the others go to the problems and the damage."""
        files = []
        for path in paths:
            try:
                files.append(self.file(path))
            except (BagError, OSError) as error:  # noqa: PERF203 - a bag has few files
                left_out = _without(error, self.path)
                self.complain(str(left_out))
                damage.append(left_out)
        return files

    def complain(self, problem: str) -> None:
        """Add to `problems` what is not among them yet."""
        if problem not in self.problems:
            self.problems.append(problem)

    def _messages_of(
        self,
        file: StorageFile,
        wanted: Callable[[TopicInfo], bool],
        start_ns: int,
        end_ns: int,
        damage: list[BagError],
    ) -> Iterator[BagMessage]:
        self._learn_unknown_types(file, wanted)
        blocks = file.blocks(wanted, start_ns, end_ns, damage.append)
        messages = messages_of_blocks(file, blocks)
        if self.metadata.compression_mode != "MESSAGE":
            return messages
        return unpacked(messages, self.metadata.compression_format, file.path, damage)

    def _learn_unknown_types(self, file: StorageFile, wanted: Callable[[TopicInfo], bool]) -> None:
        """Make the wanted types known that only the bag defines, so that messages decode."""
        types = {topic.type for topic in self.metadata.topics if wanted(topic)}
        unknown = {name for name in types - self._types_seen if not has_interface(name)}
        self._types_seen |= types
        if not unknown:
            return
        for name, definition in file.definitions().items():
            if name not in unknown:
                continue
            encoding, text = in_ros2msg(name, *definition)
            if encoding == ENCODING and text:
                try:
                    learn_types(name, text)
                except InterfaceError as error:
                    self.problems.append(f"{file.path}: the definition of {name}: {error}")

    def _wanted(
        self, topics: set[str] | None, types: set[str] | None
    ) -> Callable[[TopicInfo], bool]:
        known = self.topics
        for name in topics or ():
            if name not in known:
                raise BagError(f"the bag has no topic '{name}'").with_hint(
                    nearest_names(name, known)
                )
        known_types = {topic.type for topic in self.metadata.topics}
        for name in types or ():
            if name not in known_types:
                hint = nearest_names(name, known_types, "types")
                raise BagError(f"the bag has no messages of the type '{name}'").with_hint(hint)
        return lambda topic: (
            (topics is None or topic.name in topics) and (types is None or topic.type in types)
        )

    def file(self, path: str) -> StorageFile:
        """One of the files that ``metadata.paths`` names.

        Raises:
            OSError: The file is missing.
            BagError: The file is invalid.
        """
        file = self._files.get(path)
        if file is None:
            file = self._open(path)
            self._files[path] = file
            self.problems += file.problems
            self._check_count(path, file)
        return file

    def _check_count(self, path: str, file: StorageFile) -> None:
        """Report an intact file that contains fewer messages than ``metadata.yaml`` says."""
        found, expected = file.counted_messages(), self._expected_counts.get(path, 0)
        if found is not None and found < expected and not file.problems:
            full = os.path.join(self._folder, path)
            self.complain(
                f"{full}: only {found:,} of {counted(expected, 'message')} found; it is damaged"
            )

    def _open(self, path: str) -> StorageFile:
        full = os.path.join(self._folder, path)
        try:
            file = open_storage(self._plain_file(full), full)
        except BagError as error:
            if not path.endswith(".zstd"):
                raise
            raise BagError(f"{error}, as far as it was decompressed") from None
        if self._scratch is not None and os.name == "posix":
            # The open file keeps its bytes, and nothing stays when the process is killed.
            shutil.rmtree(self._scratch)
            self._scratch = None
        return file

    def _plain_file(self, full: str) -> str:
        """Return the file itself, or a decompressed copy that lives as long as the bag is open."""
        if not full.endswith(".zstd"):
            return full
        if self._scratch is None:
            self._scratch = tempfile.mkdtemp(prefix="turtlewire-bag-")
            weakref.finalize(self, shutil.rmtree, self._scratch, ignore_errors=True)
        return unpack_file(full, self._scratch, self.problems.append)

    def _read_metadata(self, *, is_folder: bool, trusted: bool) -> BagMetadata:
        if not is_folder:
            return self._metadata_of([os.path.basename(self.path)])
        written = read_metadata(self.path) if trusted else None
        if written is None:
            return self._metadata_of(storage_files(self.path))
        counts = (file.message_count for file in written.files)
        self._expected_counts = dict(zip(written.paths, counts, strict=False))
        return written

    def _metadata_of(self, paths: list[str]) -> BagMetadata:
        """Metadata from the files themselves."""
        if not paths:
            folders = [entry for entry in os.scandir(self.path) if entry.is_dir()]
            bags = sorted(entry.path for entry in folders if storage_files(entry.path))
            raise BagError(
                f"{self.path} is not a bag: it contains no .mcap or .db3 file"
            ).with_hint(f"Bags in it: {', '.join(bags[:_MOST_NAMES])}." if bags else "")
        parts: dict[str, BagMetadata] = {}
        for path in paths:
            try:
                file = self.file(path)
                known = len(file.problems)
                parts[path] = file.summary()
                self.problems += file.problems[known:]
            except BagError as error:  # noqa: PERF203 - a bag has few files
                if len(paths) == 1:
                    raise
                self.problems.append(f"{error}; this file is left out")
        if not parts:
            raise BagError(f"{self.path}: none of its files can be read: {self.problems[0]}")
        return joined(list(parts), list(parts.values()))


@explain_call
def open_bag(path: str | os.PathLike[str]) -> Bag:
    """Open a bag for reading.

    Args:
        path: A folder of rosbag2 (with or without ``metadata.yaml``), a ``.mcap`` or a ``.db3``
            file; compressed or not, finished or left behind by a recorder that was killed. A
            ``.bag`` of ROS 1.

    Raises:
        FileNotFoundError: ``path`` does not exist.
        BagError: ``path`` is not a bag.
    """
    return Bag(path)


def _without(error: BagError | OSError, bag: str) -> BagError:
    """Return the error of a file that is left out."""
    if isinstance(error, BagError):
        return error
    reason = f"{error.filename or bag}: {error.strerror or error}"
    left_out = BagError(f"{reason}; the other files were read")
    left_out.with_hint(f"Put the file back, or let `ros2 bag reindex {bag}` forget it.")
    return left_out
