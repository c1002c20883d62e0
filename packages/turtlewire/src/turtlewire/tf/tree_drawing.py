"""The diagram of a tree of frames.

Each frame is a box with statistics of the link to its parent. Children are side by side, centred
below their parent, and subtrees are as close as possible.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from turtlewire.tf.drawing import (
    BROWSER_FONTS,
    Drawing,
    FilledBox,
    Line,
    Shape,
    Text,
    text_width,
)

if TYPE_CHECKING:
    from turtlewire.tf.frame_tree import FrameLink, FrameTree

__all__ = [
    "draw_tree",
    "tidy_positions",
]


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


_NAME_SIZE, _NOTE_SIZE = 12.0, 8.5
_LINE = 11.0
_PADDING, _GAP, _ROW_GAP, _MARGIN = 7.0, 14.0, 26.0, 12.0
_LONGEST = 60
_BORDER, _INK, _GREY, _RED = "#4a6785", "#1d2a36", "#66737f", "#c0392b"

#: A tree that would be wider than this grows to the right instead of downwards.
_WIDEST = 1200.0


def draw_tree(tree: FrameTree, title: Sequence[str] = ()) -> Drawing:
    """Draw all frames of a tree.

    Args:
        tree: What to draw.
        title: Lines of text above the picture.
    """
    cards = {frame: _Card(tree, frame) for frame in tree.children}
    heading, top = _heading(title if cards else (*title, "No tf data received"))
    width = max(
        (_MARGIN * 2 + text_width(line.text, line.size, bold=True) for line in heading), default=0.0
    )
    across = tidy_positions(
        tree.roots, tree.children, {frame: card.width for frame, card in cards.items()}, _GAP
    )
    right_edge = max(
        (place + cards[frame].width / 2 for frame, (place, _) in across.items()), default=0.0
    )
    sideways = right_edge > _WIDEST
    if sideways:
        across = tidy_positions(
            tree.roots, tree.children, {frame: card.height for frame, card in cards.items()}, _GAP
        )
    rows = _rows(cards, across, sideways=sideways)
    for frame, (place, row) in across.items():
        card = cards[frame]
        card.x, card.y = (
            (rows[row], place - card.height / 2)
            if sideways
            else (place - card.width / 2, rows[row])
        )
        card.x, card.y = card.x + _MARGIN, card.y + top
    lines = [
        _line(cards[parent], cards[child], sideways=sideways)
        for parent in tree.children
        for child in tree.children[parent]
    ]
    lines += [_loop_line(cards[tree.links[loop[0]].parent], cards[loop[0]]) for loop in tree.loops]
    width = max([width, *(card.x + card.width + _MARGIN for card in cards.values())])
    height = max([top, *(card.y + card.height + _MARGIN for card in cards.values())])
    return Drawing(
        width,
        height,
        (*heading, *lines, *(shape for card in cards.values() for shape in card.shapes())),
    )


class _Card:
    """A frame's box with its text; where it stands is decided later."""

    def __init__(self, tree: FrameTree, frame: str) -> None:
        link = tree.links.get(frame)
        self.name = frame if len(frame) <= _LONGEST else frame[: _LONGEST - 1] + "…"
        self.notes = _notes(link) if link else []
        if any(frame == loop[0] for loop in tree.loops):
            assert link is not None
            self.notes.append(f"In a loop: its parent is {link.parent}")
        widths = [
            text_width(self.name, _NAME_SIZE, bold=True),
            *(text_width(note, _NOTE_SIZE) for note in self.notes),
        ]
        self.width = BROWSER_FONTS * max(widths) + 2 * _PADDING
        self.height = _NAME_SIZE + _LINE * len(self.notes) + 2 * _PADDING
        self.x = self.y = 0.0

    def shapes(self) -> list[Shape]:
        baseline = self.y + _PADDING + _NAME_SIZE - 2
        notes = [
            Text(
                self.x + _PADDING,
                baseline + _LINE * line,
                note,
                _NOTE_SIZE,
                _RED if note.startswith("In a loop") else _GREY,
            )
            for line, note in enumerate(self.notes, 1)
        ]
        name = Text(self.x + _PADDING, baseline, self.name, _NAME_SIZE, _INK, bold=True)
        return [FilledBox(self.x, self.y, self.width, self.height, _BORDER), name, *notes]


def _notes(link: FrameLink) -> list[str]:
    if link.is_static:
        return [f"Broadcaster: {link.broadcaster}", "Static transform"]
    rate = f"{link.rate_hz:.3f} Hz" if link.length else "unknown, one time only"
    return [
        f"Broadcaster: {link.broadcaster}",
        f"Average rate: {rate}",
        f"Buffer length: {link.length:.3f} s",
        f"Most recent transform: {link.newest:.6f}",
        f"Oldest transform: {link.oldest:.6f}",
    ]


def _heading(title: Sequence[str]) -> tuple[list[Text], float]:
    lines = [
        Text(_MARGIN, _MARGIN + _NAME_SIZE + 15 * line, text, _NAME_SIZE, _GREY, bold=line == 0)
        for line, text in enumerate(title)
    ]
    return lines, _MARGIN + 15 * len(lines) + (_NAME_SIZE if lines else 0.0)


def _rows(
    cards: dict[str, _Card], across: dict[str, tuple[float, int]], *, sideways: bool
) -> list[float]:
    """Return the start of each row: after the largest card of the row before."""
    largest: dict[int, float] = {}
    for frame, (_, row) in across.items():
        size = cards[frame].width if sideways else cards[frame].height
        largest[row] = max(largest.get(row, 0.0), size)
    starts = [0.0]
    for row in range(len(largest)):
        starts.append(starts[-1] + largest[row] + _ROW_GAP)
    return starts


def _line(parent: _Card, child: _Card, *, sideways: bool) -> Line:
    if sideways:
        y, x = parent.y + parent.height / 2, child.x - _ROW_GAP / 2
        to = child.y + child.height / 2
        return Line(((parent.x + parent.width, y), (x, y), (x, to), (child.x, to)), _BORDER)
    x, y = parent.x + parent.width / 2, child.y - _ROW_GAP / 2
    to = child.x + child.width / 2
    return Line(((x, parent.y + parent.height), (x, y), (to, y), (to, child.y)), _BORDER)


def _loop_line(parent: _Card, child: _Card) -> Line:
    ends = tuple((card.x + card.width / 4, card.y + card.height / 2) for card in (parent, child))
    return Line(ends, _RED, 1.5, dashed=True)
