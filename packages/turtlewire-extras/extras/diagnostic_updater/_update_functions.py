"""Tasks that watch the frequency of events and the stamps of messages."""

from __future__ import annotations

import math
import threading
from collections import deque
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from diagnostic_msgs.msg import DiagnosticStatus
from diagnostic_updater._updater import DiagnosticTask
from rclpy.clock import Clock
from rclpy.time import Time

if TYPE_CHECKING:
    from diagnostic_updater._updater import DiagnosticStatusWrapper

__all__ = [
    "FrequencyStatus",
    "FrequencyStatusParam",
    "Heartbeat",
    "TimeStampStatus",
    "TimeStampStatusParam",
]

_OK, _WARN, _ERROR = DiagnosticStatus.OK, DiagnosticStatus.WARN, DiagnosticStatus.ERROR


@dataclass
class FrequencyStatusParam:
    """The expected frequency.

    Attributes:
        freq_bound: ``{"min": …, "max": …}`` in Hz. The task reads it at each run, so that a program
            may change it.
        tolerance: How much more or less is accepted: 0.1 is 10 %.
        window_size: The number of runs of the task over which the frequency is measured.
    """

    freq_bound: dict[str, float]
    tolerance: float = 0.1
    window_size: int = 5


class FrequencyStatus(DiagnosticTask):
    """Watches how often :meth:`tick` is called.

    Args:
        params: The expectations.
        name: Name of the task.
        clock: The clock that measures; by default that of the system.
    """

    def __init__(
        self,
        params: FrequencyStatusParam,
        name: str = "FrequencyStatus",
        clock: Clock | None = None,
    ) -> None:
        super().__init__(name)
        self.params = params
        self._clock = Clock() if clock is None else clock
        self._lock = threading.Lock()
        self.clear()

    def clear(self) -> None:
        """Forget all events."""
        with self._lock:
            self.count = 0
            #: Times in seconds and counts at the last runs.
            self._window = deque([(self._now(), 0)] * self.params.window_size)

    def tick(self) -> None:
        """Count an event."""
        with self._lock:
            self.count += 1

    def _now(self) -> float:
        return float(self._clock.now().nanoseconds) * 1e-9

    def run(self, stat: DiagnosticStatusWrapper) -> DiagnosticStatusWrapper:
        """Compare the frequency since the oldest run of the window."""
        with self._lock:
            now, total = self._now(), self.count
            since, count = self._window.popleft()
            self._window.append((now, total))
        events, seconds = total - count, now - since
        frequency = events / seconds if seconds > 0 else 0.0
        bound, tolerance = self.params.freq_bound, self.params.tolerance
        least, most = bound["min"] * (1 - tolerance), bound["max"] * (1 + tolerance)
        if events == 0:
            stat.summary(_ERROR, "No events recorded.")
        elif frequency < least:
            stat.summary(_WARN, "Frequency too low.")
        elif frequency > most:
            stat.summary(_WARN, "Frequency too high.")
        else:
            stat.summary(_OK, "Desired frequency met")
        stat.add("Events in window", f"{events:d}")
        stat.add("Events since startup", f"{total:d}")
        stat.add("Duration of window (s)", f"{seconds:f}")
        stat.add("Actual frequency (Hz)", f"{frequency:f}")
        if bound["min"] == bound["max"]:
            stat.add("Target frequency (Hz)", f"{bound['min']:f}")
        if bound["min"] > 0:
            stat.add("Minimum acceptable frequency (Hz)", f"{least:f}")
        if math.isfinite(bound["max"]):
            stat.add("Maximum acceptable frequency (Hz)", f"{most:f}")
        return stat


@dataclass
class TimeStampStatusParam:
    """Limits for the age of stamps, in seconds; stamps in the future have negative ages."""

    min_acceptable: float = -1
    max_acceptable: float = 5


class TimeStampStatus(DiagnosticTask):
    """Watches the stamps that :meth:`tick` gets.

    Args:
        params: The expectations.
        name: Name of the task.
        clock: The clock to compare with; by default that of the system.
    """

    def __init__(
        self,
        params: TimeStampStatusParam | None = None,
        name: str = "Timestamp Status",
        clock: Clock | None = None,
    ) -> None:
        super().__init__(name)
        self.params = TimeStampStatusParam() if params is None else params
        self._clock = Clock() if clock is None else clock
        self._lock = threading.Lock()
        self._ages: tuple[float, float] | None = None
        self._zero_seen = False
        self._early = self._late = self._zero = 0

    def tick(self, stamp: Any) -> None:
        """Look at a stamp: seconds, a ``Time`` of rclpy, or one of a message."""
        if hasattr(stamp, "nanosec"):
            stamp = Time.from_msg(stamp)
        seconds = stamp.nanoseconds * 1e-9 if hasattr(stamp, "nanoseconds") else float(stamp)
        age = self._clock.now().nanoseconds * 1e-9 - seconds
        with self._lock:
            if seconds == 0:
                self._zero_seen = True
                return
            least, most = self._ages or (age, age)
            self._ages = (min(least, age), max(most, age))

    def run(self, stat: DiagnosticStatusWrapper) -> DiagnosticStatusWrapper:
        """Compare the ages of the stamps since the last run."""
        with self._lock:
            ages, zero_seen = self._ages, self._zero_seen
            self._ages, self._zero_seen = None, False
        least, most = ages or (0.0, 0.0)
        stat.summary(_OK, "Timestamps are reasonable.")
        if ages is None and not zero_seen:
            stat.summary(_WARN, "No data since last update.")
        if least < self.params.min_acceptable:
            stat.summary(_ERROR, "Timestamps too far in future seen.")
            self._early += 1
        if most > self.params.max_acceptable:
            stat.summary(_ERROR, "Timestamps too far in past seen.")
            self._late += 1
        if zero_seen:
            stat.summary(_ERROR, "Zero timestamp seen.")
            self._zero += 1
        stat.add("Earliest timestamp delay:", f"{least:f}")
        stat.add("Latest timestamp delay:", f"{most:f}")
        stat.add("Earliest acceptable timestamp delay:", f"{self.params.min_acceptable:f}")
        stat.add("Latest acceptable timestamp delay:", f"{self.params.max_acceptable:f}")
        stat.add("Late diagnostic update count:", f"{self._late}")
        stat.add("Early diagnostic update count:", f"{self._early}")
        stat.add("Zero seen diagnostic update count:", f"{self._zero}")
        return stat


class Heartbeat(DiagnosticTask):
    """Says that the node is alive."""

    def __init__(self) -> None:
        super().__init__("Heartbeat")

    def run(self, stat: DiagnosticStatusWrapper) -> DiagnosticStatusWrapper:
        stat.summary(_OK, "Alive")
        return stat
