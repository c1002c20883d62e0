"""The logger that nodes hand out."""

from __future__ import annotations

import sys
import threading
import time
import warnings
from collections import OrderedDict
from types import FrameType
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

from turtlewire.distro import KILTED, LYRICAL, since

from . import log_levels, log_output
from .failed_lookups import FailedLookups, Shown
from .logging_severity import LoggingSeverity

if TYPE_CHECKING:
    from typing_extensions import Self

_DEBUG, _INFO, _WARN, _ERROR, _FATAL = 10, 20, 30, 40, 50
_DEPRECATED_WARN = "Deprecated in favor of :py:classmethod:RcutilsLogger.warning:."


class _Moment(NamedTuple):
    nanoseconds: int


class _SystemClock:
    """The system's clock, with as much of :class:`rclpy.clock.Clock` as a filter needs."""

    @staticmethod
    def now() -> _Moment:
        return _Moment(time.time_ns())


class LoggingFilter:
    """Decides which messages of a calling line are written.

    A program can add its own classes to :data:`supported_filters`.

    Attributes:
        params: The keywords that ask for it, with their defaults; None marks one that is required.
    """

    params: ClassVar[dict[str, Any]] = {}

    @classmethod
    def initialize_context(cls, context: dict[str, Any], **kwargs: Any) -> None:
        """Store the parameters in the state of a calling line.

        Args:
            context: What is kept of the line, to which a filter adds its state.
            **kwargs: The line's keywords.
        """
        for name, default in cls.params.items():
            context[name] = kwargs.get(name, default)

    @staticmethod
    def should_log(context: dict[str, Any]) -> bool:
        """Return True if the next message of the line is written; called once for each."""
        raise NotImplementedError


class Once(LoggingFilter):
    """Lets the first message through alone."""

    params: ClassVar[dict[str, Any]] = {"once": None}

    @classmethod
    def initialize_context(cls, context: dict[str, Any], **kwargs: Any) -> None:
        super().initialize_context(context, **kwargs)
        context["has_been_logged_once"] = False

    @staticmethod
    def should_log(context: dict[str, Any]) -> bool:
        logged, context["has_been_logged_once"] = context["has_been_logged_once"], True
        return not logged


class Throttle(LoggingFilter):
    """Lets a message through when enough time has passed since the last one."""

    params: ClassVar[dict[str, Any]] = {
        "throttle_duration_sec": None,
        "throttle_time_source_type": _SystemClock(),
    }

    @classmethod
    def initialize_context(cls, context: dict[str, Any], **kwargs: Any) -> None:
        """Initialize the context; raise ValueError if the clock is not a clock."""
        super().initialize_context(context, **kwargs)
        clock = context["throttle_time_source_type"]
        if not callable(getattr(clock, "now", None)):
            raise ValueError(  # noqa: TRY004 - ROS 2's
                f'Received throttle_time_source_type of "{clock}" is not a clock instance'
            )
        context["throttle_last_logged"] = None

    @staticmethod
    def should_log(context: dict[str, Any]) -> bool:
        now_ns = int(context["throttle_time_source_type"].now().nanoseconds)
        last_ns = context["throttle_last_logged"]
        period_ns = int(context["throttle_duration_sec"] * 1e9)
        # A clock that was set back (a simulation that starts again) must not silence the message
        # until it has caught up.
        if last_ns is not None and last_ns <= now_ns < last_ns + period_ns:
            return False
        context["throttle_last_logged"] = now_ns
        return True


class SkipFirst(LoggingFilter):
    """Lets all messages through but the first."""

    params: ClassVar[dict[str, Any]] = {"skip_first": None}

    @classmethod
    def initialize_context(cls, context: dict[str, Any], **kwargs: Any) -> None:
        super().initialize_context(context, **kwargs)
        context["first_has_been_skipped"] = False

    @staticmethod
    def should_log(context: dict[str, Any]) -> bool:
        skipped, context["first_has_been_skipped"] = context["first_has_been_skipped"], True
        return bool(skipped)


#: The filters are called in this order; a filter does not see messages that an earlier one drops.
supported_filters: OrderedDict[str, type[LoggingFilter]] = OrderedDict(
    throttle=Throttle, skip_first=SkipFirst, once=Once
)


def get_filters_from_kwargs(**kwargs: Any) -> list[str]:
    """Return the names of the filters that keyword arguments ask for.

    Raises:
        TypeError: An argument belongs to no filter, or one that its filter needs is missing.
    """
    detected = [
        name
        for name, each in supported_filters.items()
        if any(kwargs.get(param) for param in each.params)
    ]
    for name in detected:
        for param, default in supported_filters[name].params.items():
            if default is None and param not in kwargs:
                # ROS 2's text, with its doubled word.
                raise TypeError(
                    f'required parameter "{param}" not specified but is required for the the '
                    f'logging filter "{name}"'
                )
    known = [param for each in supported_filters.values() for param in each.params]
    for param in kwargs:
        if param not in known:
            raise TypeError(
                f'parameter "{param}" is not one of the recognized logging options "{known}"'
            )
    return detected


class _Place(NamedTuple):
    function_name: str
    file_path: str
    line_number: int
    last_index: int


class CallerId(_Place):
    """The place in a program that logs a message: the line, and the instruction in it.

    Args:
        frame: None uses the nearest frame of another file.
    """

    __slots__ = ()

    def __new__(cls, frame: FrameType | None = None) -> Self:
        """Create the context of a call site."""
        frame = _caller() if frame is None else frame
        code = frame.f_code
        return super().__new__(cls, code.co_name, code.co_filename, frame.f_lineno, frame.f_lasti)


class _CallSite:
    """The filters that one line of a program requests; they must not change between calls."""

    def __init__(self, severity: int, name: str, options: dict[str, Any]) -> None:
        self.severity = severity
        self.name = name
        self.options = options
        self.filter_names = get_filters_from_kwargs(**options)
        self._filters = [supported_filters[each] for each in self.filter_names]
        self._context: dict[str, Any] = {"name": name, "severity": severity}
        for each in self._filters:
            each.initialize_context(self._context, **options)
        self._failed_lookups = FailedLookups()
        self._lock = threading.Lock()

    def check(self, severity: int, name: str, options: dict[str, Any]) -> None:
        if severity != self.severity:
            raise ValueError("Logger severity cannot be changed between calls.")
        if name != self.name:
            raise ValueError("Logger name cannot be changed between calls.")
        if options == self.options:
            return
        if get_filters_from_kwargs(**options) != self.filter_names:
            raise ValueError("Requested logging filters cannot be changed between calls.")
        if self.filter_names:
            raise ValueError("Logging filter parameters cannot be changed between calls.")

    def lets_through(self) -> bool:
        if not self._filters:
            return True
        with self._lock:
            return all(each.should_log(self._context) for each in self._filters)

    def shown(self, message: str) -> Shown:
        with self._lock:
            return self._failed_lookups.shown(message)


class RcutilsLogger:
    """Writes messages of one name. Thread-safe.

    Every method that logs takes these keywords, which belong to the calling line and must not
    change from call to call:

    * ``throttle_duration_sec``, ``throttle_time_source_type`` (a clock): at most one message in
      that time,
    * ``skip_first``: not the first message,
    * ``once``: only the first message,

    and returns whether the message was written. A message that is not a ``str`` is converted,
    unless the level is off.
    """

    def __init__(self, name: str = "", namespace: str = "") -> None:
        self.name = f"{namespace}.{name}" if namespace else name
        self._call_sites: dict[CallerId, _CallSite] = {}

    def get_child(self, name: str) -> RcutilsLogger:
        """Return the logger ``<this name>.<name>``, which inherits the level.

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
        """Return the level that decides about messages: its own or inherited."""
        return LoggingSeverity(log_levels.effective(self.name))

    def is_enabled_for(self, severity: LoggingSeverity | int) -> bool:
        """Return True if a message of ``severity`` would be written."""
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

    # Lyrical no longer has it.
    if not since(LYRICAL):

        def warn(self, message: Any, **kwargs: Any) -> bool:
            """Log with severity WARN; deprecated since Kilted."""
            if since(KILTED):
                warnings.warn(_DEPRECATED_WARN, DeprecationWarning, stacklevel=2)
            return log_levels.effective(self.name) <= _WARN and self._log(message, _WARN, kwargs)

    def error(self, message: Any, **kwargs: Any) -> bool:
        """Log with severity ERROR."""
        return log_levels.effective(self.name) <= _ERROR and self._log(message, _ERROR, kwargs)

    def fatal(self, message: Any, **kwargs: Any) -> bool:
        """Log with severity FATAL."""
        return log_levels.effective(self.name) <= _FATAL and self._log(message, _FATAL, kwargs)

    def _log(self, message: Any, severity: int, options: dict[str, Any]) -> bool:
        name = options.pop("name", None) or self.name
        caller = CallerId()
        site = self._call_sites.get(caller)
        if site is None:
            # Another thread may have added the line since the check.
            site = self._call_sites.setdefault(caller, _CallSite(severity, name, options))
        else:
            site.check(severity, name, options)
        if not site.lets_through():
            return False
        record = log_output.LogRecord(
            time.time_ns(),
            severity,
            name,
            _encodable(str(message)),
            _encodable(caller.file_path),
            caller.function_name,
            caller.line_number,
        )
        log_output.emit(record, site.shown(record.message))
        return True


def _encodable(text: str) -> str:
    """Escape lone surrogates, so that every output accepts the text."""
    # They represent undecodable bytes, for example of a file name.
    return text if text.isascii() else text.encode(errors="backslashreplace").decode()


def _caller() -> FrameType:
    """Return the frame of the program's line that logs."""
    frame = sys._getframe(1)
    while frame.f_code.co_filename == __file__ and frame.f_back is not None:
        frame = frame.f_back
    return frame
