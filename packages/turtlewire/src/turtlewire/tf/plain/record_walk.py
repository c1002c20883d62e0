"""Walks the records of an MCAP chunk and adds the TFMessages among them to a buffer."""

from __future__ import annotations

import struct
from collections.abc import Mapping
from typing import TYPE_CHECKING

from turtlewire.errors import CdrError

if TYPE_CHECKING:
    from typing import Protocol

    class TakesMessages(Protocol):
        """A Buffer of either core."""

        def add_tf_message(self, cdr: bytes, *, static: bool = ..., sender: str = ...) -> int:
            """Add the transforms of one message."""
            ...


_PREFIX = struct.Struct("<BQ")  # opcode, length
_MESSAGE = struct.Struct("<BQHIQQ")  # those, channel, sequence, log time, publish time
_MESSAGE_OPCODE = 5
_SHORTEST_MESSAGE = _MESSAGE.size - _PREFIX.size
#: Stamps that fall back by more than this are a jump of time, not messages out of order.
_JUMP_NS = 1_000_000_000
#: Of a TFMessage in CDR of each byte order: the number of its transforms, the first one's stamp.
_read_big_head = struct.Struct(">xxxxIiI").unpack_from
_read_little_head = struct.Struct("<xxxxIiI").unpack_from
_NAMES_AT = 16
_NUMBERS_SIZE = 56
_SMALLEST = _NAMES_AT + _NUMBERS_SIZE


class _Clock:
    """The newest stamp of a frame since its last jump."""

    __slots__ = ("child", "newest")

    def __init__(self, child: bytes, newest: int) -> None:
        self.child, self.newest = child, newest


class RecordWalk:
    """Walks the records of MCAP chunks and adds the TFMessages among them to a buffer.

    One thread at a time may use it. Messages that are not a TFMessage are counted by the buffer, as
    in ``add_tf_message``.

    Args:
        start_ns: The first log time of the messages that are taken.
        end_ns: The last log time.

    Attributes:
        messages: How many messages were taken.
        jumps: Where stamps fall back by more than a second: log time, the child frame of the
            message's first transform, and by how much, in nanoseconds.
        steps_back: How many stamps of such a frame lie before its newest, and the largest step back
            in nanoseconds, if there is one.
    """

    def __init__(self, start_ns: int, end_ns: int) -> None:
        self._start_ns, self._end_ns = start_ns, end_ns
        self._clocks: dict[bytes, _Clock] = {}  # by the child frame
        self._known: dict[bytes, _Clock] = {}  # by the names of a message with one transform
        self.messages = 0
        self.jumps: list[tuple[int, str, int]] = []
        self.steps_back: dict[str, tuple[int, int]] = {}

    def walk(
        self,
        buffer: TakesMessages,
        records: bytes | memoryview,
        channels: Mapping[int, tuple[str, bool]],
    ) -> int:
        """Add the messages of a chunk's decompressed records.

        Args:
            buffer: Where to.
            records: The bytes.
            channels: By the number of a channel: its sender, and whether its transforms are
                static. Other channels are passed over.

        Returns:
            Where the first record begins that is cut off, all before it being added; -1 if no
            record is cut off.
        """
        data = bytes(records)
        end, start_ns, end_ns = len(data), self._start_ns, self._end_ns
        read, fields, prefix = _MESSAGE.unpack_from, _MESSAGE.size, _PREFIX.size
        channel_of, take = channels.get, self._take
        at, last = 0, end - fields
        while at < end:
            if at > last:  # no room for a message
                at = _skip(data, at)
                if at < 0:
                    return -1 - at
                continue
            opcode, length, number, _, log_time, _ = read(data, at)
            following = at + prefix + length
            if following > end or (opcode == _MESSAGE_OPCODE and length < _SHORTEST_MESSAGE):
                return at
            if opcode == _MESSAGE_OPCODE:
                channel = channel_of(number)
                if channel is not None and start_ns <= log_time <= end_ns:
                    take(buffer, log_time, data[at + fields : following], channel)
            at = following
        return -1

    def _take(
        self, buffer: TakesMessages, log_time: int, data: bytes, channel: tuple[str, bool]
    ) -> None:
        sender, static = channel
        self.messages += 1
        try:
            buffer.add_tf_message(data, static=static, sender=sender)
        except CdrError:
            return  # the buffer counts them
        if static or len(data) < _SMALLEST:  # without transforms
            return
        count, seconds, nanoseconds = (_read_little_head if data[1] else _read_big_head)(data)
        if not count:  # the rest is not a transform
            return
        stamp = seconds * 1_000_000_000 + nanoseconds
        # The names of a message with one transform lie between its head and its numbers.
        names = data[_NAMES_AT:-_NUMBERS_SIZE] if count == 1 else b""
        clock = self._known.get(names)
        if clock is None:
            clock = self._clocks.setdefault(child := _first_child(data), _Clock(child, stamp))
            if names:
                self._known[names] = clock
        if stamp >= clock.newest:
            clock.newest = stamp
        else:
            self._note_step_back(log_time, clock, stamp)

    def _note_step_back(self, log_time: int, clock: _Clock, stamp: int) -> None:
        name, back = clock.child.decode(errors="replace"), clock.newest - stamp
        count, largest = self.steps_back.get(name, (0, 0))
        self.steps_back[name] = count + 1, max(back, largest)
        if back > _JUMP_NS:
            self.jumps.append((log_time, name, back))
            clock.newest = stamp


def _skip(data: bytes, at: int) -> int:
    """Return the start of the record after the one at ``at``; -1 - at if that one is cut off."""
    if at + _PREFIX.size > len(data):
        return -1 - at
    opcode, length = _PREFIX.unpack_from(data, at)
    following: int = at + _PREFIX.size + length
    cut_off = following > len(data) or opcode == _MESSAGE_OPCODE
    return -1 - at if cut_off else following


def _first_child(data: bytes) -> bytes:
    """Return the child frame of the first transform of a message."""
    layout = struct.Struct("<I" if data[1] else ">I")
    (length,) = layout.unpack_from(data, _NAMES_AT)
    at = (_NAMES_AT + 4 + length + 3) // 4 * 4
    (length,) = layout.unpack_from(data, at)
    return data[at + 4 : at + 4 + max(0, length - 1)]
