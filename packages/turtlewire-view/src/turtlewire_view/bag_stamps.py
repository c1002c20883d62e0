"""Maps the time of a bag to stamps that come from another clock."""

from __future__ import annotations

import struct
from bisect import bisect_right
from typing import TYPE_CHECKING

from turtlewire.bag import open_bag

if TYPE_CHECKING:
    import os

__all__ = ["StampsOfLog"]

_TF = "/tf"
#: After the encapsulation: the number of transforms, seconds and nanoseconds of the first one.
_HEAD = {0: struct.Struct(">IiI"), 1: struct.Struct("<IiI")}
_AFTER_ENCAPSULATION = 4


class StampsOfLog:
    """The stamp that transforms had at a log time of a bag.

    A simulation's transforms have its time, but ``ros2 bag record`` notes the system time unless it
    is started with ``--use-sim-time``. A bag that was recorded while another one was played is the
    same.

    Args:
        path: The bag; all messages of its ``/tf`` are looked at.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self._log_ns: list[int] = []
        self._stamps_ns: list[int] = []
        with open_bag(path) as bag:
            for message in bag.messages({_TF}):
                stamp_ns = _first_stamp_ns(message.data)
                if stamp_ns is not None:
                    self._log_ns.append(message.log_time_ns)
                    self._stamps_ns.append(stamp_ns)

    def at(self, log_time_ns: int) -> int:
        """Return the last stamp that was received until then; 0 before the first."""
        count = bisect_right(self._log_ns, log_time_ns)
        return self._stamps_ns[count - 1] if count else 0


def _first_stamp_ns(data: bytes) -> int | None:
    """Return the stamp of the first transform of a serialized message; None if it has none."""
    if len(data) < _AFTER_ENCAPSULATION + _HEAD[1].size:
        return None
    count, seconds, nanoseconds = _HEAD[data[1] & 1].unpack_from(data, _AFTER_ENCAPSULATION)
    return seconds * 10**9 + nanoseconds if count else None
