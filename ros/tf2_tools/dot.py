"""The tree of frames as Graphviz text, as ROS 2's view_frames writes it."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from turtlewire.tf.frame_tree import FrameTree, Link

__all__ = ["dot_from_tree"]


def dot_from_tree(tree: FrameTree, recorded_time: str) -> str:
    """Graphviz text with a link for each frame, and a legend with the time of the recording."""
    if not tree.links:
        return 'digraph G { "No tf data received" }'
    legend = [
        "edge [style=invis];",
        ' subgraph cluster_legend { style=bold; color=black; label ="view_frames Result";',
        f'"Recorded at time: {recorded_time}"[ shape=plaintext ] ;',
        f"}}->{_quoted(tree.roots[0])};",
        "}",
    ]
    return "\n".join(["digraph G {", *map(_link, tree.links.values()), *legend])


def _link(link: Link) -> str:
    fields = (
        f"Broadcaster: {_escaped(link.broadcaster)}",
        f"Average rate: {link.rate_hz:.3f}",
        f"Buffer length: {link.length:.3f}",
        f"Most recent transform: {link.newest:.6f}",
        f"Oldest transform: {link.oldest:.6f}",
    )
    label = "".join(f"{field}\\n" for field in fields)
    return f'{_quoted(link.parent)} -> {_quoted(link.child)}[label=" {label}"];'


def _quoted(name: str) -> str:
    return f'"{_escaped(name)}"'


def _escaped(text: str) -> str:
    return text.replace("\\", "\\\\").replace('"', '\\"')
