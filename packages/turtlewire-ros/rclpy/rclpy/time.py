"""Points in time."""

from __future__ import annotations

from functools import total_ordering
from typing import TYPE_CHECKING, Any

from .clock_type import ClockType
from .constants import S_TO_NS
from .duration import Duration

if TYPE_CHECKING:
    from datetime import datetime

    import builtin_interfaces.msg

__all__ = ["S_TO_NS", "Time"]


@total_ordering
class Time:
    """A point in time: nanoseconds since the epoch of its clock type. Immutable.

    Args:
        seconds: Whole or fractional seconds, rounded towards zero to nanoseconds; a float keeps
            about 1e-7 s of a present date.
        nanoseconds: Added to the seconds.
        clock_type: Times of different clock types cannot be compared or subtracted.

    Raises:
        TypeError: ``clock_type`` is something else.
        ValueError: An argument is negative.
        OverflowError: The sum does not fit into 64 bits.
    """

    __slots__ = ("_clock_type", "_nanoseconds")
    __hash__ = None  # type: ignore[assignment]  # as in ROS 2

    def __init__(
        self,
        *,
        seconds: float = 0,
        nanoseconds: int = 0,
        clock_type: ClockType = ClockType.SYSTEM_TIME,
    ) -> None:
        if not isinstance(clock_type, ClockType):
            raise TypeError("Clock type must be a ClockType enum")
        if seconds < 0:
            raise ValueError("Seconds value must not be negative")
        if nanoseconds < 0:
            raise ValueError("Nanoseconds value must not be negative")
        total = int(seconds * S_TO_NS) + int(nanoseconds)
        if total >= 2**63:
            raise OverflowError("Total nanoseconds value is too large to store in C time point.")
        self._nanoseconds = total
        self._clock_type = clock_type

    @property
    def nanoseconds(self) -> int:
        """Nanoseconds since the epoch."""
        return self._nanoseconds

    def to_datetime(self) -> datetime:
        """Convert to local time without a time zone, to microseconds.

        Raises:
            TypeError: The clock is steady; its origin is unknown.
        """
        from datetime import datetime

        if self._clock_type not in (ClockType.ROS_TIME, ClockType.SYSTEM_TIME):
            raise TypeError("Time object's clock type should be either ROS_TIME or SYSTEM_TIME")
        return datetime.fromtimestamp(self._nanoseconds / S_TO_NS)  # noqa: DTZ006 - as in ROS 2

    def seconds_nanoseconds(self) -> tuple[int, int]:
        """Split into whole seconds and the nanoseconds beyond them."""
        return divmod(self._nanoseconds, S_TO_NS)

    @property
    def clock_type(self) -> ClockType:
        """The kind of clock that it belongs to."""
        return self._clock_type

    def to_msg(self) -> builtin_interfaces.msg.Time:
        """Convert to the message type, which has no clock type."""
        from builtin_interfaces.msg import Time as TimeMsg

        seconds, nanoseconds = divmod(self._nanoseconds, S_TO_NS)
        return TimeMsg(sec=seconds, nanosec=nanoseconds)

    @classmethod
    def from_msg(
        cls, msg: builtin_interfaces.msg.Time, clock_type: ClockType = ClockType.ROS_TIME
    ) -> Time:
        """Convert from the message type.

        Raises:
            TypeError: ``msg`` is not a ``builtin_interfaces.msg.Time``.
        """
        from builtin_interfaces.msg import Time as TimeMsg

        if not isinstance(msg, TimeMsg):
            raise TypeError("Must pass a builtin_interfaces.msg.Time object")
        return cls(seconds=msg.sec, nanoseconds=msg.nanosec, clock_type=clock_type)

    def __repr__(self) -> str:
        return f"Time(nanoseconds={self._nanoseconds}, clock_type={self._clock_type.name})"

    def __add__(self, other: Any) -> Time:
        if not isinstance(other, Duration):
            return NotImplemented
        try:
            return Time(
                nanoseconds=self._nanoseconds + other.nanoseconds, clock_type=self._clock_type
            )
        except OverflowError as error:
            raise OverflowError("Addition leads to overflow in C storage.") from error

    __radd__ = __add__

    def __sub__(self, other: Any) -> Any:
        if isinstance(other, Time):
            if self._clock_type != other.clock_type:
                raise TypeError("Can't subtract times with different clock types")
            return Duration(nanoseconds=self._nanoseconds - other.nanoseconds)
        if isinstance(other, Duration):
            try:
                return Time(
                    nanoseconds=self._nanoseconds - other.nanoseconds, clock_type=self._clock_type
                )
            except ValueError as error:
                raise ValueError("Subtraction leads to negative time.") from error
        return NotImplemented

    def _comparable(self, other: object) -> bool:
        if not isinstance(other, Time):
            return False
        if self._clock_type != other.clock_type:
            raise TypeError("Can't compare times with different clock types")
        return True

    def __eq__(self, other: object) -> bool:
        if not self._comparable(other):
            return NotImplemented
        return self._nanoseconds == other.nanoseconds  # type: ignore[attr-defined, no-any-return]

    def __lt__(self, other: Any) -> bool:
        return self._nanoseconds < other.nanoseconds if self._comparable(other) else NotImplemented
