"""The logger that nodes hand out."""

from __future__ import annotations

import sys
import threading
import time
from typing import TYPE_CHECKING, Any

from . import log_levels, log_output
from .logging_severity import LoggingSeverity

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import FrameType

__all__ = ["RcutilsLogger"]

_DEBUG, _INFO, _WARN, _ERROR, _FATAL = 10, 20, 30, 40, 50

#: The filters in the order in which they are asked, with their parameters; None marks one that has
#: no default.
_FILTERS: dict[str, dict[str, Any]] = {
    "throttle": {"throttle_duration_sec": None, "throttle_time_source_type": "the system's clock"},
    "skip_first": {"skip_first": None},
    "once": {"once": None},
}
_OPTIONS = [option for options in _FILTERS.values() for option in options]


class _Throttle:
    """Lets a message through when enough time has passed since the last one."""

    def __init__(self, options: dict[str, Any]) -> None:
        clock = options.get("throttle_time_source_type")
        if clock is not None and not callable(getattr(clock, "now", None)):
            raise ValueError(
                f'Received throttle_time_source_type of "{clock}" is not a clock instance.'
            )
        self._now_ns: Callable[[], int] = (
            time.time_ns if clock is None else lambda: int(clock.now().nanoseconds)
        )
        self._period_ns = int(options["throttle_duration_sec"] * 1e9)
        self._next_ns = 0

    def lets_through(self) -> bool:
        now_ns = self._now_ns()
        # A clock that was set back (a simulation that starts again) must not silence the message
        # until it has caught up.
        if self._next_ns - self._period_ns <= now_ns < self._next_ns:
            return False
        self._next_ns = now_ns + self._period_ns
        return True


class _SkipFirst:
    """Lets all messages through but the first."""

    def __init__(self, _options: dict[str, Any]) -> None:
        self._skipped = False

    def lets_through(self) -> bool:
        skipped, self._skipped = self._skipped, True
        return skipped


class _Once:
    """Lets the first message through alone."""

    def __init__(self, _options: dict[str, Any]) -> None:
        self._logged = False

    def lets_through(self) -> bool:
        logged, self._logged = self._logged, True
        return not logged


_FILTER_CLASSES: dict[str, type[_Throttle | _SkipFirst | _Once]] = {
    "throttle": _Throttle,
    "skip_first": _SkipFirst,
    "once": _Once,
}


class _CallSite:
    """What one line of a program asks for; it has to stay the same from call to call."""

    def __init__(self, severity: int, name: str, options: dict[str, Any]) -> None:
        self.severity = severity
        self.name = name
        self.options = options
        self.filter_names = _requested_filters(options)
        self._filters = [_FILTER_CLASSES[name](options) for name in self.filter_names]
        self._lock = threading.Lock()

    def check(self, severity: int, name: str, options: dict[str, Any]) -> None:
        if severity != self.severity:
            raise ValueError("Logger severity cannot be changed between calls.")
        if name != self.name:
            raise ValueError("Logger name cannot be changed between calls.")
        if options == self.options:
            return
        if _requested_filters(options) != self.filter_names:
            raise ValueError("Requested logging filters cannot be changed between calls.")
        if self.filter_names:
            raise ValueError("Logging filter parameters cannot be changed between calls.")

    def lets_through(self) -> bool:
        if not self._filters:
            return True
        with self._lock:
            return all(each.lets_through() for each in self._filters)


def _requested_filters(options: dict[str, Any]) -> list[str]:
    """The names of the filters that keyword arguments ask for.

    Raises:
        TypeError: An argument belongs to no filter, or one that its filter needs is missing.
    """
    requested = [
        name
        for name, defaults in _FILTERS.items()
        if any(options.get(option) for option in defaults)
    ]
    for name in requested:
        for option, default in _FILTERS[name].items():
            if default is None and option not in options:
                raise TypeError(
                    f'required parameter "{option}" not specified but is required for the the '
                    f'logging filter "{name}"'
                )
    for option in options:
        if option not in _OPTIONS:
            raise TypeError(
                f'parameter "{option}" is not one of the recognized logging options "{_OPTIONS}"'
            )
    return requested


class RcutilsLogger:
    """Writes messages of one name. Thread-safe.

    Every method that logs takes these keywords, which belong to the calling line and must not
    change from call to call:

    * ``throttle_duration_sec``, ``throttle_time_source_type`` (a clock): at most one message in
      that time,
    * ``skip_first``: not the first message,
    * ``once``: only the first message,

    and returns whether the message was written. A message that is no ``str`` is converted, unless
    the level is off.
    """

    def __init__(self, name: str = "", namespace: str = "") -> None:
        self.name = f"{namespace}.{name}" if namespace else name
        self._call_sites: dict[tuple[str, str, int, int], _CallSite] = {}

    def get_child(self, name: str) -> RcutilsLogger:
        """The logger ``<this name>.<name>``, which inherits the level.

        Raises:
            ValueError: The name is empty.
        """
        if not name:
            raise ValueError("Child logger name must not be empty.")
        return RcutilsLogger(name=name, namespace=self.name)

    def set_level(self, level: LoggingSeverity | int) -> None:
        """Write messages of this severity and above; UNSET inherits from the parent."""
        log_levels.set_level(self.name, LoggingSeverity(level))

    def get_effective_level(self) -> LoggingSeverity:
        """The level that decides about messages: its own or inherited."""
        return LoggingSeverity(log_levels.effective(self.name))

    def is_enabled_for(self, severity: LoggingSeverity | int) -> bool:
        """Whether a message of ``severity`` would be written."""
        return LoggingSeverity(severity) >= log_levels.effective(self.name)

    def log(self, message: Any, severity: LoggingSeverity | int, **kwargs: Any) -> bool:
        """Log with any severity; the other methods fix it.

        Raises:
            TypeError: An unknown keyword.
            ValueError: This line logged before with another severity, name or filter.
        """
        severity = LoggingSeverity(severity)
        return severity >= log_levels.effective(self.name) and self._log(message, severity, kwargs)

    def debug(self, message: Any, **kwargs: Any) -> bool:
        """Log with severity DEBUG."""
        return log_levels.effective(self.name) <= _DEBUG and self._log(message, _DEBUG, kwargs)

    def info(self, message: Any, **kwargs: Any) -> bool:
        """Log with severity INFO."""
        return log_levels.effective(self.name) <= _INFO and self._log(message, _INFO, kwargs)

    def warning(self, message: Any, **kwargs: Any) -> bool:
        """Log with severity WARN."""
        return log_levels.effective(self.name) <= _WARN and self._log(message, _WARN, kwargs)

    def warn(self, message: Any, **kwargs: Any) -> bool:
        """Log with severity WARN."""
        return log_levels.effective(self.name) <= _WARN and self._log(message, _WARN, kwargs)

    def error(self, message: Any, **kwargs: Any) -> bool:
        """Log with severity ERROR."""
        return log_levels.effective(self.name) <= _ERROR and self._log(message, _ERROR, kwargs)

    def fatal(self, message: Any, **kwargs: Any) -> bool:
        """Log with severity FATAL."""
        return log_levels.effective(self.name) <= _FATAL and self._log(message, _FATAL, kwargs)

    def _log(self, message: Any, severity: int, options: dict[str, Any]) -> bool:
        name = options.pop("name", self.name)
        frame = _caller()
        code, line = frame.f_code, frame.f_lineno
        key = (code.co_filename, code.co_name, line, frame.f_lasti)
        site = self._call_sites.get(key)
        if site is None:
            site = self._call_sites.setdefault(key, _CallSite(severity, name, options))
        else:
            site.check(severity, name, options)
        if not site.lets_through():
            return False
        text, file_name = _encodable(str(message)), _encodable(code.co_filename)
        record = log_output.LogRecord(
            time.time_ns(), severity, name, text, file_name, code.co_name, line
        )
        log_output.emit(record)
        return True


def _encodable(text: str) -> str:
    """``text`` with lone surrogates escaped, so that every output can take it.

    They stand for undecodable bytes, of a file name for example.
    """
    return text if text.isascii() else text.encode(errors="backslashreplace").decode()


def _caller() -> FrameType:
    """The frame of the program's line that logs."""
    frame = sys._getframe(1)
    while frame.f_code.co_filename == __file__ and frame.f_back is not None:
        frame = frame.f_back
    return frame
