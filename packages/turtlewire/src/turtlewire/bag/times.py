"""Times of a bag as text: dates, nanoseconds, and offsets from the bag's beginning."""

from __future__ import annotations

import operator
import re
from datetime import datetime
from typing import TYPE_CHECKING

from turtlewire.errors import BagError
from turtlewire.tf.datetimes import as_nanoseconds

if TYPE_CHECKING:
    from turtlewire.tf.datetimes import Span, Stamp

__all__ = ["date_text", "duration_ns", "moment_ns", "size_bytes", "size_text"]

_SECOND = 1_000_000_000
_BINARY_UNITS = ("B", "KiB", "MiB", "GiB", "TiB")
_UNITS = {
    "h": 3600 * _SECOND,
    "m": 60 * _SECOND,
    "s": _SECOND,
    "ms": 1_000_000,
    "us": 1000,
    "ns": 1,
}
_PART = r"(\d+)(?:\.(\d{1,9}))?(ms|us|ns|h|m|s)"
_DURATION = re.compile(rf"(?:{_PART})+")
_DATE = re.compile(
    r"(\d{4}-\d\d-\d\d)(?:[T ](\d\d:\d\d(?::\d\d)?)(?:\.(\d{1,9}))?)?(Z|[+-]\d\d:?\d\d)?"
)
#: Fewer digits are more likely to be meant as seconds than as nanoseconds since 1970.
_LEAST_DIGITS = 10
_SIZE = re.compile(r"(\d{1,15}(?:\.\d{1,15})?) ?(B|[kKMGT]i?B?)?")
_FORMS = "write an offset like 10s or 1m20s, a date like 2024-05-01T12:00:00Z, or nanoseconds"


def moment_ns(time: Stamp | str, start_ns: int, argument: str = "time") -> int:
    """Return a time in nanoseconds since 1970.

    Args:
        time: Nanoseconds or a ``datetime64``; or a text: an offset from the start such as
            ``"1m20s"``, a date such as ``"2024-05-01T12:00:00.5Z"`` (local time without a zone), or
            nanoseconds.
        start_ns: The beginning of the bag.
        argument: The name of the argument, for the text of an error.

    Raises:
        BagError: The text is not a time.
        TypeError: ``time`` has another type.
    """
    if not isinstance(time, str):
        return as_nanoseconds(time, argument)
    text = time.strip()
    if text.isascii() and text.isdigit():
        if len(text) >= _LEAST_DIGITS:
            return int(text)
        raise BagError(f"'{time}' has no unit: write {text}s for seconds from the start")
    if _DURATION.fullmatch(text):
        return start_ns + duration_ns(text)
    found = _DATE.fullmatch(text)
    if found is None:
        raise BagError(f"'{time}' is not a time: {_FORMS}")
    day, clock, fraction, zone = found.groups()
    zone = {None: "", "Z": "+00:00"}.get(zone, zone)
    if len(zone) == 5:  # fromisoformat of Python 3.10 needs the colon
        zone = f"{zone[:3]}:{zone[3:]}"
    try:
        date = datetime.fromisoformat(f"{day}T{clock or '00:00'}{zone}").astimezone()
        seconds = round(date.timestamp())
    except (ValueError, OverflowError, OSError) as error:
        raise BagError(f"'{time}' is not a time: {error}") from None
    return seconds * _SECOND + int((fraction or "0").ljust(9, "0"))


def duration_ns(span: Span | str) -> int:
    """Return a length of time in nanoseconds.

    Args:
        span: Nanoseconds, or a text such as ``"60s"``, ``"1.5h"`` or ``"1m20s"``.

    Raises:
        BagError: The text is not a length of time.
    """
    if not isinstance(span, str):
        return as_nanoseconds(span, "interval_ns")
    if not _DURATION.fullmatch(span):
        raise BagError(f"'{span}' is not a length of time: write one like 60s, 1m20s or 1.5h")
    total = 0
    for whole, fraction, unit in re.findall(_PART, span):
        billionths = int((fraction or "0").ljust(9, "0"))
        total += int(whole) * _UNITS[unit] + billionths * _UNITS[unit] // _SECOND
    return total


def size_bytes(size: int | str) -> int:
    """Return a size in bytes.

    Args:
        size: Bytes, or a text such as ``"1GB"``, ``"512MiB"`` or ``"100k"``.

    Raises:
        BagError: The text is not a size.
        TypeError: ``size`` is neither an integer nor a text.
    """
    if not isinstance(size, str):
        return operator.index(size)
    found = _SIZE.fullmatch(size)
    if found is None:
        raise BagError(f"'{size}' is not a size: write one like 500MB, 1GB or 512MiB")
    unit = found[2] or "B"
    base = 1024 if "i" in unit else 1000
    return int(float(found[1]) * base ** "BKMGT".index(unit[0].upper()))


def size_text(count: int) -> str:
    """Format a number of bytes as ROS 2 does, for example ``12.3 MiB``."""
    size, unit = float(count), 0
    while size >= 1024 and unit < len(_BINARY_UNITS) - 1:
        size /= 1024
        unit += 1
    return f"{size:.1f} {_BINARY_UNITS[unit]}" if unit else f"{count} B"


def date_text(time_ns: int) -> str:
    """Return a time as a local date with its zone, which `moment_ns` takes."""
    seconds, nanoseconds = divmod(time_ns, _SECOND)
    try:
        date = datetime.fromtimestamp(seconds).astimezone()
    except (ValueError, OverflowError, OSError):  # a damaged bag may have any time
        return str(time_ns)
    zone = date.strftime("%z")
    return f"{date:%Y-%m-%dT%H:%M:%S}.{nanoseconds:09d}{zone[:3]}:{zone[3:]}"
