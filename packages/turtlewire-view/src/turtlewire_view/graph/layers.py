"""The columns of the boxes of a connected part, their order, and their positions.

This is Sugiyama's method: a box stands to the right of all that send to it, so that messages flow
from left to right, and sweeps over the columns put boxes near the boxes that they are connected to.
An arrow that crosses columns gets a joint in each of them. Boxes in a cycle stand in the order in
which a message reaches them, so that a few arrows lead back to the left.

Columns keep their order from top to bottom. Each box gets as near as possible to the middle of what
it is connected to. A column of many boxes becomes several, side by side, so that the whole has
about the shape of a screen.
"""

from __future__ import annotations

import heapq
from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import NamedTuple

__all__ = [
    "BOX_HEIGHT",
    "GAP",
    "Layers",
    "Neighbours",
    "Place",
    "Places",
    "find_places",
    "make_layers",
]

_SWEEPS = 6
#: With more joints than this, arrows pass behind boxes: sorting would take seconds.
_MOST_JOINTS = 6_000

#: The numbers of the boxes and joints that each is connected to.
Neighbours = dict[int, list[int]]


class Layers(NamedTuple):
    """Boxes and joints in columns. Joints have numbers from the number of boxes on.

    Attributes:
        columns: The boxes and joints of each column, from top to bottom.
        left: The neighbours in the previous column.
        right: The neighbours in the next column.
        joints: The joints of each arrow, from left to right.
        steps: How many columns each arrow leads to the right; negative to the left.
    """

    columns: list[list[int]]
    left: Neighbours
    right: Neighbours
    joints: list[list[int]]
    steps: list[int]


def make_layers(starts: Sequence[int], arrows: Sequence[tuple[int, int]]) -> Layers:
    """Put boxes into columns.

    Args:
        starts: The first column that each box may have. With 0 for nodes and 1 for topics, no
            column holds both.
        arrows: From box to box, none of them from a box to itself.
    """
    count = len(starts)
    column = _columns(starts, arrows)
    least = min(column, default=0)
    column = [place - least for place in column]
    columns: list[list[int]] = [[] for _ in range(max(column, default=-1) + 1)]
    for box in range(count):
        columns[column[box]].append(box)
    left: Neighbours = {box: [] for box in range(count)}
    right: Neighbours = {box: [] for box in range(count)}
    steps = [column[target] - column[source] for source, target in arrows]
    has_joints = sum(map(abs, steps)) - len(steps) <= _MOST_JOINTS
    joints: list[list[int]] = []
    for (source, target), step in zip(arrows, steps, strict=True):
        joints.append([])
        start, end = (source, target) if step > 0 else (target, source)
        if step and has_joints:
            for place in range(column[start] + 1, column[end]):
                joints[-1].append(len(left))
                columns[place].append(len(left))
                left[len(left)], right[len(right)] = [], []
        if abs(step) == 1 or joints[-1]:
            for a, b in pairwise([start, *joints[-1], end]):
                right[a].append(b)
                left[b].append(a)
    _sort(columns, left, right)
    return Layers(columns, left, right, joints, steps)


def _columns(starts: Sequence[int], arrows: Sequence[tuple[int, int]]) -> list[int]:
    """Return the column of each box: after all that lead to it, except in a cycle."""
    after: list[list[int]] = [[] for _ in starts]
    before: list[list[int]] = [[] for _ in starts]
    for start, end in arrows:
        after[start].append(end)
        before[end].append(start)
    column = list(starts)
    for circle in _circles(after, before):
        inside = set(circle)
        entries = {}
        for box in circle:
            inputs = [column[each] + 1 for each in before[box] if each not in inside]
            if inputs:
                entries[box] = max(inputs)
        if not entries:
            first = max(circle, key=lambda box: (len(after[box]) - len(before[box]), -box))
            entries = {first: starts[first]}
        _walk(entries, after, inside, column)
    for box in range(len(starts)):
        if after[box] and not before[box]:  # nothing holds it at the left end
            column[box] = min(column[end] for end in after[box]) - 1
    return column


def _walk(
    entries: dict[int, int], after: list[list[int]], inside: set[int], column: list[int]
) -> None:
    """Set the columns of the boxes of a cycle, by the number of steps from its entries."""
    waiting = [(place, box) for box, place in entries.items()]
    heapq.heapify(waiting)
    is_done: set[int] = set()
    while waiting:
        place, box = heapq.heappop(waiting)
        if box in is_done:
            continue
        is_done.add(box)
        column[box] = place = max(place, entries.get(box, 0))
        for end in after[box]:
            if end in inside and end not in is_done:
                heapq.heappush(waiting, (place + 1, end))


def _circles(after: list[list[int]], before: list[list[int]]) -> list[list[int]]:
    """Return the groups of boxes that reach each other, mostly single ones; senders come first.

    This is Kosaraju's method: the walk against the arrows begins where the first walk ended last.
    """
    ended: list[int] = []
    is_seen = [False] * len(after)
    sources = sorted(range(len(after)), key=lambda box: (len(before[box]) > 0, box))
    for first in sources:
        path = [] if is_seen[first] else [(first, iter(after[first]))]
        is_seen[first] = True
        while path:
            box, rest = path[-1]
            step = next((end for end in rest if not is_seen[end]), None)
            if step is None:
                ended.append(box)
                path.pop()
            else:
                is_seen[step] = True
                path.append((step, iter(after[step])))
    circles = []
    for first in reversed(ended):
        circle = [first] if is_seen[first] else []
        is_seen[first] = False
        for box in circle:  # it grows
            for start in before[box]:
                if is_seen[start]:
                    is_seen[start] = False
                    circle.append(start)
        if circle:
            circles.append(sorted(circle))
    return circles


def _sort(columns: list[list[int]], left: Neighbours, right: Neighbours) -> None:
    """Sort the columns so that few arrows cross."""
    place = {box: n for column in columns for n, box in enumerate(column)}
    for sweep in range(_SWEEPS):
        forward = sweep % 2 == 0
        neighbours = left if forward else right
        for column in columns if forward else reversed(columns):
            middles = {box: _mean((place[each] for each in neighbours[box]), place[box])
                       for box in column}  # fmt: skip
            column.sort(key=middles.__getitem__)
            place.update((box, n) for n, box in enumerate(column))


def _mean(numbers: Iterable[float], default: float) -> float:
    found = list(numbers)
    return sum(found) / len(found) if found else default


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
