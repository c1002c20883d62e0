"""Attachments and metadata records of MCAP files, which are stored with the messages."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from turtlewire.bag.mcap_records import OPCODE_AND_LENGTH, Op, RecordReader
from turtlewire.bag.mcap_storage import McapStorage
from turtlewire.errors import BagError

if TYPE_CHECKING:
    from turtlewire.bag.mcap_reader import McapFile
    from turtlewire.bag.reader import Bag

__all__ = ["ExtraRecord", "extra_records", "extras_of_bags", "left_out"]

#: The metadata that rosbag2 writes into each file about its messages.
_OF_ROSBAG2 = "rosbag2"


@dataclass(frozen=True)
class ExtraRecord:
    """An attachment, or a metadata record.

    Attributes:
        record: Its bytes, opcode and length included.
        name: Its name.
        log_time_ns: The log time of an attachment; None for a metadata record.
    """

    record: memoryview
    name: str
    log_time_ns: int | None


def extra_records(file: McapFile, damaged: Callable[[BagError], None]) -> list[ExtraRecord]:
    """Return the attachments and metadata records of a file in its order, without rosbag2's own.

    Args:
        file: The file; the bytes of the records are views of it.
        damaged: Called for each record that cannot be read.
    """
    found: list[ExtraRecord] = []
    for position in _positions(file, damaged):
        try:
            extra = _read(file, position)
        except BagError as error:  # noqa: PERF203 - a file has few of them
            place = f"the attachment or metadata record at byte {position} is left out"
            damaged(BagError(f"{file.path}: {place}: {error}"))
        else:
            if extra.log_time_ns is not None or extra.name != _OF_ROSBAG2:
                found.append(extra)
    return found


def _positions(file: McapFile, damaged: Callable[[BagError], None]) -> list[int]:
    """Return where the records begin; if the index of the file is incomplete, look for them."""
    if len(file.extra_positions) < file.statistics.extra_records:
        found = set(file.extra_positions)
        try:
            for opcode, _, position in file.top_records():
                if opcode in (Op.ATTACHMENT, Op.METADATA):
                    found.add(position)
                elif opcode == Op.DATA_END:
                    break
        except BagError as error:
            damaged(error)
        return sorted(found)
    return sorted(file.extra_positions)


def _read(file: McapFile, position: int) -> ExtraRecord:
    opcode, record = file.record_at(position)
    reader = RecordReader(record[OPCODE_AND_LENGTH.size :])
    if opcode == Op.METADATA:
        name = reader.string()
        reader.text_map()
        return ExtraRecord(record, name, None)
    if opcode != Op.ATTACHMENT:
        raise BagError("the record is neither an attachment nor metadata")
    log_time, _ = reader.u64(), reader.u64()
    name, _ = reader.string(), reader.string()
    reader.take(reader.u64())
    reader.u32()
    return ExtraRecord(record, name, log_time)


def extras_of_bags(bags: Sequence[Bag], damaged: Callable[[BagError], None]) -> list[ExtraRecord]:
    """Return the attachments and metadata records of bags, each distinct record once."""
    found: dict[memoryview, ExtraRecord] = {}
    for bag in bags:
        for file in bag.readable_files(bag.metadata.paths, []):
            if isinstance(file, McapStorage):
                for extra in extra_records(file.file, damaged):
                    found.setdefault(extra.record, extra)
    return list(found.values())


def left_out(extras: Iterable[ExtraRecord], reason: str) -> list[str]:
    """Return a sentence for each record that no new bag has."""
    return [
        f"the metadata record '{each.name}' is left out: {reason}"
        if each.log_time_ns is None
        else f"the attachment '{each.name}' of {each.log_time_ns} ns is left out: {reason}"
        for each in extras
    ]
