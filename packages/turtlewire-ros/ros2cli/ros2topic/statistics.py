"""Statistics of arriving messages, with the texts of ROS 2."""

from __future__ import annotations

import collections
import math
import statistics
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Collection

__all__ = ["Delays", "Intervals", "Sizes", "rate_text", "spread"]


def spread(values: Collection[float]) -> tuple[float, float]:
    """Mean and standard deviation."""
    mean = statistics.fmean(values)
    return mean, math.sqrt(statistics.fmean((value - mean) ** 2 for value in values))


def rate_text(rate: float, shortest: float, longest: float, deviation: float, count: int) -> str:
    """Two lines about a rate [1/s], times between messages [s] and the number of messages."""
    return (
        f"average rate: {rate:.3f}\n"
        f"\tmin: {shortest:.3f}s max: {longest:.3f}s std dev: {deviation:.5f}s"
        f" window: {count}\n"
    )


class Intervals:
    """The times between messages.

    Args:
        window: How many messages count.
    """

    def __init__(self, window: int) -> None:
        self._values: collections.deque[float] = collections.deque(maxlen=max(window - 1, 1))
        self._last_ns: int | None = None
        self._is_new = False

    def add(self, now_ns: int) -> None:
        """Note a message."""
        if self._last_ns is not None and now_ns >= self._last_ns:
            self._values.append((now_ns - self._last_ns) / 1e9)
            self._is_new = True
        elif self._last_ns is not None:  # simulated time began anew
            self._values.clear()
        self._last_ns = now_ns

    def report(self) -> str:
        """Two lines, or nothing when nothing came since the last report."""
        if not self._is_new:
            return ""
        self._is_new = False
        mean, deviation = spread(self._values)
        rate = 1.0 / mean if mean > 0 else 0.0
        shortest, longest = min(self._values), max(self._values)
        return rate_text(rate, shortest, longest, deviation, len(self._values) + 1)


class Delays:
    """The times between stamp and arrival of messages.

    Args:
        window: How many messages count.

    Attributes:
        is_new: Whether a message came since the last report or summary.
    """

    def __init__(self, window: int) -> None:
        self._values: collections.deque[float] = collections.deque(maxlen=window)
        self.is_new = False

    def add(self, delay_s: float) -> None:
        """Note a message."""
        self._values.append(delay_s)
        self.is_new = True

    def report(self) -> str:
        """Two lines, or nothing when nothing came since the last report."""
        if not self.is_new:
            return ""
        mean, shortest, longest, deviation, count = self.summary()
        return (
            f"average delay: {mean:.3f}\n"
            f"\tmin: {shortest:.3f}s max: {longest:.3f}s"
            f" std dev: {deviation:.5f}s window: {count}\n"
        )

    def summary(self) -> tuple[float, float, float, float, int]:
        """Mean, minimum, maximum and standard deviation [s], and how many messages count.

        Raises:
            ValueError: There was no message yet.
        """
        self.is_new = False
        mean, deviation = spread(self._values)
        return mean, min(self._values), max(self._values), deviation, len(self._values)


class Sizes:
    """The sizes of messages, and how fast they come.

    Args:
        window: How many messages count.
    """

    def __init__(self, window: int) -> None:
        self._values: collections.deque[tuple[float, int]] = collections.deque(maxlen=window)

    def add(self, now_s: float, size: int) -> None:
        """Note a message."""
        self._values.append((now_s, size))

    def __len__(self) -> int:
        return len(self._values)

    def report(self, now_s: float) -> str:
        """Two lines, or nothing before the second message."""
        if len(self._values) < 2:
            return ""
        rate, count, *sizes = self.summary(now_s)
        unit, divisor, digits = (
            ("B", 1, 0) if rate < 1e3 else ("KB", 1e3, 2) if rate < 1e6 else ("MB", 1e6, 2)
        )
        shown, mean, least, most = (
            f"{value / divisor:.{digits}f} {unit}" for value in (rate, *sizes)
        )
        return (
            f"{shown}/s from {count} messages\n"
            f"\tMessage size mean: {mean} min: {least} max: {most}\n"
        )

    def summary(self, now_s: float) -> tuple[float, int, float, int, int]:
        """Bytes a second, how many messages count, mean, least and largest size.

        Raises:
            IndexError: There was no message yet.
        """
        sizes = [size for _, size in self._values]
        rate = sum(sizes) / max(now_s - self._values[0][0], 1e-9)
        return rate, len(sizes), statistics.fmean(sizes), min(sizes), max(sizes)
