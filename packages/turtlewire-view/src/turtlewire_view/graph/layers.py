"""The column of each box, so that messages flow from left to right, and the order in the columns.

This is Sugiyama's method: a box stands to the right of all that send to it, and sweeps over the
columns put boxes near the boxes that they are connected to. An arrow that crosses columns gets a
joint in each of them. Boxes in a cycle stand in the order in which a message reaches them, so that
a few arrows lead back to the left.
"""

from __future__ import annotations

import heapq
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

__all__ = ["Layers", "Neighbours", "make_layers"]

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
