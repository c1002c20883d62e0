"""The times of a call of a timer, and the parameter of a callback that gets them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rclpy.clock_type import ClockType
from rclpy.time import Time


class TimerInfo:
    """The times of a call of a timer: when it was due, and when it was made.

    A callback of a timer gets one for the parameter that is annotated with this class.

    Args:
        expected_call_time: Time at which the call was due, in nanoseconds.
        actual_call_time: Time at which it was made, in nanoseconds.
        clock_type: The clock of both.
    """

    def __init__(
        self,
        *,
        expected_call_time: int = 0,
        actual_call_time: int = 0,
        clock_type: ClockType = ClockType.SYSTEM_TIME,
    ) -> None:
        self._expected_call_time = Time(nanoseconds=expected_call_time, clock_type=clock_type)
        self._actual_call_time = Time(nanoseconds=actual_call_time, clock_type=clock_type)

    @property
    def expected_call_time(self) -> Time:
        """Time at which the call was due."""
        return self._expected_call_time

    @property
    def actual_call_time(self) -> Time:
        """Time at which the call was made."""
        return self._actual_call_time


def parameter_for_info(callback: Callable[..., Any]) -> str:
    """Return the parameter that is annotated with `TimerInfo`; empty without one.

    Annotations may be texts.
    """
    notes: dict[str, object] = getattr(callback, "__annotations__", None) or {}
    for name, note in notes.items():
        if name != "return" and (note is TimerInfo or str(note).endswith("TimerInfo")):
            return name
    return ""
