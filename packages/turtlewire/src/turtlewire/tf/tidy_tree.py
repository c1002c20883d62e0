"""Positions of the nodes of a drawn tree.

Children are side by side, centred below their parent, and subtrees are as close as possible.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

__all__ = ["tidy_positions"]


def tidy_positions(
    roots: Sequence[str],
    children: Mapping[str, Sequence[str]],
    sizes: Mapping[str, float],
    gap: float,
) -> dict[str, tuple[float, int]]:
    """Positions of all nodes of a forest.

    Args:
        roots: From left to right.
        children: Of each node, from left to right; without loops.
        sizes: The width of each node.
        gap: What stays free between two nodes of a row.

    Returns:
        For each node the middle of it across, from 0 on, and its row, the roots' being 0.
    """
    order = _parents_first(roots, children)
    #: Of each subtree the edges of each row, seen from its top node.
    outlines: dict[str, list[tuple[float, float]]] = {}
    shifts = dict.fromkeys(roots, 0.0)  # of each node from its parent
    for node in reversed(order):
        outline, places = _side_by_side([outlines.pop(child) for child in children[node]], gap)
        middle = (places[0] + places[-1]) / 2 if places else 0.0
        shifts.update(
            (child, place - middle) for child, place in zip(children[node], places, strict=True)
        )
        half = sizes[node] / 2
        outlines[node] = [
            (-half, half),
            *((left - middle, right - middle) for left, right in outline),
        ]
    outline, places = _side_by_side([outlines[root] for root in roots], gap)
    left_edge = min((left for left, _ in outline), default=0.0)
    positions = {root: (place - left_edge, 0) for root, place in zip(roots, places, strict=True)}
    for node in order:
        across, row = positions[node]
        positions.update((child, (across + shifts[child], row + 1)) for child in children[node])
    return positions


def _parents_first(roots: Sequence[str], children: Mapping[str, Sequence[str]]) -> list[str]:
    order, waiting = [], list(reversed(roots))
    while waiting:
        order.append(waiting.pop())
        waiting.extend(reversed(children[order[-1]]))
    return order


def _side_by_side(
    outlines: list[list[tuple[float, float]]], gap: float
) -> tuple[list[tuple[float, float]], list[float]]:
    """Return the common outline, and the position of each top node in it."""
    merged: list[tuple[float, float]] = []
    places: list[float] = []
    for outline in outlines:
        place = max(
            (right + gap - left for (_, right), (left, _) in zip(merged, outline, strict=False)),
            default=0.0,
        )
        places.append(place)
        for row, (left, right) in enumerate(outline):
            if row < len(merged):
                merged[row] = (merged[row][0], place + right)
            else:
                merged.append((place + left, place + right))
    return merged, places
