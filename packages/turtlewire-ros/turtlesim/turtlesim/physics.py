"""The formulas of one tick, each for a single turtle (floats) and for many (NumPy arrays) alike.

Each formula exists once, so that :class:`turtlesim.model.Turtle` and
:class:`turtlesim.crowd.Crowd` agree to the last bit. Functions that Python and NumPy call
differently (``floor``, ``sqrt``) are arguments. The caller computes sine and cosine with
:mod:`math`, because NumPy's differ from the C library's in the last bit.

Positions are metres, headings radians; the vertical axis points down.
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
