"""The graph as a file: SVG, Graphviz or JSON."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from turtlewire.tf import svg
from turtlewire.wire.qos import INFINITE_NS, History
from turtlewire_view.graph.layout import TEXT_SIZE, make_diagram, make_layout
from turtlewire_view.graph.picture import UNKNOWN, select

if TYPE_CHECKING:
    from turtlewire.wire.qos import QoS
    from turtlewire_view.graph.layout import Arrow, Layout
    from turtlewire_view.graph.picture import Picture, Selection

__all__ = ["as_data", "as_dot", "as_json", "as_svg", "words_of", "writer_for"]

_VERSION = 1
_INK, _NODE, _TOPIC, _ARROW, _BAD = "#1b2238", "#4556ff", "#76819f", "#8a94b0", "#c2334d"
_NODE_FILL, _TOPIC_FILL, _GROUND = "#eceeff", "#ffffff", "#ffffff"
_SMALL = 11.0


def writer_for(path: str) -> Callable[[Picture, Selection], str]:
    """Return the function that makes the text of a file.

    Raises:
        ValueError: The suffix of the path is not that of a format.
    """
    writers: dict[str, Callable[[Picture, Selection], str]] = {
        ".svg": as_svg,
        ".dot": as_dot,
        ".json": as_json,
    }
    writer = writers.get(os.path.splitext(path)[1].lower())
    if writer is None:
        raise ValueError(
            f"{path} does not end in .svg, .dot or .json: the graph is written as these"
        )
    return writer


def as_data(picture: Picture, selection: Selection) -> dict[str, Any]:
    """Return what is shown of a picture, for ``json.dumps``."""
    shown = select(picture, selection)
    return {
        "version": _VERSION,
        "domain_id": shown.domain_id,
        "nodes": [{"node": name, "count": n} for name, n in shown.nodes.items() if name != UNKNOWN],
        "topics": [{"topic": name, "types": types} for name, types in shown.topics.items()],
        "endpoints": [
            {
                "kind": info.kind,
                "topic": info.topic,
                "node": _known(node),
                "type": info.type_name,
                "qos": _qos(info.qos),
            }
            for node, info in shown.endpoints
        ],
        "mismatches": [
            {
                "topic": each.topic,
                "policy": each.policy,
                "reason": each.reason,
                "publishers": [_known(name) for name in each.publishers],
                "subscriptions": [_known(name) for name in each.subscriptions],
            }
            for each in shown.mismatches
        ],
    }


def as_json(picture: Picture, selection: Selection) -> str:
    """Return the content of a JSON file."""
    return json.dumps(as_data(picture, selection), indent=2) + "\n"


def as_dot(picture: Picture, selection: Selection) -> str:
    """Return Graphviz text: nodes as ellipses, topics as boxes, what does not connect in red."""
    shown = select(picture, selection)
    diagram = make_diagram(shown, with_topics=selection.topics != "none")
    lines = ["digraph graph_of_nodes {", "  rankdir=LR;", '  node [fontname="Helvetica"];']
    for index, box in enumerate(diagram.boxes):
        shape = "ellipse" if box.kind == "node" else "box"
        label = f"{_escaped(box.name)}\\n{_escaped(box.note)}" if box.note else _escaped(box.name)
        red = ", color=red" if box.note else ""
        lines.append(f'  b{index} [label="{label}", shape={shape}{red}];')
    for arrow in diagram.arrows:
        words = [] if selection.topics != "none" else list(arrow.topics)
        words += words_of(shown, arrow)
        label = "\\n".join(map(_escaped, words))
        looks = [f'label="{label}"'] if label else []
        looks += ["color=red", "fontcolor=red"] if arrow.mismatches else []
        lines.append(f"  b{arrow.source} -> b{arrow.target} [{', '.join(looks)}];")
    return "\n".join([*lines, "}\n"])


def as_svg(picture: Picture, selection: Selection) -> str:
    """Return an SVG document with the layout of the page."""
    shown = select(picture, selection)
    diagram = make_diagram(shown, with_topics=selection.topics != "none")
    layout = make_layout(diagram)
    ground = svg.rectangle(0, 0, layout.width, layout.height, f' fill="{_GROUND}"')
    parts = [ground]
    ways = sorted(  # red ones above the others
        zip(diagram.arrows, layout.ways, strict=True), key=lambda pair: bool(pair[0].mismatches)
    )
    for arrow, way in ways:
        reasons = (shown.mismatches[index].reason for index in arrow.mismatches)
        title = "; ".join([", ".join(arrow.topics), *reasons])
        colour, width = (_BAD, 2.0) if arrow.mismatches else (_ARROW, 1.2)
        parts.append(svg.path(way.path, colour, width, title=title))
    parts += _boxes(layout, [(box.kind, bool(box.note)) for box in diagram.boxes])
    kinds = [box.kind for box in diagram.boxes]
    for arrow, way in ways:
        if arrow.mismatches and kinds[arrow.target] == "node":
            text = ", ".join(words_of(shown, arrow))
            style = ' text-anchor="middle" stroke="#ffffff" stroke-width="3" paint-order="stroke"'
            parts.append(svg.text(way.x, way.y - 5, text, _SMALL, _BAD, style))
    return svg.document(layout.width, layout.height, parts)


def words_of(picture: Picture, arrow: Arrow) -> list[str]:
    """Return the policies that keep the ends of an arrow apart."""
    return sorted({picture.mismatches[index].policy for index in arrow.mismatches})


def _boxes(layout: Layout, looks: list[tuple[str, bool]]) -> list[str]:
    parts = []
    for (x, y, width, height, label), (kind, is_odd) in zip(layout.boxes, looks, strict=True):
        radius = height / 2 if kind == "node" else 3
        fill, edge = (_NODE_FILL, _NODE) if kind == "node" else (_TOPIC_FILL, _TOPIC)
        edge = _BAD if is_odd else edge
        style = f' rx="{radius:g}" fill="{fill}" stroke="{edge}"'
        parts.append(svg.rectangle(x, y, width, height, style))
        middle, base = x + width / 2, y + height / 2 + TEXT_SIZE * 0.36
        parts.append(svg.text(middle, base, label, TEXT_SIZE, _INK, ' text-anchor="middle"'))
    return parts


def _known(node: str) -> str | None:
    return None if node == UNKNOWN else node


def _qos(qos: QoS) -> dict[str, Any]:
    """Return the policies with the keys of ``ros2 topic info -v --json``."""
    return {
        "reliability": qos.reliability.name.lower(),
        "history": qos.history.name.lower(),
        "depth": qos.depth if qos.history == History.KEEP_LAST else None,
        "durability": qos.durability.name.lower(),
        "lifespan_ns": _duration(qos.lifespan_ns),
        "deadline_ns": _duration(qos.deadline_ns),
        "liveliness": qos.liveliness.name.lower(),
        "liveliness_lease_duration_ns": _duration(qos.liveliness_lease_ns),
    }


def _duration(nanoseconds: int) -> int | None:
    return None if nanoseconds >= INFINITE_NS else nanoseconds


def _escaped(text: str) -> str:
    return text.replace("\\", "\\\\").replace('"', '\\"')
