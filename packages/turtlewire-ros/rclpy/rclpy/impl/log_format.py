"""The text of a log line, from a format with ``{tokens}`` as in RCUTILS_CONSOLE_OUTPUT_FORMAT."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from .logging_severity import LoggingSeverity

if TYPE_CHECKING:
    from .log_output import LogRecord

DEFAULT_FORMAT = "[{severity}] [{time}] [{name}]: {message}"

_SEVERITY_NAMES = {severity.value: severity.name for severity in LoggingSeverity}
_ESCAPES = {"\\a": "\a", "\\b": "\b", "\\n": "\n", "\\r": "\r", "\\t": "\t", "\\x1b": "\x1b"}


def _time(record: LogRecord) -> str:
    seconds, nanoseconds = divmod(record.stamp_ns, 1_000_000_000)
    return f"{seconds:010d}.{nanoseconds:09d}"


def _date_time_with_ms(record: LogRecord) -> str:
    import time

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
