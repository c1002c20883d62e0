"""The boxes and arrows of a picture, before they have positions."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from turtlewire_view.graph.picture import Picture

__all__ = ["Arrow", "Box", "Diagram", "make_diagram"]


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
