"""The formulas of a tick and of a pen's line, for one turtle (floats) or many (arrays) alike.

Each formula exists once, so that :class:`turtlesim.model.Turtle` and
:class:`turtlesim.crowd.Crowd` agree to the last bit. Functions that Python and NumPy call
differently (``floor``, ``sqrt``) are arguments. The caller computes sine and cosine with
:mod:`math`, because NumPy's differ from the C library's in the last bit.

Positions are metres, headings radians; the vertical axis points down.

A pen's line is the rectangle around it, half the pen's width longer at both ends (Qt's square cap),
its corners rounded down to 1/64 pixel. Each of its edges falls on the nearest boundary between two
pixels, a tie on the higher one: a pixel is painted when its centre is inside, or on the lower or
right edge.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

#: A float, or an array of them.
_Number = TypeVar("_Number", float, "NDArray[np.float64]")
#: An int, or an array of whole numbers.
_Whole = TypeVar("_Whole", bound=Any)
#: A function of the numbers' type: Python's or NumPy's.
_Function = Callable[[Any], Any]

#: One tick, in nanoseconds and in seconds. Every tick integrates exactly this time, however long it
#: really took.
TICK_NS = 16_000_000
_TICK_S = 0.001 * 16
#: A velocity command is forgotten after this time.
COMMAND_LIFETIME_NS = 1_000_000_000
#: Width and height of the picture, in pixels, and its scale.
IMAGE_SIZE = 500
PIXELS_PER_METRE = 45.0
#: Corners of a pen's line lie on a grid of this many steps to the pixel.
_GRID = 64
#: The constant of the original, not math.pi: headings depend on it in their last bits.
_PI = 3.14159265
_TWO_PI = 2.0 * _PI

_FLOAT32 = struct.Struct("<f")


def float32(value: float) -> float:
    """Return the nearest single-precision number."""
    return float(_FLOAT32.unpack(_FLOAT32.pack(value))[0])


#: Side length of the field [m], in single precision: 11.088889.
FIELD_SIZE = float32((IMAGE_SIZE - 1) / PIXELS_PER_METRE)


def normalize_angle(angle: _Number, floor: _Function = math.floor) -> _Number:
    """``angle`` [rad, finite] brought into [-pi, pi)."""
    normal: _Number = angle - _TWO_PI * floor((angle + _PI) / _TWO_PI)
    return normal


def turn(theta: _Number, turning: _Number, floor: _Function = math.floor) -> _Number:
    """Return the heading after a tick with the turning rate ``turning`` [rad/s]."""
    return normalize_angle(theta + turning * _TICK_S, floor)


def move(
    x: _Number, y_down: _Number, cos: _Number, sin: _Number, forward: _Number, lateral: _Number
) -> tuple[_Number, _Number]:
    """The place after a tick with the heading of ``cos`` and ``sin`` and two speeds [m/s]."""
    return (
        x + (cos * forward * _TICK_S - sin * lateral * _TICK_S),
        y_down - (cos * lateral * _TICK_S + sin * forward * _TICK_S),
    )


def clamp(x: float, y_down: float) -> tuple[float, float]:
    """Return the place in the field that is nearest to (x, y_down)."""
    return min(max(x, 0.0), FIELD_SIZE), min(max(y_down, 0.0), FIELD_SIZE)


def pixel_of(x: float, y_down: float) -> tuple[int, int]:
    """Column and row of the pixel that the colour sensor sees at a place in the field."""
    return math.floor(x * PIXELS_PER_METRE + 0.5), math.floor(y_down * PIXELS_PER_METRE + 0.5)


def published(
    state: tuple[_Number, _Number, _Number, _Number, _Number, _Number],
    sqrt: _Function = math.sqrt,
) -> tuple[_Number, _Number, _Number, _Number, _Number]:
    """Return a turtle's published pose: x, y (up), heading, speed (never negative), turning rate.

    Args:
        state: x, y_down, heading, speed ahead, speed to the left, turning rate.
        sqrt: The square root for the numbers' type.
    """
    x, y_down, theta, forward, lateral, turning = state
    return x, FIELD_SIZE - y_down, theta, sqrt(forward * forward + lateral * lateral), turning


def length_of(
    x0: _Number, y0: _Number, x1: _Number, y1: _Number, sqrt: Callable[[_Number], _Number]
) -> _Number:
    """The length of a line. Not ``hypot``, whose last bits differ between Python and NumPy."""
    return sqrt((x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0))


def corners(
    line: tuple[_Number, _Number, _Number, _Number],
    along: tuple[_Number, _Number],
    floor: Callable[[_Number], _Number],
) -> list[tuple[_Number, _Number]]:
    """Return the four corners (x, y) of a pen line, in order around it [pixels].

    Args:
        line: x0, y0, x1, y1 [pixels].
        along: Half the pen's width in the direction of the line, as (x, y). A line of no length,
            which has no direction, gets the square dot of its pen with (half the width, 0).
        floor: For the numbers' type.
    """
    x0, y0, x1, y1 = line
    along_x, along_y = along
    exact = (
        (x0 - along_x - along_y, y0 - along_y + along_x),
        (x0 - along_x + along_y, y0 - along_y - along_x),
        (x1 + along_x + along_y, y1 + along_y - along_x),
        (x1 + along_x - along_y, y1 + along_y + along_x),
    )
    return [(floor(x * _GRID) / _GRID, floor(y * _GRID) / _GRID) for x, y in exact]


def boundary(edge: _Number, floor: Callable[[_Number], _Whole]) -> _Whole:
    """Return the number of the first pixel after an edge, which is the end of those before it."""
    return floor(edge + 0.5)


def crossing(y: _Number, x0: _Number, y0: _Number, x1: _Number, y1: _Number) -> _Number:
    """Return x where a line that is not level crosses the height y."""
    return x0 + (y - y0) * (x1 - x0) / (y1 - y0)
