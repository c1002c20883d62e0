"""Spans of time."""

from __future__ import annotations

import math
from functools import total_ordering
from typing import TYPE_CHECKING, Any

from ._rclpy_pybind11 import rcl_duration_t
from .constants import S_TO_NS

if TYPE_CHECKING:
    import builtin_interfaces.msg

__all__ = ["S_TO_NS", "Duration", "Infinite"]


@total_ordering
class Duration:
    """A span of time as a signed 64-bit number of nanoseconds. Immutable.

    Args:
        seconds: Whole or fractional seconds, rounded towards zero to nanoseconds.
        nanoseconds: Added to the seconds.

    Raises:
        OverflowError: The sum does not fit into 64 bits.
    """

    __slots__ = ("_nanoseconds",)
    __hash__ = None  # type: ignore[assignment]  # as in ROS 2

    def __init__(self, *, seconds: float = 0, nanoseconds: int = 0) -> None:
        total = int(seconds * S_TO_NS) + int(nanoseconds)
        if not -(2**63) <= total < 2**63:
            raise OverflowError("Total nanoseconds value is too large to store in C duration.")
        self._nanoseconds = total

    @property
    def nanoseconds(self) -> int:
        """The whole span in nanoseconds."""
        return self._nanoseconds

    def get_c_duration(self) -> rcl_duration_t:
        """Return the span as the structure of ROS 2's C library."""
        return rcl_duration_t(self._nanoseconds)

    def to_msg(self) -> builtin_interfaces.msg.Duration:
        """Convert to the message type.

        A negative span has negative seconds and non-negative nanoseconds.
        """
        from builtin_interfaces.msg import Duration as DurationMsg

        seconds, nanoseconds = divmod(self._nanoseconds, S_TO_NS)
        return DurationMsg(sec=seconds, nanosec=nanoseconds)

    @classmethod
    def from_msg(cls, msg: builtin_interfaces.msg.Duration) -> Duration:
        """Convert from the message type.

        Raises:
            TypeError: ``msg`` is not a ``builtin_interfaces.msg.Duration``.
        """
        from builtin_interfaces.msg import Duration as DurationMsg

        if not isinstance(msg, DurationMsg):
            raise TypeError("Must pass a builtin_interfaces.msg.Duration object")
        return cls(seconds=msg.sec, nanoseconds=msg.nanosec)

    def __add__(self, other: Duration) -> Duration:
        if not isinstance(other, Duration):
            return NotImplemented
        return Duration(nanoseconds=self._nanoseconds + other.nanoseconds)

    def __sub__(self, other: Duration) -> Duration:
        if not isinstance(other, Duration):
            return NotImplemented
        return Duration(nanoseconds=self._nanoseconds - other.nanoseconds)

    def __mul__(self, factor: float) -> Duration:
        if not isinstance(factor, (int, float)):
            return NotImplemented
        if math.isnan(factor) or factor == -math.inf:
            raise ValueError("Can't multiply duration with nan")  # also for -inf
        if factor == math.inf:
            return Infinite
        return Duration(nanoseconds=int(self._nanoseconds * factor))

    def __repr__(self) -> str:
        return f"Duration(nanoseconds={self._nanoseconds})"

    def __str__(self) -> str:
        return (
            "Infinite"
            if self._nanoseconds == Infinite.nanoseconds
            else f"{self._nanoseconds} nanoseconds"
        )

    def __eq__(self, other: object) -> bool:
        return (
            self._nanoseconds == other.nanoseconds
            if isinstance(other, Duration)
            else NotImplemented
        )

    def __lt__(self, other: Any) -> bool:
        return (
            self._nanoseconds < other.nanoseconds if isinstance(other, Duration) else NotImplemented
        )


#: A span that never ends: what a QoS policy has when it is not limited.
Infinite = Duration(nanoseconds=2**63 - 1)
