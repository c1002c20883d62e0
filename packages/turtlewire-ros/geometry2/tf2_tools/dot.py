"""The tree of frames as Graphviz text, as ROS 2's view_frames writes it."""

from __future__ import annotations

from typing import Any

from turtlewire.tf.frame_tree import FrameLink, FrameTree


def dot_from_tree(tree: FrameTree, recorded_time: str) -> str:
    """Return Graphviz text with a link for each frame, and a legend with the recording's time."""
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


def generate_dot(data: dict[str, Any], recorded_time: float | str) -> str:
    """Return Graphviz text of an answer of the service ``tf2_frames``.

    Args:
        data: Its YAML, loaded: of each frame, by its name, the parent and the rates.
        recorded_time: When it was asked, for the legend.
    """
    links = [
        FrameLink(
            child=str(child),
            parent=frame["parent"],
            broadcaster=frame["broadcaster"],
            is_static=False,
            rate_hz=frame["rate"],
            newest=frame["most_recent_transform"],
            oldest=frame["oldest_transform"],
            length=frame["buffer_length"],
        )
        for child, frame in data.items()
    ]
    return dot_from_tree(FrameTree(links), str(recorded_time))


def _link(link: FrameLink) -> str:
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
