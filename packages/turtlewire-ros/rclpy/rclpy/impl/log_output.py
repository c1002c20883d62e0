"""The outputs of log records, and the format of their lines.

The outputs are the console, a file, and ``/rosout`` through the sink of the node that owns the
logger. The format has ``{tokens}``, as in RCUTILS_CONSOLE_OUTPUT_FORMAT.

Thread-safe: a record is one write to each place, so lines of several threads and processes do not
mix.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable
from typing import NamedTuple

from . import log_levels
from .failed_lookups import WHOLE, Shown
from .logging_severity import LoggingSeverity

_COLOURS = {10: "\033[32m", 20: "\033[0m", 30: "\033[33m", 40: "\033[31m", 50: "\033[31m"}
_RESET = "\033[0m"
_STDOUT_FD, _STDERR_FD = 1, 2

DEFAULT_FORMAT = "[{severity}] [{time}] [{name}]: {message}"

_SEVERITY_NAMES = {severity.value: severity.name for severity in LoggingSeverity}
_ESCAPES = {"\\a": "\a", "\\b": "\b", "\\n": "\n", "\\r": "\r", "\\t": "\t", "\\x1b": "\x1b"}


class LogRecord(NamedTuple):
    """One message.

    Attributes:
        stamp_ns: System time in nanoseconds.
        severity: A number of :class:`LoggingSeverity`.
        name: The logger's full name, for example ``turtle1.broadcaster``.
        message: The text.
        file_name: Source file of the caller.
        function_name: Function of the caller.
        line_number: Line of the caller.
    """

    stamp_ns: int
    severity: int
    name: str
    message: str
    file_name: str
    function_name: str
    line_number: int


def _time(record: LogRecord) -> str:
    seconds, nanoseconds = divmod(record.stamp_ns, 1_000_000_000)
    return f"{seconds:010d}.{nanoseconds:09d}"


def _date_time_with_ms(record: LogRecord) -> str:
    seconds, nanoseconds = divmod(record.stamp_ns, 1_000_000_000)
    date_time = time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(seconds))
    return f"{date_time}.{nanoseconds // 1_000_000:03d}"


_TOKENS: dict[str, Callable[[LogRecord], str]] = {
    "severity": lambda record: _SEVERITY_NAMES[record.severity],
    "name": lambda record: record.name,
    "message": lambda record: record.message,
    "function_name": lambda record: record.function_name,
    "file_name": lambda record: record.file_name,
    "line_number": lambda record: str(record.line_number),
    "time": _time,
    "date_time_with_ms": _date_time_with_ms,
    "time_as_nanoseconds": lambda record: f"{record.stamp_ns:019d}",
}


class LineFormat:
    """Turns records into lines; unknown tokens and single braces stay as they are.

    Args:
        text: The format; ROS 2's default if None.
    """

    def __init__(self, text: str | None = None) -> None:
        self._is_default = text is None
        self._parts = _compile(DEFAULT_FORMAT if text is None else text)

    def line(self, record: LogRecord) -> str:
        """Return the text of ``record``, without a newline at its end."""
        # Without a loop over parts, because nearly every program logs in this format.
        if self._is_default:
            return (
                f"[{_SEVERITY_NAMES[record.severity]}] [{_time(record)}] [{record.name}]: "
                f"{record.message}"
            )
        return "".join(part if isinstance(part, str) else part(record) for part in self._parts)


def _compile(text: str) -> list[str | Callable[[LogRecord], str]]:
    for escape, character in _ESCAPES.items():
        text = text.replace(escape, character)
    parts: list[str | Callable[[LogRecord], str]] = []
    while text:
        literal, brace, rest = text.partition("{")
        parts.append(literal)
        token, closing, after = rest.partition("}")
        if closing and token in _TOKENS:
            parts.append(_TOKENS[token])
            text = after
        else:
            parts.append(brace)
            text = rest
    return parts


class _Console:
    """The standard error or output stream, as the environment asks."""

    def __init__(self) -> None:
        self.enabled = True
        self.format = LineFormat(os.environ.get("RCUTILS_CONSOLE_OUTPUT_FORMAT") or None)
        self._fd = _STDOUT_FD if _flag("RCUTILS_LOGGING_USE_STDOUT") else _STDERR_FD
        # Each line is one write anyway, but an invalid value is still reported.
        _flag("RCUTILS_LOGGING_BUFFERED_STREAM")
        coloured = _flag("RCUTILS_COLORIZED_OUTPUT")
        self._coloured = (
            os.isatty(self._fd) and not os.environ.get("NO_COLOR") if coloured is None else coloured
        )

    def write(self, line: str, severity: int) -> None:
        if self._coloured:
            line = f"{_COLOURS.get(severity, _RESET)}{line}{_RESET}"
        # A closed stream cannot show the error, and must not end the program.
        _write_line(self._fd, line)


class _OpenFile:
    """A file descriptor, which is closed when no thread writes to it any more.

    Another thread may use the number of a descriptor that is closed for its own file.
    """

    def __init__(self, fd: int) -> None:
        self.fd = fd

    def __del__(self) -> None:
        os.close(self.fd)


class _File:
    """The log file.

    It is opened for the first record, so that programs that log nothing leave nothing.
    """

    def __init__(self, prefix: str | None) -> None:
        self._prefix = prefix
        self._begin_ms = time.time_ns() // 1_000_000
        self._opened: _OpenFile | None = None
        self._may_open = True
        self._failed = False

    def write(self, line: str) -> None:
        if self._opened is None and self._may_open:
            self._open()
        opened = self._opened  # another thread may close the log file
        if opened is not None and not _write_line(opened.fd, line) and not self._failed:
            # Reported once, because on a full disk every line fails.
            self._failed = True
            _write_line(_STDERR_FD, "Lines are missing in the log file: the disk may be full.")

    def _open(self) -> None:
        name = self._prefix or os.path.basename(sys.argv[0] if sys.argv else "") or "python3"
        try:
            os.makedirs(directory(), exist_ok=True)
            # Two threads that log the first record at once open the same file.
            path = f"{directory()}/{name}_{os.getpid()}_{self._begin_ms}.log"
            flags = os.O_WRONLY | os.O_CREAT | os.O_APPEND | getattr(os, "O_CLOEXEC", 0)
            self._opened = _OpenFile(os.open(path, flags, 0o644))
        except OSError as error:
            self._may_open = False
            _write_line(
                _STDERR_FD,
                f"No log file is written: {error}. Set ROS_LOG_DIR to a directory that can be "
                "written.",
            )

    def close(self) -> None:
        self._may_open = False
        self._opened = None


_console: _Console | None = None
_file: _File | None = None
_rosout_enabled = True
_rosout_sinks: dict[str, Callable[[LogRecord], None]] = {}


def emit(record: LogRecord, shown: Shown = WHOLE) -> None:
    """Write one record everywhere, whatever its level.

    Args:
        record: The record.
        shown: What the console shows of it.
    """
    global _console  # noqa: PLW0603 - the console belongs to the process
    if _console is None:
        _console = _Console()
    line = _console.format.line(record)
    if _console.enabled and shown.line:
        text = f"{line}\n    {shown.help}" if shown.help else line
        _console.write(text, record.severity)
    file = _file  # another thread may call `shutdown`
    if file is not None:
        file.write(line)
    if _rosout_enabled and _rosout_sinks:
        sink = _sink_of(record.name)
        if sink is not None:
            sink(record)


def configure(
    *,
    levels: dict[str, int] | None = None,
    console: bool = True,
    rosout: bool = True,
    file: bool = True,
    file_prefix: str | None = None,
) -> None:
    """Apply what the command line says, and read the environment again.

    A context calls it when it starts.

    Args:
        levels: Logger name to severity; the empty name sets the default of all loggers. Other
            levels stay.
        console: Whether to write to the console.
        rosout: Whether to publish to ``/rosout``.
        file: Whether to write a log file.
        file_prefix: First part of the file's name; the program's name if None.
    """
    global _console, _file, _rosout_enabled  # noqa: PLW0603 - as above
    shutdown()
    for name, level in (levels or {}).items():
        log_levels.set_level(name, level)
    _console = _Console()
    _console.enabled = console
    _rosout_enabled = rosout
    _file = _File(file_prefix) if file else None


def shutdown() -> None:
    """Close the log file. Records go to the console after this."""
    global _file  # noqa: PLW0603 - as above
    if _file is not None:
        _file.close()
    _file = None


def add_rosout_sink(name: str, sink: Callable[[LogRecord], None]) -> None:
    """Hand the records of a logger and its children to ``sink``, on the thread that logs."""
    if name in _rosout_sinks:
        text = (
            f"Publisher already registered for node name: '{name}'. If this is due to multiple "
            "nodes with the same name then all logs for "
            f"the logger named '{name}' will go out over the existing publisher. As soon as any "
            "node with that name is destructed it will "
            "unregister the publisher, preventing any further logs for that name from being "
            "published on the rosout topic."
        )
        emit(
            LogRecord(
                time.time_ns(),
                LoggingSeverity.WARN,
                "rcl.logging_rosout",
                text,
                __file__,
                "add_rosout_sink",
                0,
            )
        )
        return
    _rosout_sinks[name] = sink


def remove_rosout_sink(name: str, sink: Callable[[LogRecord], None]) -> None:
    """Undo :func:`add_rosout_sink`; another sink of the same logger stays. Idempotent."""
    if _rosout_sinks.get(name) == sink:
        _rosout_sinks.pop(name, None)


def directory() -> str:
    """Return the directory of log files; see :func:`rclpy.logging.get_logging_directory`."""
    path = os.environ.get("ROS_LOG_DIR") or f"{os.environ.get('ROS_HOME') or '~/.ros'}/log"
    return os.path.expanduser(path)


def _sink_of(name: str) -> Callable[[LogRecord], None] | None:
    while name:
        sink = _rosout_sinks.get(name)
        if sink is not None:
            return sink
        name = name.rpartition(".")[0]
    return None


def _flag(variable: str) -> bool | None:
    """Return a variable that is 0, 1 or unset (None)."""
    value = os.environ.get(variable, "")
    if value not in {"", "0", "1"}:
        _write_line(
            _STDERR_FD,
            f"{variable} has the value '{value}', which is neither 0 nor 1: it is ignored.",
        )
    return {"0": False, "1": True}.get(value)


def _write_line(fd: int, line: str) -> bool:
    """Write a line; False if it could not be written."""
    # Messages may contain surrogates, for example from file names; logging must not raise.
    data = f"{line}\n".encode(errors="backslashreplace")
    try:
        while data:
            # A write to a full pipe or disk may be partial.
            data = data[os.write(fd, data) :]
    except OSError:
        return False
    return True
