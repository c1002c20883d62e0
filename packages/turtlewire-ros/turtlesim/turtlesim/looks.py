"""The colour in which the page draws a turtle's line until a pen is chosen: that of its shell.

The picture that the colour sensor reads keeps the original's pen.
"""

from __future__ import annotations

import re
from functools import lru_cache

from turtlesim.model import DEFAULT_PEN, Pen

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
