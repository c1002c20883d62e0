"""Draws many short lines at once, pixel for pixel as :mod:`turtlesim.path` does one by one. For swarms; with NumPy."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from turtlesim.model import IMAGE_SIZE

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from turtlesim.model import Stroke

__all__ = ["as_arrays", "draw_short_lines"]

_GRID = 64
#: Longest extent of a line with its pen [pixels]; every line costs the square of the longest one's.
MAX_EXTENT = 10


def as_arrays(strokes: list[Stroke]) -> tuple[NDArray[np.float64], NDArray[np.uint8]]:
    """Places and pens of strokes, shape (n, 4) each, as :func:`draw_short_lines` takes them."""
    return np.array([stroke[:4] for stroke in strokes], dtype=np.float64), np.array(
        [stroke.pen for stroke in strokes], dtype=np.uint8
    )


def draw_short_lines(rgba: bytearray, lines: NDArray[np.float64], pens: NDArray[np.uint8]) -> bool:
    """Draw lines in order into a picture of 500 x 500 pixels, 4 bytes each.

    Args:
        rgba: The picture.
        lines: Shape (n, 4): x0, y0, x1, y1 [pixels].
        pens: Shape (n, 4): red, green, blue, width.

    Returns:
        False, and nothing is drawn, when one of them is too long for this.
    """
    if not len(lines):
        return True
    corners_x, corners_y = _corners(lines, pens[:, 3])
    top = np.ceil(corners_y.min(axis=1) - 0.5)
    extent = int(max(np.max(corners_y.max(axis=1) - top), np.max(np.ptp(corners_x, axis=1)))) + 1
    if extent > MAX_EXTENT:
        return False
    rows = top[:, None] + np.arange(extent)
    first, last = _spans(corners_x, corners_y, rows + 0.5)
    columns = first[:, :, None] + np.arange(extent)
    inside = (
        (columns <= last[:, :, None])
        & (columns >= 0)
        & (columns < IMAGE_SIZE)
        & ((rows >= 0) & (rows < IMAGE_SIZE))[:, :, None]
    )
    pixels = (rows[:, :, None] * IMAGE_SIZE + columns)[inside].astype(np.intp)
    opaque = pens.copy()
    opaque[:, 3] = 255
    colours = np.repeat(opaque.view(np.uint32)[:, 0], inside.sum(axis=(1, 2)))
    np.frombuffer(rgba, dtype=np.uint32)[pixels] = (
        colours  # of equal pixels the last one counts, as when drawn in order
    )
    return True


def _corners(
    lines: NDArray[np.float64], widths: NDArray[np.uint8]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Columns and rows of the four corners of each line, shape (n, 4) each."""
    x0, y0, x1, y1 = lines.T
    length = np.sqrt((x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0))
    half = widths / 2
    is_dot = length == 0.0
    length[is_dot] = 1.0
    along_x = np.where(is_dot, half, (x1 - x0) / length * half)
    along_y = np.where(is_dot, 0.0, (y1 - y0) / length * half)
    xs = (
        x0 - along_x - along_y,
        x0 - along_x + along_y,
        x1 + along_x + along_y,
        x1 + along_x - along_y,
    )
    ys = (
        y0 - along_y + along_x,
        y0 - along_y - along_x,
        y1 + along_y - along_x,
        y1 + along_y + along_x,
    )
    return np.floor(np.stack(xs, axis=1) * _GRID) / _GRID, np.floor(
        np.stack(ys, axis=1) * _GRID
    ) / _GRID


def _spans(
    xs: NDArray[np.float64], ys: NDArray[np.float64], rows: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """First and last column on each row, shape (n, rows); an empty row has its first after its last."""
    lowest = np.full(rows.shape, np.inf)
    highest = np.full(rows.shape, -np.inf)
    for a in range(4):
        b = (a + 1) % 4
        swap = ys[:, a] >= ys[:, b]
        x0, y0 = (
            np.where(swap, xs[:, b], xs[:, a])[:, None],
            np.where(swap, ys[:, b], ys[:, a])[:, None],
        )
        x1, y1 = (
            np.where(swap, xs[:, a], xs[:, b])[:, None],
            np.where(swap, ys[:, a], ys[:, b])[:, None],
        )
        flat = y0 == y1
        crossing = x0 + (rows - y0) * (x1 - x0) / np.where(flat, 1.0, y1 - y0)
        met = ~flat & (y0 <= rows) & (rows <= y1)
        lowest = np.where(met, np.minimum(lowest, crossing), lowest)
        highest = np.where(met, np.maximum(highest, crossing), highest)
    empty = lowest > highest
    first = np.ceil(np.where(empty, 1.0, lowest) - 0.5)
    return first, np.where(empty, first - 1, np.floor(np.where(empty, 0.0, highest) - 0.5))
