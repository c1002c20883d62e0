"""Draws many short strokes at once, pixel for pixel as :mod:`turtlesim.path` does one by one. For swarms; the only user of NumPy here."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from turtlesim.model import IMAGE_SIZE

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from turtlesim.model import Stroke

__all__ = ["draw_short_strokes"]

_GRID = 64
#: Longest extent of a stroke with its pen [pixels]; every stroke costs this number squared.
MAX_EXTENT = 10


def draw_short_strokes(rgba: bytearray, strokes: list[Stroke]) -> bool:
    """Draw the strokes in order into a picture of 500 x 500 pixels, 4 bytes each.

    Returns:
        False, and nothing is drawn, when one of them is too long for this.
    """
    corners_x, corners_y = _corners(strokes)
    top = np.ceil(corners_y.min(axis=1) - 0.5)
    if np.any(corners_y.max(axis=1) - top > MAX_EXTENT - 1) or np.any(np.ptp(corners_x, axis=1) > MAX_EXTENT - 1):
        return False
    rows = top[:, None] + np.arange(MAX_EXTENT)
    first, last = _spans(corners_x, corners_y, rows + 0.5)
    columns = first[:, :, None] + np.arange(MAX_EXTENT)
    inside = (columns <= last[:, :, None]) & (columns >= 0) & (columns < IMAGE_SIZE) & ((rows >= 0) & (rows < IMAGE_SIZE))[:, :, None]
    pixels = (rows[:, :, None] * IMAGE_SIZE + columns)[inside].astype(np.intp)
    pens = np.array([(stroke.pen.r, stroke.pen.g, stroke.pen.b, 255) for stroke in strokes], dtype=np.uint8).view(np.uint32)
    colours = np.repeat(pens[:, 0], inside.sum(axis=(1, 2)))
    np.frombuffer(rgba, dtype=np.uint32)[pixels] = colours  # of equal pixels the last one counts, as when drawn in order
    return True


def _corners(strokes: list[Stroke]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Columns and rows of the four corners of each stroke, shape (n, 4) each."""
    x0, y0, x1, y1, width = np.array([(*stroke[:4], stroke.pen.width) for stroke in strokes], dtype=np.float64).T
    length = np.sqrt((x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0))
    half = width / 2
    is_dot = length == 0.0
    length[is_dot] = 1.0
    along_x = np.where(is_dot, half, (x1 - x0) / length * half)
    along_y = np.where(is_dot, 0.0, (y1 - y0) / length * half)
    xs = (x0 - along_x - along_y, x0 - along_x + along_y, x1 + along_x + along_y, x1 + along_x - along_y)
    ys = (y0 - along_y + along_x, y0 - along_y - along_x, y1 + along_y - along_x, y1 + along_y + along_x)
    return np.floor(np.stack(xs, axis=1) * _GRID) / _GRID, np.floor(np.stack(ys, axis=1) * _GRID) / _GRID


def _spans(xs: NDArray[np.float64], ys: NDArray[np.float64], rows: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """First and last column on each row, shape (n, rows); an empty row has its first after its last."""
    lowest = np.full(rows.shape, np.inf)
    highest = np.full(rows.shape, -np.inf)
    for a in range(4):
        b = (a + 1) % 4
        swap = ys[:, a] >= ys[:, b]
        x0, y0 = np.where(swap, xs[:, b], xs[:, a])[:, None], np.where(swap, ys[:, b], ys[:, a])[:, None]
        x1, y1 = np.where(swap, xs[:, a], xs[:, b])[:, None], np.where(swap, ys[:, a], ys[:, b])[:, None]
        flat = y0 == y1
        crossing = x0 + (rows - y0) * (x1 - x0) / np.where(flat, 1.0, y1 - y0)
        met = ~flat & (y0 <= rows) & (rows <= y1)
        lowest = np.where(met, np.minimum(lowest, crossing), lowest)
        highest = np.where(met, np.maximum(highest, crossing), highest)
    empty = lowest > highest
    first = np.ceil(np.where(empty, 1.0, lowest) - 0.5)
    return first, np.where(empty, first - 1, np.floor(np.where(empty, 0.0, highest) - 0.5))
