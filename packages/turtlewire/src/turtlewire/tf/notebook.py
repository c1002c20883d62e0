"""The display of buffers and transforms in a notebook.

Tables have no colours of their own, so they are readable in light and dark notebooks.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from html import escape
from typing import TYPE_CHECKING

from turtlewire.geometry import conversions
from turtlewire.terminal.printable import printable
from turtlewire.tf.drawing import Drawing, Line, Shape, Text, svg_from_drawing, text_width
from turtlewire.tf.frame_tree import read_frame_tree
from turtlewire.tf.tree_drawing import draw_tree

if TYPE_CHECKING:
    from typing import Protocol

    import numpy as np
    from numpy.typing import NDArray

    from turtlewire.tf.arrays import HasPose
    from turtlewire.tf.links import HasLinks

    class Stamped(HasPose, Protocol):
        """A Transform of either core."""

        @property
        def target_frame(self) -> str:
            """The target."""
            ...

        @property
        def source_frame(self) -> str:
            """The source."""
            ...

        @property
        def stamp_ns(self) -> int | None:
            """Stamp of the pose."""
            ...


__all__ = [
    "MOST_ROWS",
    "buffer_svg",
    "html_table",
    "html_text",
    "projected",
    "transform_html",
]

#: A table of more rows is cut; the caller says so in the caption.
MOST_ROWS = 500
_LONGEST = 120


def html_text(text: str) -> str:
    """Return a name or sentence as HTML on one line: escaped, and cut if it is long.

    Names come from other processes and from files, so they may contain HTML and direction marks.
    """
    cut = text if len(text) <= _LONGEST else text[: _LONGEST - 1] + "…"
    return escape(printable(cut))


def html_table(
    title: str, caption: str, heads: Sequence[str], rows: Sequence[Sequence[str | int]]
) -> str:
    """Return a table that scrolls if it is long.

    Args:
        title: The bold beginning of the caption.
        caption: The rest of the caption.
        heads: The names of the columns.
        rows: The cells; numbers are aligned to the right.
    """
    first = rows[0] if rows else heads
    head = "".join(_cell("th", name, like) for name, like in zip(heads, first, strict=True))
    body = "".join(f"<tr>{''.join(_cell('td', each, each) for each in row)}</tr>" for row in rows)
    return (
        '<div style="max-height:32em;overflow:auto"><table>'
        '<caption style="text-align:left;white-space:nowrap">'
        f"<b>{html_text(title)}</b>{html_text(caption)}</caption>"
        f"<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>"
    )


def _cell(tag: str, content: str | int, like: str | int) -> str:
    """Return a cell that is aligned like another one of its column."""
    text = f"{content:,}" if isinstance(content, int) else html_text(content)
    side = "right" if isinstance(like, int) else "left"
    return f'<{tag} style="text-align:{side}">{text}</{tag}>'


#: A picture of more links is unreadable and takes a browser seconds to show.
_MOST_LINKS = 500
_AXIS_COLOURS = ("#d33f3f", "#3a9a3a", "#3f6fd3")
_SIDE = 190.0
_MARGIN = 34.0
#: Where one looks from: half from the left, half from behind, and from above.
_AZIMUTH, _ELEVATION = math.radians(-125.0), math.radians(28.0)


def buffer_svg(buffer: HasLinks) -> str:
    """The tree of a buffer as an SVG document; of a large tree only the links that came first."""
    tree = read_frame_tree(buffer, _MOST_LINKS)
    frames = len(buffer.frames())
    cut = frames > len(tree.children) and len(tree.links) == _MOST_LINKS
    title = [f"{frames:,} frames, the first {len(tree.children):,} of them shown"] if cut else []
    return svg_from_drawing(draw_tree(tree, title))


def transform_html(transform: Stamped) -> str:
    """A transform in numbers, and a picture of the axes of its two frames if they fit on a page."""
    target, source = escape(transform.target_frame), escape(transform.source_frame)
    roll, pitch, yaw = (
        f"{math.degrees(angle):.2f}"
        for angle in conversions.euler_from_quaternion(transform.rotation)
    )
    rows = {
        "x, y, z": ", ".join(f"{value:.4f}" for value in transform.translation) + " m",
        "distance": f"{math.hypot(*transform.translation):.4f} m",
        "roll, pitch, yaw": f"{roll}, {pitch}, {yaw} °",
        "quaternion x, y, z, w": ", ".join(f"{value:.5f}" for value in transform.rotation),
        "stamp": "none (static)" if transform.stamp_ns is None else f"{transform.stamp_ns} ns",
    }
    cells = "".join(f"<tr><th>{name}</th><td>{value}</td></tr>" for name, value in rows.items())
    picture = (
        svg_from_drawing(_axes_of_both(transform))
        if all(map(math.isfinite, transform.translation))
        else ""
    )
    return (
        '<div style="display:flex;align-items:center;gap:1em">'
        f"<table><caption>Where <b>{source}</b> is, seen from <b>{target}</b></caption>"
        f"{cells}</table>"
        f"{picture}</div>"
    )


def _axes_of_both(transform: Stamped) -> Drawing:
    target_from_source = conversions.matrix_from_pose((*transform.translation, *transform.rotation))
    length = 0.4 * math.hypot(*transform.translation) or 1.0
    frames = {
        transform.target_frame: _ends(conversions.matrix_from_pose((0, 0, 0, 0, 0, 0, 1)), length)
    }
    frames[transform.source_frame] = _ends(target_from_source, length)
    points = [point for ends in frames.values() for point in ends]
    left, top = (min(point[i] for point in points) for i in (0, 1))
    extent = max(max(point[i] for point in points) - start for i, start in ((0, left), (1, top)))
    scale = (_SIDE - 2 * _MARGIN) / extent

    def on_page(point: tuple[float, float]) -> tuple[float, float]:
        return _MARGIN + scale * (point[0] - left), _MARGIN + scale * (point[1] - top)

    shapes: list[Shape] = [
        Line(tuple(on_page(ends[0]) for ends in frames.values()), "#888888", dashed=True)
    ]
    taken = -_SIDE
    for name, (origin, *axes) in frames.items():
        x, y = on_page(origin)
        shapes += [
            Line(((x, y), on_page(end)), colour, 2.0)
            for end, colour in zip(axes, _AXIS_COLOURS, strict=True)
        ]
        label = name if len(name) <= 24 else name[:23] + "…"
        baseline = y + 14 if abs(y + 14 - taken) > 10 else taken + 11
        shapes.append(
            Text(
                min(max(2.0, x - text_width(label, 10) / 2), _SIDE - text_width(label, 10)),
                baseline,
                label,
                10,
                "#777777",
            )
        )
        taken = baseline
    return Drawing(_SIDE, _SIDE, tuple(shapes))


def _ends(matrix: NDArray[np.float64], length: float) -> list[tuple[float, float]]:
    """Return the origin and the tips of the axes of a frame as one sees them; y downwards."""
    points = matrix[:3, 3, None] + length * matrix[:3, [3, 0, 1, 2]] * (0, 1, 1, 1)
    right, down = projected(points)
    return list(zip(right.tolist(), down.tolist(), strict=True))


def projected(points: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return where one sees points (3, N) from above and behind: rightwards and downwards."""
    x, y, z = points
    towards = x * math.cos(_AZIMUTH) + y * math.sin(_AZIMUTH)
    right = y * math.cos(_AZIMUTH) - x * math.sin(_AZIMUTH)
    up = z * math.cos(_ELEVATION) - towards * math.sin(_ELEVATION)
    return right, -up
