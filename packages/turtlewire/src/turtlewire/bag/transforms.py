"""Reads the transforms of a bag into a buffer.

The bytes of the messages go straight into the buffer. Chunks without transforms are skipped by
their index, and a second thread decompresses the next chunk while the buffer stores the previous
one.
"""

from __future__ import annotations

import os
import struct
from collections.abc import Callable, Iterable, Iterator
from contextlib import nullcontext
from itertools import islice
from typing import TYPE_CHECKING

from turtlewire.bag.message_choice import check_unit, window
from turtlewire.bag.metadata import is_cdr, not_in_cdr
from turtlewire.bag.progress import progress_line
from turtlewire.bag.reader import Bag
from turtlewire.bag.trajectories import pose_topics
from turtlewire.bag.transform_report import StepsBack, TransformReport, describe, group_jumps
from turtlewire.errors import BagError
from turtlewire.tf.implementation import RecordWalk

if TYPE_CHECKING:
    from turtlewire.tf.datetimes import Stamp
    from turtlewire.tf.implementation import BaseBuffer

__all__ = ["fill_buffer"]

_TF_TYPE = "tf2_msgs/msg/TFMessage"
_FOREVER = (1 << 64) - 1
#: Opcode, length, channel, sequence, log time and publish time of an MCAP message.
_MESSAGE = struct.Struct("<BQHIQQ")
_MESSAGE_OPCODE = 5
_MESSAGE_FIELDS = 22
_ROWS_AT_A_TIME = 1000
_TOPICS_SHOWN = 8


def fill_buffer(
    buffer: BaseBuffer,
    path: str | os.PathLike[str] | Bag,
    *,
    topics: str | Iterable[str] = "/tf",
    static_topics: str | Iterable[str] = "/tf_static",
    start_ns: Stamp | None = None,
    end_ns: Stamp | None = None,
    progress: Callable[[float], None] | None = None,
) -> TransformReport:
    """Read the transforms of a bag into a buffer; see `Buffer.from_bag`."""
    start, end = window(start_ns, end_ns)
    moving, fixed = _names(topics), _names(static_topics)
    with nullcontext(path) if isinstance(path, Bag) else Bag(path) as bag:
        check_unit(bag.metadata, start_ns=start, end_ns=end)
        name = os.path.basename(os.path.abspath(bag.path))
        report = TransformReport(name)
        # The default names need not be in the bag.
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
            walk = RecordWalk(0, _FOREVER) if static else RecordWalk(start, end)
            reader = _Reader(bag, walk, buffer, (lambda _: None) if static else tell)
            reader.read(names & known.keys(), start, end, static=static)
            report.messages += walk.messages
            report.jumps += group_jumps(walk.jumps)
            for child, steps in walk.steps_back.items():
                report.steps_back[child] = StepsBack(*steps)
        tell(1.0)
        report.problems = bag.problems + _empty_window(bag, start, end)
        report.part_of = bag.part_of
    describe(buffer, report)
    return report


def _empty_window(bag: Bag, start_ns: int, end_ns: int) -> list[str]:
    """Return a complaint if no message of the bag lies in the window."""
    if not len(bag) or (start_ns <= bag.end_ns and end_ns >= bag.start_ns):
        return []
    asked = f"{start_ns} to {end_ns}" if end_ns < _FOREVER else f"{start_ns} on"
    covered = f"{bag.start_ns} to {bag.end_ns}"
    return [f"there are no messages in the window, from {asked}: the bag covers {covered}"]


def _names(topics: str | Iterable[str]) -> set[str]:
    return {topics} if isinstance(topics, str) else set(topics)


def _check_topics(bag: Bag, wanted: set[str], chosen: set[str]) -> None:
    """Refuse a bag without any of the wanted topics, or without one of those chosen by name."""
    missing = sorted(chosen - bag.topics.keys())
    for name in sorted(chosen & bag.topics.keys()):
        topic = bag.topics[name]
        if topic.type not in (_TF_TYPE, "") and is_cdr(topic):  # unknown in a damaged file
            text = f"{name} is of type {topic.type}, not {_TF_TYPE}"
            raise BagError(text).with_hint(_what_it_has(bag))
    present = [bag.topics[name] for name in wanted & bag.topics.keys()]
    if foreign := not_in_cdr(topic for topic in present if not is_cdr(topic)):
        raise BagError(f"{bag.path} has no transforms that can be read").with_hint(foreign)
    if wanted & bag.topics.keys() and not missing:
        return
    damage = [f"Damaged: {text}." for text in bag.problems]
    if wanted & bag.topics.keys():
        text = f"{bag.path} has no topic {' and no topic '.join(missing)}"
    else:
        text = f"{bag.path} has none of the topics {', '.join(sorted(wanted))}"
    foreign = not_in_cdr(bag.topics.values())
    raise BagError(text).with_hint(" ".join(filter(None, (_what_it_has(bag), foreign, *damage))))


def _what_it_has(bag: Bag) -> str:
    """Return the topics with transforms; without any, what else there is."""
    topics = bag.topics.values()
    if similar := [topic.name for topic in topics if topic.type == _TF_TYPE]:
        return f"Topics of type {_TF_TYPE} in it: {', '.join(similar)}."
    if not topics:
        return "It has no TF."
    shown = [f"{topic.name} ({topic.type})" for topic in islice(topics, _TOPICS_SHOWN)]
    more = len(bag.topics) - len(shown)
    text = f"It has no TF (messages of type {_TF_TYPE}), only {', '.join(shown)}"
    text += f" and {more} more." if more else "."
    if poses := pose_topics(bag):
        text += f" Trajectory.from_bag reads the poses of {', '.join(poses)}."
    return text


class _Reader:
    """Reads the messages of some topics into a buffer; a `TransformTarget`."""

    def __init__(
        self, bag: Bag, walk: RecordWalk, buffer: BaseBuffer, tell: Callable[[float], None]
    ) -> None:
        self._bag = bag
        self._walk = walk
        self._buffer = buffer
        self._tell = tell
        self._static = False
        self._files_read = 0

    def read(self, names: set[str], start_ns: int, end_ns: int, *, static: bool) -> None:
        """Read the messages of topics whose log time lies in the walk's window."""
        if not names:
            return
        self._static = static
        if static:
            start_ns, end_ns = 0, _FOREVER
        for number, path in enumerate(self._bag.metadata.paths):
            self._files_read = number
            for file in self._bag.readable_files([path], []):  # one, or none
                if self._bag.metadata.compression_mode == "MESSAGE" or not file.walk_transforms(
                    names, start_ns, end_ns, self
                ):
                    self._read_rows(names, start_ns, end_ns)
                    return  # rows come in order of time over all files

    @property
    def messages(self) -> int:
        """Number of messages taken so far."""
        return self._walk.messages

    @property
    def problems(self) -> list[str]:
        """Problems of the bag's files."""
        return self._bag.problems

    def take(self, records: bytes | memoryview, topics: dict[int, str]) -> int:
        """Store the transforms of a chunk's records; return where they are damaged, else -1."""
        channels = {number: (name, self._static) for number, name in topics.items()}
        return self._walk.walk(self._buffer, records, channels)

    def complain(self, problem: str) -> None:
        """Add to the bag's problems."""
        self._bag.complain(problem)

    def tell(self, share: float) -> None:
        """Report which share of the present file was read."""
        self._tell((self._files_read + share) / len(self._bag.metadata.paths))

    def _read_rows(self, names: set[str], start_ns: int, end_ns: int) -> None:
        """Read storages without chunks, as records that are made here."""
        numbers = {name: number for number, name in enumerate(sorted(names))}
        topics = {number: name for name, number in numbers.items()}
        known = self._bag.topics
        expected = sum(known[name].message_count for name in names) or 1
        records = self._records(names, numbers, start_ns, end_ns)
        done = 0
        while batch := list(islice(records, _ROWS_AT_A_TIME)):
            self.take(b"".join(batch), topics)
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
