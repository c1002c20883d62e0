"""tf2's descriptions of the whole tree."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from turtlewire.tf.plain.failure import seconds

if TYPE_CHECKING:
    from turtlewire.tf.plain.link import LinkSamples


def _rate(link: LinkSamples) -> float:
    return link.length / max(seconds(link.newest - link.oldest), 0.0001)


def frames_as_string(links: Mapping[str, LinkSamples]) -> str:
    """tf2's list of frames and parents."""
    return "".join(
        f"Frame {child} exists with parent {link.parent}.\n" for child, link in links.items()
    )


def frames_as_yaml(links: Mapping[str, LinkSamples], now: float, *, empty: bool) -> str:
    """tf2's YAML; ``now`` in seconds adds the delay."""
    if empty:
        return "[]"
    text = []
    for child, link in links.items():
        if not link.has_data:
            continue
        text.append(
            f"{child}: \n  parent: '{link.parent}'\n  broadcaster: '{link.sender}'\n"
            f"  rate: {_rate(link):.3f}\n"
            f"  most_recent_transform: {seconds(link.newest):.6f}\n"
            f"  oldest_transform: {seconds(link.oldest):.6f}\n"
        )
        if now > 0.0:
            text.append(f"  transform_delay: {now - seconds(link.newest):.3f}\n")
        text.append(f"  buffer_length: {seconds(link.newest - link.oldest):.3f}\n")
    return "".join(text)


def frames_as_dot(frames: list[str], links: Mapping[str, LinkSamples], now: float) -> str:
    """tf2's Graphviz text; ``now`` in seconds adds ages."""
    text = ["digraph G {\n"]
    if not frames:
        text.append('"no tf data recieved"')
    for child, link in links.items():
        age = f"( {now - seconds(link.newest):.3f} sec old)" if now > 0.0 else ""
        text.append(
            f'"{link.parent}" -> "{child}"[label="Broadcaster: {link.sender}\\n'
            f"Average rate: {_rate(link):.3f} Hz\\n"
            f"Most recent transform: {seconds(link.newest):.6f} {age}\\n"
            f'Buffer length: {seconds(link.newest - link.oldest):.3f} sec\\n"];\n'
        )
    for frame in frames:
        if frame in links and links[frame].has_data:
            continue
        text.append(
            "edge [style=invis];\n subgraph cluster_legend { style=bold; color=black; "
            'label ="view_frames Result";\n'
        )
        if now > 0.0:
            text.append(f'"Recorded at time: {now:.6f}"[ shape=plaintext ] ;\n')
        text.append(f'}}->"{frame}";\n')
    text.append("}")
    return "".join(text)
