"""The positions of boxes and joints within one connected part of the diagram.

Columns keep their order from top to bottom. Each box gets as near as possible to the middle of what
it is connected to. A column of many boxes becomes several, side by side, so that the whole has
about the shape of a screen.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Sequence

    from turtlewire_view.graph.layers import Layers, Neighbours

__all__ = ["BOX_HEIGHT", "GAP", "Place", "Places", "find_places"]

BOX_HEIGHT = 28.0
#: Between two boxes, one above the other.
GAP = 18.0
_JOINT_HEIGHT = 6.0
_BESIDE = 34.0  # between two boxes of one column, side by side
_BETWEEN = (56.0, 150.0)  # between two columns, with few and with many arrows
_SPREAD = 1.6  # more of this gap for each arrow
_SHAPE = 1.8  # width to height
_FEWEST_ROWS = 8
_ROUNDS = 8


class Place(NamedTuple):
    """The position of a box or joint.

    Attributes:
        x: Its left end.
        y: Its middle.
        left: The x at which arrows arrive: the left end of the column if other boxes are between.
        right: The x at which arrows leave, in the same way.
    """

    x: float
    y: float
    left: float
    right: float


class Places(NamedTuple):
    """The positions of all boxes and joints, and the size of the whole."""

    of: dict[int, Place]
    width: float
    height: float


def find_places(layers: Layers, widths: Sequence[float]) -> Places:
    """Return the positions of boxes and joints.

    Args:
        layers: Their columns and order.
        widths: The width of each box.
    """
    rows = _most_rows(layers, widths)
    columns = [_in_rows(column, rows, len(widths)) for column in layers.columns]
    heights = _heights(columns, layers, len(widths))
    top = min((y - _size(box, len(widths)) / 2 for box, y in heights.items()), default=0.0)
    bottom = max((y + _size(box, len(widths)) / 2 for box, y in heights.items()), default=0.0)
    places: dict[int, Place] = {}
    x = 0.0
    for number, column in enumerate(columns):
        if number:
            arrows = sum(len(layers.left[box]) for row in column for box in row)
            x += min(_BETWEEN[0] + _SPREAD * arrows, _BETWEEN[1])
        x = _fill(column, x, widths, {box: y - top for box, y in heights.items()}, places)
    return Places(places, x, bottom - top)


def _fill(
    column: list[list[int]],
    x: float,
    widths: Sequence[float],
    heights: dict[int, float],
    places: dict[int, Place],
) -> float:
    """Set the positions of the rows of a column; returns the right end of the column."""
    count = max(map(len, column))
    wide = [
        max((widths[row[n]] for row in column if n < len(row) and row[n] < len(widths)), default=0)
        for n in range(count)
    ]
    right = x + sum(wide) + _BESIDE * (count - 1)
    for row in column:
        at = x
        for n, box in enumerate(row):
            if box >= len(widths):
                places[box] = Place(x, heights[box], x, right)
                continue
            own = at + (wide[n] - widths[box]) / 2
            left_end = x if n else own
            right_end = own + widths[box] if n == len(row) - 1 else right
            places[box] = Place(own, heights[box], left_end, right_end)
            at += wide[n] + _BESIDE
    return right


def _most_rows(layers: Layers, widths: Sequence[float]) -> int:
    """Return how many boxes a column may have, so that the whole has the shape of a screen."""
    counts = [sum(box < len(widths) for box in column) for column in layers.columns]
    wide = max(widths) + _BESIDE
    rows = _FEWEST_ROWS
    while rows < max(counts):
        width = sum(-(-count // rows) for count in counts) * wide + len(counts) * _BETWEEN[1]
        if width <= _SHAPE * rows * (BOX_HEIGHT + GAP):
            break
        rows += 1
    return rows


def _in_rows(column: list[int], rows: int, boxes: int) -> list[list[int]]:
    """Return the rows of a column: one joint each, or some boxes that follow each other."""
    beside = -(-sum(box < boxes for box in column) // rows)
    found: list[list[int]] = []
    for box in column:
        if box < boxes and found and found[-1][0] < boxes and len(found[-1]) < beside:
            found[-1].append(box)
        else:
            found.append([box])
    return found


def _heights(columns: list[list[list[int]]], layers: Layers, boxes: int) -> dict[int, float]:
    """Return the middle of each box and joint, counted downwards."""
    heights: dict[int, float] = {}
    for column in columns:
        _place_rows(column, [0.0] * len(column), heights, boxes)
    for number in range(_ROUNDS):
        forward = number % 2 == 0
        sides = [layers.left, layers.right]
        if number < _ROUNDS - 2:
            sides = sides[:1] if forward else sides[1:]
        for column in columns if forward else reversed(columns):
            wishes = [_wish(row, sides, heights) for row in column]
            _place_rows(column, wishes, heights, boxes)
    return heights


def _wish(row: list[int], sides: Sequence[Neighbours], heights: dict[int, float]) -> float:
    """Return the mean height of the boxes that a row is connected to."""
    near = [heights[each] for side in sides for box in row for each in side[box]]
    return sum(near) / len(near) if near else heights[row[0]]


def _place_rows(
    column: list[list[int]], wishes: list[float], heights: dict[int, float], boxes: int
) -> None:
    """Put rows as near to their wanted heights as order and size allow, without overlaps.

    The sum of the squared distances from the wanted heights is minimal: rows that would overlap
    form a block at the mean of their wanted heights ("pool adjacent violators").
    """
    offsets, offset, before = [], 0.0, 0.0
    for row in column:
        size = _size(row[0], boxes)
        offset += (before + size) / 2
        offsets.append(offset)
        before = size
    blocks: list[tuple[float, int]] = []  # mean and number of rows
    for wish, shift in zip(wishes, offsets, strict=True):
        mean, count = wish - shift, 1
        while blocks and blocks[-1][0] >= mean:
            above, more = blocks.pop()
            mean, count = (above * more + mean * count) / (more + count), more + count
        blocks.append((mean, count))
    starts = [mean for mean, count in blocks for _ in range(count)]
    for row, start, shift in zip(column, starts, offsets, strict=True):
        heights.update(dict.fromkeys(row, start + shift))


def _size(box: int, boxes: int) -> float:
    return BOX_HEIGHT + GAP if box < boxes else _JOINT_HEIGHT
