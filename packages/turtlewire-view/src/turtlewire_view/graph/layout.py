"""The boxes and arrows of a picture; their positions and paths, in pixels."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

from turtlewire.tf.drawing import BROWSER_FONTS, text_width
from turtlewire_view.graph.layers import BOX_HEIGHT, GAP, find_places, make_layers

if TYPE_CHECKING:
    from turtlewire_view.graph.layers import Layers, Place
    from turtlewire_view.graph.picture import Picture

__all__ = [
    "TEXT_SIZE",
    "Arrow",
    "Box",
    "Diagram",
    "Layout",
    "PlacedBox",
    "Way",
    "make_diagram",
    "make_layout",
]


class Box(NamedTuple):
    """A node or a topic.

    Attributes:
        kind: ``node`` or ``topic``.
        name: Full name.
        note: What is unusual: several nodes of one name, or a topic with several types.
    """

    kind: str
    name: str
    note: str = ""


class Arrow(NamedTuple):
    """The way of messages, from one box to another.

    Attributes:
        source: Index of the box where it begins.
        target: Index of the box where it ends.
        topics: What is sent.
        mismatches: Indices of the picture's mismatches that the arrow is part of.
    """

    source: int
    target: int
    topics: tuple[str, ...]
    mismatches: tuple[int, ...]


class Diagram(NamedTuple):
    """Boxes and the arrows between them."""

    boxes: list[Box]
    arrows: list[Arrow]


def make_diagram(picture: Picture, *, with_topics: bool) -> Diagram:
    """Return the boxes and arrows of a picture, in the order of names.

    Args:
        picture: What is shown.
        with_topics: Whether topics are boxes. If not, arrows lead from node to node.
    """
    boxes = [
        Box("node", name, f"{count} nodes have this name" if count > 1 else "")
        for name, count in picture.nodes.items()
    ]
    if not with_topics:
        return Diagram(boxes, _arrows_of_nodes(picture))
    boxes += [
        Box("topic", name, f"{len(types)} types: {', '.join(types)}" if len(types) > 1 else "")
        for name, types in picture.topics.items()
    ]
    return Diagram(boxes, _arrows_of_topics(picture, {box[:2]: n for n, box in enumerate(boxes)}))


def _arrows_of_topics(picture: Picture, numbers: dict[tuple[str, str], int]) -> list[Arrow]:
    kept_apart: dict[tuple[str, str, str], list[int]] = {}
    for index, each in enumerate(picture.mismatches):
        for node in each.publishers:
            kept_apart.setdefault((each.topic, node, "publisher"), []).append(index)
        for node in each.subscriptions:
            kept_apart.setdefault((each.topic, node, "subscription"), []).append(index)
    ends = dict.fromkeys((each.info.topic, each.node, each.info.kind) for each in picture.endpoints)
    arrows = []
    for end in ends:
        topic, node, kind = end
        places = numbers["node", node], numbers["topic", topic]
        source, target = places if kind == "publisher" else places[::-1]
        arrows.append(Arrow(source, target, (topic,), tuple(kept_apart.get(end, ()))))
    return arrows


def _arrows_of_nodes(picture: Picture) -> list[Arrow]:
    numbers = {name: n for n, name in enumerate(picture.nodes)}
    senders: dict[str, dict[str, None]] = {}
    receivers: dict[str, dict[str, None]] = {}
    for node, info in picture.endpoints:
        side = senders if info.kind == "publisher" else receivers
        side.setdefault(info.topic, {})[node] = None
    topics: dict[tuple[str, str], list[str]] = {}
    for topic in picture.topics:
        for sender in senders.get(topic, ()):
            for receiver in receivers.get(topic, ()):
                topics.setdefault((sender, receiver), []).append(topic)
    kept_apart: dict[tuple[str, str], list[int]] = {}
    for index, each in enumerate(picture.mismatches):
        for sender in each.publishers:
            for receiver in each.subscriptions:
                kept_apart.setdefault((sender, receiver), []).append(index)
    return [
        Arrow(numbers[a], numbers[b], tuple(names), tuple(kept_apart.get((a, b), ())))
        for (a, b), names in topics.items()
    ]


TEXT_SIZE = 13.0
_MARGIN = 24.0
_APART = 30.0  # between parts that no arrow connects
_PADDING = 13.0
_LONGEST = 46  # letters of a name in its box
_SHAPE = 1.7  # width to height of the whole
_HEAD = (7.0, 4.0)  # length and half the width of an arrow's head
_FIRST_COLUMN = {"node": 0, "topic": 1}
_AISLE = 5.0  # from a box to the arrows that pass it


class PlacedBox(NamedTuple):
    """A box with its left upper corner, its size, and what is written in it."""

    x: float
    y: float
    width: float
    height: float
    label: str


class Way(NamedTuple):
    """The way of an arrow.

    Attributes:
        path: The curve and the head as SVG writes paths.
        x: The position of a word, next to the middle of the last part.
        y: The same for the vertical axis.
    """

    path: str
    x: float
    y: float


class Layout(NamedTuple):
    """All boxes and arrows of a diagram, in its order, and the size of the whole."""

    boxes: list[PlacedBox]
    ways: list[Way]
    width: float
    height: float


class _Part(NamedTuple):
    """Boxes that are connected, with their places when the part stands alone."""

    members: list[int]
    arrows: list[int]
    layers: Layers
    places: dict[int, Place]
    width: float
    height: float


def make_layout(diagram: Diagram) -> Layout:
    """Return the positions of boxes and arrows; the same for the same diagram."""
    labels = [_label(box) for box in diagram.boxes]
    widths = [BROWSER_FONTS * text_width(label, TEXT_SIZE) + 2 * _PADDING for label in labels]
    parts = [
        _part(members, diagram.boxes, diagram.arrows, widths)
        for members in _parts(len(widths), diagram.arrows)
    ]
    parts.sort(key=lambda part: (-len(part.members), part.members))
    corners, width, height = _pack(parts)
    boxes: dict[int, PlacedBox] = {}
    ways: dict[int, Way] = {}
    for part, corner in zip(parts, corners, strict=True):
        of_part = [widths[box] for box in part.members]
        for n, box in enumerate(part.members):
            x, y = part.places[n].x + corner[0], part.places[n].y - BOX_HEIGHT / 2 + corner[1]
            boxes[box] = PlacedBox(x, y, widths[box], BOX_HEIGHT, labels[box])
        for index, knots in _knots(part, diagram.arrows, of_part):
            ways[index] = _way([(x + corner[0], y + corner[1]) for x, y in knots])
    for index, arrow in enumerate(diagram.arrows):
        if arrow.source == arrow.target:
            ways[index] = _loop(boxes[arrow.source])
        elif index not in ways:
            ways[index] = _beside(boxes[arrow.source], boxes[arrow.target])
    in_order = [boxes[n] for n in range(len(boxes))]
    return Layout(in_order, [ways[n] for n in range(len(ways))], width, height)


def _label(box: Box) -> str:
    """Return the name, or the end of a long one."""
    name = box.name if len(box.name) <= _LONGEST else f"…{box.name[1 - _LONGEST :]}"
    return f"{name} (!)" if box.note else name


def _parts(count: int, arrows: Sequence[Arrow]) -> list[list[int]]:
    """Return the boxes in groups that no arrow connects."""
    near: list[list[int]] = [[] for _ in range(count)]
    for arrow in arrows:
        near[arrow.source].append(arrow.target)
        near[arrow.target].append(arrow.source)
    is_seen = [False] * count
    parts = []
    for first in range(count):
        part = [] if is_seen[first] else [first]
        is_seen[first] = True
        for box in part:  # it grows
            for other in near[box]:
                if not is_seen[other]:
                    is_seen[other] = True
                    part.append(other)
        if part:
            parts.append(sorted(part))
    return parts


def _part(
    members: list[int], boxes: Sequence[Box], arrows: Sequence[Arrow], widths: Sequence[float]
) -> _Part:
    numbers = {box: n for n, box in enumerate(members)}
    own = [
        index
        for index, arrow in enumerate(arrows)
        if arrow.source in numbers and arrow.source != arrow.target
    ]
    pairs = [(numbers[arrows[n].source], numbers[arrows[n].target]) for n in own]
    layers = make_layers([_FIRST_COLUMN[boxes[box].kind] for box in members], pairs)
    places = find_places(layers, [widths[box] for box in members])
    return _Part(members, own, layers, *places)


def _pack(parts: Sequence[_Part]) -> tuple[list[tuple[float, float]], float, float]:
    """Put parts beside and below each other; returns their corners and the size of the whole."""
    area = sum((part.width + _APART) * (part.height + _APART) for part in parts)
    widest = max([math.sqrt(_SHAPE * area), *(part.width for part in parts)], default=0.0)
    corners: list[tuple[float, float]] = []
    x, y, below, width = _MARGIN, _MARGIN, 0.0, 0.0
    for part in parts:
        if x > _MARGIN and x + part.width > _MARGIN + widest:
            x, y, below = _MARGIN, y + below + _APART - GAP, 0.0
        corners.append((x, y))
        x += part.width + _APART
        below = max(below, part.height)
        width = max(width, x)
    return corners, width - _APART + _MARGIN if parts else 0.0, y + below + _MARGIN


def _knots(
    part: _Part, arrows: Sequence[Arrow], widths: Sequence[float]
) -> list[tuple[int, list[tuple[float, float]]]]:
    """Return the points that each arrow passes, from its source to its target."""
    numbers = {box: n for n, box in enumerate(part.members)}
    found = []
    for index, joints, step in zip(part.arrows, part.layers.joints, part.layers.steps, strict=True):
        source, target = numbers[arrows[index].source], numbers[arrows[index].target]
        if not step:
            continue  # it is drawn beside the column
        start, end = (source, target) if step > 0 else (target, source)
        knots = _leaving(part.places[start], widths[start])
        for joint in joints:
            place = part.places[joint]
            knots += [(place.left, place.y), (place.right, place.y)]
        knots += _arriving(part.places[end])
        found.append((index, knots if step > 0 else knots[::-1]))
    return found


def _leaving(place: Place, width: float) -> list[tuple[float, float]]:
    """Return the points from a box to where arrows leave its column, past boxes beside it."""
    end = place.x + width
    if place.right <= end:
        return [(end, place.y)]
    aisle = place.y + BOX_HEIGHT / 2 + _AISLE
    return [(end, place.y), (end + 3 * _AISLE, aisle), (place.right, aisle)]


def _arriving(place: Place) -> list[tuple[float, float]]:
    """Return the points from where arrows enter a column to a box, past boxes beside it."""
    if place.left >= place.x:
        return [(place.x, place.y)]
    aisle = place.y - BOX_HEIGHT / 2 - _AISLE
    return [(place.left, aisle), (place.x - 4 * _AISLE, aisle), (place.x, place.y)]


def _way(knots: Sequence[tuple[float, float]]) -> Way:
    """Return a curve that is level at each knot, with a head at the last one."""
    (x, y), *rest = knots
    parts = [f"M{x:.0f} {y:.0f}"]
    before = (x, y)
    for x, y in rest:
        middle = (before[0] + x) / 2
        is_level = abs(y - before[1]) < 0.5
        bend = "" if is_level else f"{middle:.0f} {before[1]:.0f} {middle:.0f} {y:.0f} "
        parts.append(f"{'L' if is_level else 'C'}{bend}{x:.0f} {y:.0f}")
        last, before = before, (x, y)
    length, half = _HEAD
    back = x - math.copysign(length, x - last[0])
    parts.append(f"M{back:.0f} {y - half:.0f}L{x:.0f} {y:.0f}L{back:.0f} {y + half:.0f}")
    return Way("".join(parts), (last[0] + x) / 2, (last[1] + y) / 2)


def _beside(source: PlacedBox, target: PlacedBox) -> Way:
    """Return the way between two boxes of a column, which leaves and arrives at the right."""
    x, y = source.x + source.width, source.y + source.height / 2
    to_x, to_y = target.x + target.width, target.y + target.height / 2
    out = max(x, to_x) + min(24.0 + abs(to_y - y) / 6, 60.0)
    length, half = _HEAD
    path = f"M{x:.0f} {y:.0f}C{out:.0f} {y:.0f} {out:.0f} {to_y:.0f} {to_x:.0f} {to_y:.0f}"
    back = to_x + length
    head = f"M{back:.0f} {to_y - half:.0f}L{to_x:.0f} {to_y:.0f}L{back:.0f} {to_y + half:.0f}"
    return Way(path + head, (x + to_x + 6 * out) / 8, (y + to_y) / 2)


def _loop(box: PlacedBox) -> Way:
    """Return the way from a box to itself, below it."""
    middle, base = box.x + box.width / 2, box.y + box.height
    left, right, low = middle - 14, middle + 14, base + GAP
    path = (
        f"M{right:.0f} {base:.0f}C{right:.0f} {low:.0f} {left:.0f} {low:.0f} {left:.0f} {base:.0f}"
    )
    head = f"M{left - 4:.0f} {base + 7:.0f}L{left:.0f} {base:.0f}L{left + 4:.0f} {base + 7:.0f}"
    return Way(path + head, middle, low)
