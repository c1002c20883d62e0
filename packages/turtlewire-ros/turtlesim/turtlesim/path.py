"""The picture that the pens draw, which the colour sensor reads.

Of 5,579 pixels that the real turtlesim painted (``tests/golden/sim``), 3 differ.
:mod:`turtlesim.physics` says which pixels a line covers.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from turtlesim.model import IMAGE_SIZE, Pen, Stroke
from turtlesim.physics import boundary, corners, crossing, length_of

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

#: The colour sensor's value where no pen has drawn, for every colour of the background.
EMPTY_COLOUR = (255, 255, 255)
#: How many strokes are kept after a tick; only a swarm has more.
_MAX_PENDING = 64
#: From this number on, drawing them together pays for loading NumPy.
_BULK = 500

_EMPTY_PIXEL = bytes((*EMPTY_COLOUR, 0))


class PathImage:
    """A picture of 500 x 500 pixels. Strokes are kept, and drawn when a pixel is read."""

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
        """Draw the kept strokes if there are many, which bounds the time of a read."""
        if len(self._pending) > _MAX_PENDING:
            self._draw_pending()

    def clear(self) -> None:
        """Wipe the picture."""
        self._pending.clear()
        self._rgba[:] = _EMPTY_PIXEL * (IMAGE_SIZE * IMAGE_SIZE)

    def colour_at(self, column: int, row: int) -> tuple[int, int, int]:
        """Red, green and blue (0..255) of a pixel; (0, 0) is the upper left one."""
        self._draw_pending()
        start = 4 * (row * IMAGE_SIZE + column)
        red, green, blue = self._rgba[start : start + 3]
        return red, green, blue

    def rgba(self) -> bytes:
        """The picture: 4 bytes a pixel, rows from the top; alpha is 255 where drawn, else 0."""
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
        for row, first, end in _spans(_corners(stroke)):
            start = 4 * (row * IMAGE_SIZE + first)
            self._rgba[start : start + 4 * (end - first)] = pixel * (end - first)


def _corners(stroke: Stroke) -> list[tuple[float, float]]:
    x0, y0, x1, y1, pen = stroke
    length = length_of(x0, y0, x1, y1, math.sqrt)
    half = pen.width / 2
    along = ((x1 - x0) / length * half, (y1 - y0) / length * half) if length else (half, 0.0)
    return corners((x0, y0, x1, y1), along, math.floor)


def _spans(shape: list[tuple[float, float]]) -> list[tuple[int, int, int]]:
    """The pixels of a convex shape in the picture, as ``(row, first column, end column)``."""
    edges = [
        (*a, *b) if a[1] < b[1] else (*b, *a)
        for a, b in zip(shape, [*shape[1:], shape[0]], strict=True)
        if a[1] != b[1]
    ]
    ys = [y for _, y in shape]
    top = max(0, boundary(min(ys), math.floor))
    bottom = min(IMAGE_SIZE, boundary(max(ys), math.floor))
    spans = []
    for row in range(top, bottom):
        y = row + 0.5
        crossings = [crossing(y, *edge) for edge in edges if edge[1] <= y <= edge[3]]
        first = max(0, boundary(min(crossings), math.floor))
        end = min(IMAGE_SIZE, boundary(max(crossings), math.floor))
        if first < end:
            spans.append((row, first, end))
    return spans
