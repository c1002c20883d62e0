"""The transforms of a bag, in a buffer.

The bytes of the messages go straight into the buffer. Chunks without transforms are skipped by
their index, and a second thread decompresses the next chunk while the buffer takes the last one.
"""

from __future__ import annotations

import os
import struct
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from turtlewire.bag.reader import Bag
from turtlewire.bag.storage import McapStorage
from turtlewire.errors import BagError, CdrError
from turtlewire.tf.buffer import Buffer
from turtlewire.tf.inspection import conflicts, links, malformed, refusals

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from turtlewire.bag.mcap_records import ChunkIndex
    from turtlewire.bag.metadata import TopicInfo
    from turtlewire.tf.inspection import Conflict, LinkInfo, Malformed, Refused
    from turtlewire.trajectory import Gap

__all__ = ["TransformReport", "load_transforms"]

_TF_TYPE = "tf2_msgs/msg/TFMessage"
_FOREVER = (1 << 64) - 1
#: Stamps that fall back by more than this are a jump of time, not messages out of order.
_JUMP_NS = 1_000_000_000
#: Seconds and nanoseconds of the first transform, behind the CDR header and the sequence's length.
_FIRST_STAMP, _FIRST_STAMP_OFFSET = struct.Struct("<iI"), 8
_AUTHORITY = "bag"
_REDRAW_SECONDS = 0.1


@dataclass
class TransformReport:
    """What `load_transforms` found.

    Attributes:
        messages: Messages of ``/tf`` and ``/tf_static`` that were read.
        links: Each link with its rate, times and senders.
        gaps: Pauses in the samples of links, by child frame.
        jumps: Log times at which the stamps of ``/tf`` jump back by more than a second: a bag that
            was recorded while another was played in a loop, for example.
        conflicts: Frames with two parents.
        refused: Transforms that tf2 refuses, by child frame.
        malformed: Messages that are no ``TFMessage``.
        problems: Damaged parts of the bag.
    """

    messages: int = 0
    links: list[LinkInfo] = field(default_factory=list)
    gaps: dict[str, list[Gap]] = field(default_factory=dict)
    jumps: list[int] = field(default_factory=list)
    conflicts: list[Conflict] = field(default_factory=list)
    refused: dict[str, Refused] = field(default_factory=dict)
    malformed: Malformed | None = None
    problems: list[str] = field(default_factory=list)


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
        start_ns: Log time of the first message to take.
        end_ns: Log time of the last message to take.
        cache_time_ns: How much history the buffer keeps; None keeps all.
        progress: Called with the share that was read, from 0 to 1; by default a line is drawn on a
            terminal when reading takes more than a second.

    Returns:
        The buffer, and what was found.

    Raises:
        FileNotFoundError: There is nothing at ``path``.
        BagError: It is no bag, or none of the topics is in it.
    """
    moving, fixed = _names(topics), _names(static_topics)
    buffer = Buffer(cache_time_ns)
    report = TransformReport()
    with Bag(path) as bag:
        _check_topics(bag, moving | fixed)
        reader = _Reader(bag, buffer, report)
        tell = progress or _line_of_progress(os.path.basename(os.path.abspath(path)))
        reader.read(fixed, 0, _FOREVER, static=True)
        reader.read(moving, start_ns, end_ns, static=False, progress=tell)
        tell(1.0)
        report.problems = bag.problems
    _describe(buffer, report)
    return buffer, report


def _names(topics: str | Iterable[str]) -> set[str]:
    return {topics} if isinstance(topics, str) else set(topics)


def _check_topics(bag: Bag, wanted: set[str]) -> None:
    if wanted & bag.topics.keys():
        return
    similar = [name for name, topic in bag.topics.items() if topic.type == _TF_TYPE]
    names = ", ".join(sorted(wanted))
    raise BagError(f"{bag.path} has none of the topics {names}").with_hint(
        f"Topics of type {_TF_TYPE} in it: {', '.join(similar)}." if similar else "It has no TF."
    )


class _Reader:
    """Reads the messages of some topics into a buffer."""

    def __init__(self, bag: Bag, buffer: Buffer, report: TransformReport) -> None:
        self._bag = bag
        self._buffer = buffer
        self._report = report
        self._newest_ns = 0

    def read(
        self,
        names: set[str],
        start_ns: int,
        end_ns: int,
        *,
        static: bool,
        progress: Callable[[float], None] | None = None,
    ) -> None:
        """Read the messages of topics whose log time lies between two times (both included)."""

        def wanted(topic: TopicInfo) -> bool:
            return topic.name in names

        known = self._bag.topics
        expected = sum(known[name].message_count for name in names & known.keys())
        done = 0
        for messages in self._batches(wanted, start_ns, end_ns):
            for log_time, data in messages:
                if start_ns <= log_time <= end_ns:
                    self._take(log_time, data, static)
                    done += 1
            if progress is not None:
                progress(min(1.0, done / (expected or 1)))
        self._report.messages += done

    def _batches(
        self, wanted: Callable[[TopicInfo], bool], start_ns: int, end_ns: int
    ) -> Iterator[Iterator[tuple[int, bytes]]]:
        """Log times and bytes of the wanted messages, a chunk at a time where there are chunks."""
        if self._bag.metadata.storage == "mcap":
            for file in self._bag.files():
                if isinstance(file, McapStorage):
                    yield from self._chunks(file, wanted, start_ns, end_ns)
        else:
            yield self._rows(wanted, start_ns, end_ns)

    def _rows(
        self, wanted: Callable[[TopicInfo], bool], start_ns: int, end_ns: int
    ) -> Iterator[tuple[int, bytes]]:
        names = [topic.name for topic in self._bag.topics.values() if wanted(topic)]
        try:
            for message in self._bag.messages(names, start_ns=start_ns, end_ns=end_ns):
                yield message.log_time_ns, message.data
        except BagError as error:
            self._damaged(error)

    def _chunks(
        self, file: McapStorage, wanted: Callable[[TopicInfo], bool], start_ns: int, end_ns: int
    ) -> Iterator[Iterator[tuple[int, bytes]]]:
        """The same for the chunks of one file, each decompressed while the last is taken."""
        channels = {number for number in file.file.channels if wanted(file.topic(number))}
        chunks = file.chunks(wanted, start_ns, end_ns)

        def messages(records: bytes, chunk: ChunkIndex) -> Iterator[tuple[int, bytes]]:
            try:
                for log_time, _, _, data in file.file.messages_in(records, chunk, channels):
                    yield log_time, data
            except BagError as error:
                self._damaged(error)

        with ThreadPoolExecutor(1, "bag") as thread:
            ahead = [thread.submit(file.file.records, chunk) for chunk in chunks[:1]]
            for i, chunk in enumerate(chunks):
                current = ahead.pop()
                ahead += [
                    thread.submit(file.file.records, next_) for next_ in chunks[i + 1 : i + 2]
                ]
                try:
                    records = current.result()
                except BagError as error:
                    self._damaged(error)
                else:
                    yield messages(records, chunk)

    def _damaged(self, error: BagError) -> None:
        self._bag.problems.append(str(error))

    def _take(self, log_time: int, data: bytes, static: bool) -> None:
        try:
            self._buffer.ingest(data, static, _AUTHORITY)
        except CdrError:
            return  # the buffer counts them
        if static or len(data) < _FIRST_STAMP.size + _FIRST_STAMP_OFFSET:
            return
        seconds, nanoseconds = _FIRST_STAMP.unpack_from(data, _FIRST_STAMP_OFFSET)
        stamp = seconds * 1_000_000_000 + nanoseconds
        if stamp < self._newest_ns - _JUMP_NS:
            self._report.jumps.append(log_time)
            self._newest_ns = stamp
        elif stamp > self._newest_ns:
            self._newest_ns = stamp


def _describe(buffer: Buffer, report: TransformReport) -> None:
    """Add to the report what the filled buffer tells."""
    import numpy as np

    from turtlewire.trajectory import find_gaps

    report.links = links(buffer)
    report.conflicts = conflicts(buffer)
    report.refused = refusals(buffer)
    report.malformed = malformed(buffer)
    for link in report.links:
        if not link.static and link.samples > 2:
            stamps = np.concatenate([run[1] for run in buffer.samples(link.child_frame)])
            if found := find_gaps(stamps):
                report.gaps[link.child_frame] = found


def _line_of_progress(name: str) -> Callable[[float], None]:
    """Draws one line on a terminal when reading takes more than a second; else does nothing."""
    started = time.monotonic()
    shown = 0.0

    def tell(share: float) -> None:
        nonlocal shown
        now = time.monotonic()
        if share >= 1.0 and shown:
            print("\r\033[K", end="", file=sys.stderr, flush=True)  # noqa: T201
        elif now - started > 1.0 and now - shown > _REDRAW_SECONDS:
            shown = now
            print(f"\rreading {name}: {share:4.0%}", end="", file=sys.stderr, flush=True)  # noqa: T201

    return tell if sys.stderr.isatty() else lambda _share: None
