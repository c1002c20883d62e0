"""Ids of goals, and their serialized states: bytes of ``action_msgs/msg/GoalStatusArray``.

A server publishes the states of all of its goals whenever one of them changes, and keeps a finished
goal until its result expires, a quarter of an hour by default. Each goal is a record of fixed size,
so neither side has to make message objects of all of them for the one that has changed.
"""

from __future__ import annotations

import os
from collections.abc import Collection, Iterable
from struct import Struct
from typing import Any

from turtlewire.msg import deserialize, get_message
from turtlewire.msg.values import array_content

_HEADER = Struct("<4sI")
_LITTLE_ENDIAN = b"\x00\x01\x00\x00"
#: UUID, what aligns the next field, seconds and nanoseconds of the acceptance, state.
_RECORD = Struct("<16s3xiIb")
_STATE_OFFSET = 27
#: The first UUID ends aligned: there, the padding of its record is missing.
_FIRST_PADDING = slice(16, 19)
_FIRST_STAMP = _HEADER.size + _FIRST_PADDING.start
#: From this many goals on, a lookup by id is faster than reading all records.
_FEW = 16


def goal_key(goal_id: Any) -> bytes:
    """Return the 16 bytes of a ``unique_identifier_msgs/msg/UUID``, without NumPy."""
    return array_content(goal_id, "uuid")


def random_goal_id() -> Any:
    """Return a random UUID, version 4."""
    value = bytearray(os.urandom(16))
    # The bits of version and variant, as in RFC 4122.
    value[6] = value[6] & 0x0F | 0x40
    value[8] = value[8] & 0x3F | 0x80
    return get_message("unique_identifier_msgs/msg/UUID")(uuid=bytes(value))


class GoalStatuses:
    """The states of a server's goals, ready to be published. Not thread-safe."""

    def __init__(self) -> None:
        self._records = bytearray()
        self._places: dict[bytes, int] = {}

    def add(self, goal: bytes, sec: int, nanosec: int, status: int) -> None:
        """Add a goal with the time of its acceptance."""
        self._places[goal] = len(self._records)
        self._records += _RECORD.pack(goal, sec, nanosec, status)

    def change(self, goal: bytes, status: int) -> None:
        """Set the state of a goal; one that was removed stays removed."""
        place = self._places.get(goal)
        if place is not None:
            self._records[place + _STATE_OFFSET] = status

    def remove(self, goals: Iterable[bytes]) -> None:
        """Remove goals; ids of unknown goals are ignored."""
        gone = {goal for goal in goals if goal in self._places}
        if not gone:
            return
        kept = [(goal, place) for goal, place in self._places.items() if goal not in gone]
        size = _RECORD.size
        self._records = bytearray().join(self._records[at : at + size] for _, at in kept)
        self._places = {goal: index * size for index, (goal, _) in enumerate(kept)}

    def cdr(self) -> bytes:
        """Return the serialized ``action_msgs/msg/GoalStatusArray``."""
        records = bytes(self._records)
        first, rest = records[: _FIRST_PADDING.start], records[_FIRST_PADDING.stop :]
        return b"".join((_HEADER.pack(_LITTLE_ENDIAN, len(self._places)), first, rest))


def read_statuses(cdr: bytes, goals: Collection[bytes]) -> list[tuple[bytes, int]]:
    """Id and state of the ``goals`` that a serialized ``GoalStatusArray`` has.

    Raises:
        CdrError: The bytes are malformed.
    """
    records = _records_of(cdr)
    if records is None:
        return _decoded(cdr, goals)
    if len(goals) <= _FEW:
        return _searched(records, goals)
    wanted = set(goals)
    return [(goal, state) for goal, _, _, state in _RECORD.iter_unpack(records) if goal in wanted]


def _records_of(cdr: bytes) -> bytes | None:
    """Return the records; None if they are big endian or not as many as they say."""
    if len(cdr) < _HEADER.size or not cdr.startswith(_LITTLE_ENDIAN[:2]):
        return None
    size = _HEADER.unpack_from(cdr)[1] * _RECORD.size
    first, rest = cdr[_HEADER.size : _FIRST_STAMP], cdr[_FIRST_STAMP:]
    # With the missing padding put back, all records have the same size.
    records = b"".join((first, bytes(3), rest))[:size]
    return records if len(records) == size else None


def _decoded(cdr: bytes, goals: Collection[bytes]) -> list[tuple[bytes, int]]:
    """Decode unusual bytes: big endian, longer than announced, or malformed."""
    message: Any = deserialize(get_message("action_msgs/msg/GoalStatusArray"), cdr)
    states = ((goal_key(state.goal_info.goal_id), state.status) for state in message.status_list)
    return [(goal, state) for goal, state in states if goal in goals]


def _searched(records: bytes, goals: Collection[bytes]) -> list[tuple[bytes, int]]:
    found = []
    for goal in goals:
        place = records.rfind(goal)  # from the end: mostly new goals change
        while place % _RECORD.size and place >= 0:  # by chance, across parts of records
            place = records.rfind(goal, 0, place + len(goal) - 1)
        if place >= 0:
            found.append((goal, records[place + _STATE_OFFSET]))
    return found
