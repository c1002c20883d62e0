"""The transforms of a bag, in a buffer.

The bytes of the messages go straight into the buffer. Chunks without transforms are skipped by
their index, and a second thread decompresses the next chunk while the buffer takes the last one.
"""

from __future__ import annotations

import os
import struct
from concurrent.futures import ThreadPoolExecutor
from itertools import islice
from typing import TYPE_CHECKING

from turtlewire.bag.encodings import is_cdr, not_in_cdr
from turtlewire.bag.progress import progress_line
from turtlewire.bag.reader import Bag, window
from turtlewire.bag.storage import McapStorage
from turtlewire.bag.transform_report import StepsBack, TransformReport, describe, group_jumps
from turtlewire.errors import BagError
from turtlewire.tf.buffer import Buffer, RecordWalk

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from turtlewire.bag.mcap_records import ChunkIndex
    from turtlewire.bag.metadata import TopicInfo

__all__ = ["TransformReport", "fill_buffer", "load_transforms"]

_TF_TYPE = "tf2_msgs/msg/TFMessage"
_FOREVER = (1 << 64) - 1
#: Opcode, length, channel, sequence, log time and publish time of an MCAP message.
_MESSAGE = struct.Struct("<BQHIQQ")
_MESSAGE_OPCODE = 5
_MESSAGE_FIELDS = 22
_ROWS_AT_A_TIME = 1000


def load_transforms(
    path: str | os.PathLike[str],
    *,
    topics: str | Iterable[str] = "/tf",
    static_topics: str | Iterable[str] = "/tf_static",
    start_ns: int = 0,
    end_ns: int = _FOREVER,
    cache_time_ns: int | None = None,
    progress: Callable[[float], None] | None = None,
) -> tuple[Buffer, TransformReport]:
    """Read the transforms of a bag into a new buffer.

    Args:
        path: The bag; see `turtlewire.bag.open_bag`.
        topics: Where transforms were published, ``"/tf"`` or other names.
        static_topics: Where static transforms were published. They are taken whatever the window.
        start_ns: Log time of the first message to take, in nanoseconds or as ``datetime64``.
        end_ns: Log time of the last message to take.
        cache_time_ns: How much history the buffer keeps; None keeps all.
        progress: Called with the share that was read, from 0 to 1; by default a line is drawn on a
            terminal when reading takes more than a second.

    Returns:
        The buffer, and what was found.

    Raises:
        FileNotFoundError: There is nothing at ``path``.
        BagError: It is no bag, none of the topics is in it, or one that is not the default is
            missing or of another type.
        ValueError: The window ends before it begins.
    """
    buffer = Buffer(cache_time_ns)
    report = fill_buffer(
        buffer,
        path,
        topics=topics,
        static_topics=static_topics,
        start_ns=start_ns,
        end_ns=end_ns,
        progress=progress,
    )
    return buffer, report


def fill_buffer(
    buffer: Buffer,
    path: str | os.PathLike[str],
    *,
    topics: str | Iterable[str] = "/tf",
    static_topics: str | Iterable[str] = "/tf_static",
    start_ns: int = 0,
    end_ns: int = _FOREVER,
    progress: Callable[[float], None] | None = None,
) -> TransformReport:
    """Read the transforms of a bag into a buffer; see `load_transforms`."""
    start_ns, end_ns = window(start_ns, end_ns)
    moving, fixed = _names(topics), _names(static_topics)
    name = os.path.basename(os.path.abspath(path))
    report = TransformReport(name)
    with Bag(path) as bag:
        # The names that stand there by default need not be in the bag.
        chosen = (set() if topics == "/tf" else moving) | (
            set() if static_topics == "/tf_static" else fixed
        )
        _check_topics(bag, moving | fixed, chosen)
        known = bag.topics
        report.publishers = {
            topic: len(known[topic].qos) for topic in sorted((moving | fixed) & known.keys())
        }
        tell = progress or progress_line(f"reading {name}")
        for static, names in ((True, fixed), (False, moving)):
            walk = RecordWalk(0, _FOREVER) if static else RecordWalk(start_ns, end_ns)
            reader = _Reader(bag, walk, buffer, (lambda _: None) if static else tell)
            reader.read(names & known.keys(), start_ns, end_ns, static=static)
            report.messages += walk.messages
            report.jumps += group_jumps(walk.jumps)
            for child, steps in walk.steps_back.items():
                report.steps_back[child] = StepsBack(*steps)
        tell(1.0)
        report.problems = bag.problems + _empty_window(bag, start_ns, end_ns)
        report.part_of = bag.part_of
    describe(buffer, report)
    return report


def _empty_window(bag: Bag, start_ns: int, end_ns: int) -> list[str]:
    """Return a complaint if no message of the bag lies in the window."""
    if not len(bag) or (start_ns <= bag.end_ns and end_ns >= bag.start_ns):
        return []
    asked = f"{start_ns} to {end_ns}" if end_ns < _FOREVER else f"{start_ns} on"
    covered = f"{bag.start_ns} to {bag.end_ns}"
    return [f"no message lies in the window, from {asked}: the bag covers {covered}"]


def _names(topics: str | Iterable[str]) -> set[str]:
    return {topics} if isinstance(topics, str) else set(topics)


def _check_topics(bag: Bag, wanted: set[str], chosen: set[str]) -> None:
    """Refuse a bag without any of the wanted topics, or without one of those chosen by name."""
    missing = sorted(chosen - bag.topics.keys())
    for name in sorted(chosen & bag.topics.keys()):
        topic = bag.topics[name]
        if topic.type not in (_TF_TYPE, "") and is_cdr(topic):  # a damaged file may not tell
            raise BagError(f"{name} is of type {bag.topics[name].type}, not {_TF_TYPE}")
    if foreign := not_in_cdr(bag.topics[name] for name in wanted & bag.topics.keys()):
        raise BagError(f"{bag.path} has no transforms that can be read").with_hint(foreign)
    if wanted & bag.topics.keys() and not missing:
        return
    similar = [name for name, topic in bag.topics.items() if topic.type == _TF_TYPE]
    hint = f"Topics of type {_TF_TYPE} in it: {', '.join(similar)}." if similar else "It has no TF."
    damage = [f"Damaged: {text}." for text in bag.problems]
    if wanted & bag.topics.keys():
        text = f"{bag.path} has no topic {' and no topic '.join(missing)}"
    else:
        text = f"{bag.path} has none of the topics {', '.join(sorted(wanted))}"
    foreign = not_in_cdr(bag.topics.values())
    raise BagError(text).with_hint(" ".join(filter(None, (hint, foreign, *damage))))


class _Reader:
    """Reads the messages of some topics into a buffer."""

    def __init__(
        self, bag: Bag, walk: RecordWalk, buffer: Buffer, tell: Callable[[float], None]
    ) -> None:
        self._bag = bag
        self._walk = walk
        self._buffer = buffer
        self._tell = tell

    def read(self, names: set[str], start_ns: int, end_ns: int, *, static: bool) -> None:
        """Read the messages of topics whose log time lies in the walk's window."""
        if not names:
            return
        if static:
            start_ns, end_ns = 0, _FOREVER
        paths = self._bag.metadata.paths
        for i, path in enumerate(paths):
            try:
                file = self._bag.file(path)
            except (BagError, OSError) as error:
                self._bag.complain(str(error))
                continue
            if isinstance(file, McapStorage) and self._bag.metadata.compression_mode != "MESSAGE":
                self._read_chunks(file, names, start_ns, end_ns, static, (i, len(paths)))
            else:
                self._read_rows(names, start_ns, end_ns, static)
                return  # rows come in order of time over all files

    def _read_chunks(
        self,
        file: McapStorage,
        names: set[str],
        start_ns: int,
        end_ns: int,
        static: bool,
        place: tuple[int, int],
    ) -> None:
        """Read one file, each chunk decompressed while the last is taken."""

        def wanted(topic: TopicInfo) -> bool:
            return topic.name in names

        channels = {
            number: (topic.name, static)
            for number in file.file.channels
            if wanted(topic := file.topic(number))
        }
        chunks = file.chunks(wanted, start_ns, end_ns)
        total, done = sum(chunk.length for chunk in chunks) or 1, 0
        expected = self._walk.messages + file.told(channels, start_ns, end_ns)
        known_problems = len(self._bag.problems)
        for chunk, records in self._decompressed(file, chunks):
            if isinstance(records, BagError):
                self._bag.complain(str(records))
            else:
                damaged_at = self._walk.walk(self._buffer, records, channels)
                if damaged_at >= 0:
                    self._bag.complain(str(file.file.cut(chunk, damaged_at)))
            file.file.forget(chunk)
            done += chunk.length
            self._tell((place[0] + done / total) / place[1])
        lacking = expected - self._walk.messages
        if lacking > 0 and len(self._bag.problems) == known_problems:
            self._bag.complain(str(file.lack(lacking)))

    @staticmethod
    def _decompressed(
        file: McapStorage, chunks: list[ChunkIndex]
    ) -> Iterator[tuple[ChunkIndex, bytes | memoryview | BagError]]:
        """Yield each chunk with its records, which another thread decompresses one chunk ahead."""

        def load(chunk: ChunkIndex) -> bytes | memoryview | BagError:
            try:
                return file.file.records(chunk)
            except BagError as error:
                return error

        with ThreadPoolExecutor(1, "bag") as thread:
            following = iter(chunks)
            ahead = [(chunk, thread.submit(load, chunk)) for chunk in islice(following, 1)]
            while ahead:
                chunk, current = ahead.pop()
                ahead += [(chunk, thread.submit(load, chunk)) for chunk in islice(following, 1)]
                yield chunk, current.result()

    def _read_rows(self, names: set[str], start_ns: int, end_ns: int, static: bool) -> None:
        """Read storages without chunks, as records that are made here."""
        numbers = {name: number for number, name in enumerate(sorted(names))}
        channels = {number: (name, static) for name, number in numbers.items()}
        known = self._bag.topics
        expected = sum(known[name].message_count for name in names) or 1
        records = self._records(names, numbers, start_ns, end_ns)
        done = 0
        while batch := list(islice(records, _ROWS_AT_A_TIME)):
            self._walk.walk(self._buffer, b"".join(batch), channels)
            done += len(batch)
            self._tell(min(1.0, done / expected))

    def _records(
        self, names: set[str], numbers: dict[str, int], start_ns: int, end_ns: int
    ) -> Iterator[bytes]:
        try:
            for message in self._bag.messages(names, start_ns=start_ns, end_ns=end_ns):
                yield (
                    _MESSAGE.pack(
                        _MESSAGE_OPCODE,
                        _MESSAGE_FIELDS + len(message.data),
                        numbers[message.topic],
                        0,
                        message.log_time_ns,
                        message.publish_time_ns,
                    )
                    + message.data
                )
        except BagError as error:
            self._bag.complain(str(error))
