"""The shape of a pen line, for a single line (floats) and for many (NumPy arrays) alike.

A pen line is the rectangle around it, half the pen's width longer at both ends (Qt's square cap),
its corners rounded down to 1/64 pixel. Each of its edges falls on the nearest boundary between two
pixels, a tie on the higher one: a pixel is painted when its centre is inside, or on the lower or
right edge. As in :mod:`turtlesim.physics`, functions that Python and NumPy call
differently are arguments.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

#: A float, or an array of them.
_Number = TypeVar("_Number", float, "NDArray[np.float64]")

#: An int, or an array of whole numbers.
_Whole = TypeVar("_Whole", bound=Any)

#: Corners lie on a grid of this many steps to the pixel.
_GRID = 64


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
