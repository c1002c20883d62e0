"""The drawing since the last clear, for browsers that watch or connect later, and its colours.

A line has the colour of its turtle's shell until a pen is chosen. The picture that the colour
sensor reads keeps the original's pen.
"""

from __future__ import annotations

import math
import re
import struct
from collections import deque
from functools import lru_cache
from typing import NamedTuple

from turtlesim.model import DEFAULT_PEN, Pen, Stroke

#: One line on its way to the browser: colour and width as 0xRRGGBBWW, then x0, y0, x1, y1 in pixels
#: of the 500 x 500 image.
_RECORD = struct.Struct("<I4f")
RECORD_SIZE = _RECORD.size
#: Strokes kept one by one, for browsers that watch; a browser that falls further behind starts
#: again.
_RECENT = 20_000
#: Number of older lines, and of strokes of a crowd, that are kept. Further old ones are dropped:
#: browsers that connect later do not see them.
_OLDER = 200_000
#: Largest distance of a joined line from a point that the turtle visited [pixels].
_TOLERANCE = 0.05
#: The shells of ``page/js/looks.js``, lightened with the default pen.
_TINTS = (
    (0x72, 0xC3, 0xB0),
    (0xEC, 0xB2, 0x96),
    (0xE6, 0x9C, 0xC2),
    (0xB6, 0xA6, 0xFF),
    (0xEC, 0xD5, 0x99),
    (0x80, 0xD0, 0xE9),
    (0xD0, 0xA2, 0x95),
    (0xA4, 0xB2, 0xD6),
)
_NUMBER = re.compile(r"[0-9]+\Z")


class _Entry(NamedTuple):
    """Strokes drawn together.

    Attributes:
        end: How many strokes there have been up to the last of these.
        size: How many these are.
        records: Their records.
        origin: The one stroke and its turtle's name; None for a crowd's strokes, which are never
            joined.
    """

    end: int
    size: int
    records: bytes
    origin: tuple[str, Stroke] | None


class StrokeHistory:
    """Strokes in their order; the older ones are joined to longer lines that look the same.

    A reader keeps a position, -1 at first, and hands it to :meth:`since`. Not thread-safe.
    """

    def __init__(self) -> None:
        self._recent: deque[_Entry] = deque()
        self._held = 0
        self._next = 0
        self._cleared_at = 0
        self._older: deque[_Line] = deque(maxlen=_OLDER)
        self._open: dict[str, _Line] = {}

    def add(self, turtle: str, stroke: Stroke) -> None:
        """Append a stroke of the turtle of that name."""
        self._append(1, _record(stroke), (turtle, stroke))

    def add_records(self, records: bytes) -> None:
        """Append strokes of a crowd, as records."""
        if records:
            self._append(len(records) // RECORD_SIZE, records, None)

    def clear(self) -> None:
        """Forget everything; every reader starts again."""
        self._recent.clear()
        self._held = 0
        self._older.clear()
        self._open.clear()
        self._next += 1
        self._cleared_at = self._next

    def since(self, position: int) -> tuple[bool, bytes, int]:
        """Return the part that a reader has not received yet.

        Args:
            position: From the reader's last call, -1 for a new reader.

        Returns:
            Whether the reader must begin with an empty picture, the records (each of
            :data:`RECORD_SIZE` bytes), and the new position.
        """
        restart = position < max(self._next - self._held, self._cleared_at)
        records = []
        for entry in reversed(self._recent):
            if entry.end <= position and not restart:
                break
            records.append(entry.records)
        if restart:
            records += [line.record() for line in reversed(self._older)]
        return restart, b"".join(reversed(records)), self._next

    def _append(self, count: int, records: bytes, origin: tuple[str, Stroke] | None) -> None:
        self._next += count
        self._held += count
        self._recent.append(_Entry(self._next, count, records, origin))
        while self._recent and self._held > (_OLDER if self._recent[0].origin is None else _RECENT):
            entry = self._recent.popleft()
            self._held -= entry.size
            if entry.origin is not None:
                self._age(*entry.origin)

    def _age(self, turtle: str, stroke: Stroke) -> None:
        line = self._open.get(turtle)
        if line is None or not line.extend(stroke):
            self._open[turtle] = line = _Line(stroke)
            self._older.append(line)


class _Line:
    """A straight line that replaces strokes, each of which begins where the last one ended."""

    __slots__ = ("_direction", "_half_angle_left", "_half_angle_right", "_length", "_stroke")

    def __init__(self, stroke: Stroke) -> None:
        self._stroke = stroke
        self._length = math.hypot(stroke.x1 - stroke.x0, stroke.y1 - stroke.y0)
        self._direction = math.atan2(stroke.y1 - stroke.y0, stroke.x1 - stroke.x0)
        self._half_angle_left = self._half_angle_right = _half_angle(self._length)

    def extend(self, stroke: Stroke) -> bool:
        """Extend the line to the end of ``stroke``, if it stays within the tolerance of all points.

        Each point, seen from the beginning, leaves a wedge of directions that pass it closely
        enough; the end must be in all of them.
        """
        line = self._stroke
        if (stroke.x0, stroke.y0, stroke.pen) != (line.x1, line.y1, line.pen):
            return False
        dx, dy = stroke.x1 - line.x0, stroke.y1 - line.y0
        length = math.hypot(dx, dy)
        turn = math.remainder(math.atan2(dy, dx) - self._direction, math.tau)
        if length < self._length or not -self._half_angle_right <= turn <= self._half_angle_left:
            return False
        half_angle = _half_angle(length)
        self._half_angle_left = min(self._half_angle_left, turn + half_angle)
        self._half_angle_right = min(self._half_angle_right, half_angle - turn)
        self._length = length
        self._stroke = line._replace(x1=stroke.x1, y1=stroke.y1)
        return True

    def record(self) -> bytes:
        return _record(self._stroke)


def _half_angle(distance: float) -> float:
    return math.asin(_TOLERANCE / distance) if distance > _TOLERANCE else math.pi


def _record(stroke: Stroke) -> bytes:
    pen = stroke.pen
    return _RECORD.pack(
        pen.r << 24 | pen.g << 16 | pen.b << 8 | pen.width,
        stroke.x0,
        stroke.y0,
        stroke.x1,
        stroke.y1,
    )


def look_of(name: str) -> int:
    """Return a turtle's look, 0 to 7, as ``lookOf`` in ``page/js/looks.js`` does."""
    number = _NUMBER.search(name)
    if number and float(number[0]) > 0:
        return int((float(number[0]) - 1) % len(_TINTS))
    value = 0
    for letter in name:
        value = (31 * value + ord(letter)) & 0xFFFFFFFF
    return value % len(_TINTS)


def shown_pen(name: str, pen: Pen) -> Pen:
    """The pen that the page shows: the turtle's own, or its shell's until a pen is set."""
    return _tinted(name) if pen is DEFAULT_PEN else pen


@lru_cache(maxsize=4096)
def _tinted(name: str) -> Pen:
    return Pen(*_TINTS[look_of(name)], DEFAULT_PEN.width)
