"""Draws the short lines of a swarm together, the same pixels as :mod:`turtlesim.path`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from turtlesim.physics import IMAGE_SIZE, boundary, corners, crossing, length_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from turtlesim.model import Stroke

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
    top = boundary(corners_y.min(axis=1), np.floor)
    extent = int(max(np.max(np.ptp(corners_y, axis=1)), np.max(np.ptp(corners_x, axis=1)))) + 1
    if extent > MAX_EXTENT:
        return False
    rows = top[:, None] + np.arange(extent)
    first, end = _spans(corners_x, corners_y, rows + 0.5)
    columns = first[:, :, None] + np.arange(extent)
    inside = (
        (columns < end[:, :, None])
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
    length = length_of(x0, y0, x1, y1, np.sqrt)
    half = widths / 2
    is_dot = length == 0.0
    length[is_dot] = 1.0
    along_x = np.where(is_dot, half, (x1 - x0) / length * half)
    along_y = np.where(is_dot, 0.0, (y1 - y0) / length * half)
    xs, ys = zip(*corners((x0, y0, x1, y1), (along_x, along_y), np.floor), strict=True)
    return np.stack(xs, axis=1), np.stack(ys, axis=1)


def _spans(
    xs: NDArray[np.float64], ys: NDArray[np.float64], rows: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """First and end column of each shape on each row, shape (n, rows); equal on an empty row."""
    lowest = np.full(rows.shape, np.inf)
    highest = np.full(rows.shape, -np.inf)
    for a in range(4):
        b = (a + 1) % 4
        swap = ys[:, a] >= ys[:, b]
        x0, y0, x1, y1 = (
            np.where(swap, ends[:, other], ends[:, own])[:, None]
            for own, other in ((a, b), (b, a))
            for ends in (xs, ys)
        )
        is_level = y0 == y1
        place = crossing(rows, x0, y0, x1, np.where(is_level, y0 + 1.0, y1))
        met = ~is_level & (y0 <= rows) & (rows <= y1)
        lowest = np.where(met, np.minimum(lowest, place), lowest)
        highest = np.where(met, np.maximum(highest, place), highest)
    empty = lowest > highest
    return (
        boundary(np.where(empty, 0.0, lowest), np.floor),
        boundary(np.where(empty, 0.0, highest), np.floor),
    )
