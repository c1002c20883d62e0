"""A diagnostic status with methods that fill it."""

from __future__ import annotations

from typing import Any

from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

__all__ = ["DiagnosticStatusWrapper"]

_OK = DiagnosticStatus.OK


class DiagnosticStatusWrapper(DiagnosticStatus):
    """A ``DiagnosticStatus`` that a task fills."""

    def summary(self, *status_or_level_and_message: Any) -> None:
        """Set level and message: ``summary(level, message)``, or as another status has them."""
        self.level, self.message = _level_and_message(status_or_level_and_message)

    def clearSummary(self) -> None:  # noqa: N802  ROS 2's name
        """Set the level OK, and no message."""
        self.summary(_OK, "")

    def mergeSummary(self, *status_or_level_and_message: Any) -> None:  # noqa: N802
        """Add level and message: the worse level wins, and its message.

        Messages are joined if both say that something is wrong, or both that nothing is.
        """
        level, message = _level_and_message(status_or_level_and_message)
        if (level > _OK) == (self.level > _OK):
            self.message = "; ".join(text for text in (self.message, message) if text)
        elif level > self.level:
            self.message = message
        self.level = max(level, self.level)

    def add(self, key: str, val: Any) -> None:
        """Add a value, as text."""
        self.values.append(KeyValue(key=key, value=str(val)))


def _level_and_message(given: tuple[Any, ...]) -> tuple[bytes, str]:
    level, message = (given[0].level, given[0].message) if len(given) == 1 else given
    return bytes([level]) if isinstance(level, int) else level, message
