"""The tree of a buffer as text."""

from __future__ import annotations

from typing import TYPE_CHECKING

from turtlewire.terminal.printable import printable
from turtlewire.tf.links import links

if TYPE_CHECKING:
    from turtlewire.tf.links import HasLinks

__all__ = ["text_tree"]


def text_tree(buffer: HasLinks) -> str:
    """Return one line for each frame, indented below its parent; frames of a loop come last."""
    parents = {link.child_frame: link.parent_frame for link in links(buffer)}
    children: dict[str, list[str]] = {}
    for child, parent in parents.items():
        children.setdefault(parent, []).append(child)
    lines: list[str] = []
    seen: set[str] = set()
    frames = buffer.frames()
    for root in [*(frame for frame in frames if frame not in parents), *frames]:
        waiting = [(root, 0)]
        while waiting:
            frame, depth = waiting.pop()
            if frame in seen:
                continue
            seen.add(frame)
            lines.append("  " * depth + printable(frame))
            waiting += [(child, depth + 1) for child in reversed(children.get(frame, []))]
    return "\n".join(lines)
