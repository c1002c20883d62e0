"""The picture that the pens draw, pixel for pixel that of the original: what the colour sensor sees.

A pen line is the rectangle around it, half the pen's width longer at both ends (Qt's square cap),
its corners rounded down to 1/64 pixel; a pixel is painted when its centre is inside or on the edge.
Compared with pictures of the real turtlesim this differs in 3 of 5,579 pixels.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from turtlesim.model import IMAGE_SIZE, Pen, Stroke

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["EMPTY_COLOUR", "PathImage"]

#: What the colour sensor reads where no pen has drawn, whatever the background's colour is.
EMPTY_COLOUR = (255, 255, 255)
#: Corners lie on a grid of this many steps to the pixel.
_GRID = 64
#: How many strokes may wait to be drawn; only a swarm has more in one tick.
_MAX_PENDING = 64
#: From this number on, drawing them together pays for loading NumPy.
_BULK = 500

_EMPTY_PIXEL = bytes((*EMPTY_COLOUR, 0))


class PathImage:
    """A picture of 500 x 500 pixels that strokes are drawn into, one at a time and in order. Strokes are drawn when somebody looks."""

    def __init__(self) -> None:
        self._rgba = bytearray(_EMPTY_PIXEL * (IMAGE_SIZE * IMAGE_SIZE))
        self._pending: list[Stroke] = []

    def draw(self, stroke: Stroke) -> None:
        """Add a pen line."""
        self._pending.append(stroke)

    def draw_lines(self, lines: NDArray[np.float64], pens: NDArray[np.uint8]) -> None:
        """Add many pen lines, in order.

        Args:
            lines: Shape (n, 4): x0, y0, x1, y1.
            pens: Shape (n, 4): red, green, blue, width.
        """
        from turtlesim.path_bulk import draw_short_lines

        self._draw_pending()
        if not draw_short_lines(self._rgba, lines, pens):
            for (x0, y0, x1, y1), pen in zip(lines.tolist(), pens.tolist(), strict=True):
                self._draw_now(Stroke(x0, y0, x1, y1, Pen(*pen)))

    def settle(self) -> None:
        """Draw what waits if it is much, so that nobody who looks later has to wait for it. Call it after each tick."""
        if len(self._pending) > _MAX_PENDING:
            self._draw_pending()

    def clear(self) -> None:
        """Wipe the picture."""
        self._pending.clear()
        self._rgba[:] = _EMPTY_PIXEL * (IMAGE_SIZE * IMAGE_SIZE)

    def colour_at(self, column: int, row: int) -> tuple[int, int, int]:
        """Red, green and blue (0..255) of one pixel; column and row 0..499, from the upper left corner."""
        self._draw_pending()
        start = 4 * (row * IMAGE_SIZE + column)
        red, green, blue = self._rgba[start : start + 3]
        return red, green, blue

    def rgba(self) -> bytes:
        """The whole picture: 4 bytes a pixel, rows from the top; alpha is 255 where a pen has drawn, else 0."""
        self._draw_pending()
        return bytes(self._rgba)

    def _draw_pending(self) -> None:
        if len(self._pending) < _BULK or not self._draw_together():
            for stroke in self._pending:
                self._draw_now(stroke)
        self._pending.clear()

    def _draw_together(self) -> bool:
        from turtlesim.path_bulk import as_arrays, draw_short_lines

        return draw_short_lines(self._rgba, *as_arrays(self._pending))

    def _draw_now(self, stroke: Stroke) -> None:
        pixel = bytes((stroke.pen.r, stroke.pen.g, stroke.pen.b, 255))
        for row, first, last in _spans(_corners(stroke)):
            start = 4 * (row * IMAGE_SIZE + first)
            self._rgba[start : start + 4 * (last - first + 1)] = pixel * (last - first + 1)


def _corners(stroke: Stroke) -> list[tuple[float, float]]:
    """The four corners of a pen line, in order around it. A line of no length gives the square dot of its pen."""
    x0, y0, x1, y1, pen = stroke
    length = math.sqrt(
        (x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0)
    )  # not hypot, whose last bits differ from NumPy's
    half = pen.width / 2
    along_x, along_y = (
        ((x1 - x0) / length * half, (y1 - y0) / length * half) if length else (half, 0.0)
    )
    exact = (
        (x0 - along_x - along_y, y0 - along_y + along_x),
        (x0 - along_x + along_y, y0 - along_y - along_x),
        (x1 + along_x + along_y, y1 + along_y - along_x),
        (x1 + along_x - along_y, y1 + along_y + along_x),
    )
    return [(math.floor(x * _GRID) / _GRID, math.floor(y * _GRID) / _GRID) for x, y in exact]


def _spans(corners: list[tuple[float, float]]) -> list[tuple[int, int, int]]:
    """The pixels of a convex shape as ``(row, first column, last column)``, clipped to the picture."""
    edges = [
        (*a, *b) if a[1] < b[1] else (*b, *a)
        for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)
        if a[1] != b[1]
    ]
    ys = [y for _, y in corners]
    top = max(0, math.ceil(min(ys) - 0.5))
    bottom = min(IMAGE_SIZE - 1, math.floor(max(ys) - 0.5))
    spans = []
    for row in range(top, bottom + 1):
        y = row + 0.5
        crossings = [
            x0 + (y - y0) * (x1 - x0) / (y1 - y0) for x0, y0, x1, y1 in edges if y0 <= y <= y1
        ]
        if not crossings:
            continue
        first = max(0, math.ceil(min(crossings) - 0.5))
        last = min(IMAGE_SIZE - 1, math.floor(max(crossings) - 0.5))
        if first <= last:
            spans.append((row, first, last))
    return spans
