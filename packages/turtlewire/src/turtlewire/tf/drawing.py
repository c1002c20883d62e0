"""Boxes, lines and text on a page, and the SVG of them. Lengths are points, y grows downwards."""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

from turtlewire.tf import svg

__all__ = [
    "BROWSER_FONTS",
    "Drawing",
    "FilledBox",
    "Line",
    "Shape",
    "Text",
    "svg_from_drawing",
    "text_width",
]

#: The width of DejaVu Sans, which browsers use if Helvetica is missing, relative to `text_width`.
BROWSER_FONTS = 1.16

_ASCII_WIDTHS = (
    "278 278 355 556 556 889 667 191 333 333 389 584 278 333 278 278 "
    "556 556 556 556 556 556 556 556 556 556 278 278 584 584 584 556 "
    "1015 667 667 722 722 667 611 778 722 278 500 667 556 833 722 778 "
    "667 778 722 667 611 722 667 944 667 667 611 278 278 278 469 556 "
    "333 556 556 500 556 556 278 556 556 222 222 500 222 833 556 556 "
    "556 556 333 500 278 556 500 722 500 500 500 334 260 334 584"
)
#: Of Helvetica and its like, in thousandths of the size, from the space on.
_WIDTHS = tuple(map(int, _ASCII_WIDTHS.split()))
_WIDE = 1000
_BOLD = 1.08


class FilledBox(NamedTuple):
    """A rectangle with a coloured border, filled with white."""

    x: float
    y: float
    width: float
    height: float
    colour: str


class Line(NamedTuple):
    """A line through some points."""

    points: tuple[tuple[float, float], ...]
    colour: str
    width: float = 1.0
    dashed: bool = False


class Text(NamedTuple):
    """One line of text that begins at a point of its baseline."""

    x: float
    y: float
    text: str
    size: float
    colour: str
    bold: bool = False


Shape: TypeAlias = "FilledBox | Line | Text"


class Drawing(NamedTuple):
    """A page; colours are ``#rrggbb``. Later shapes cover earlier ones."""

    width: float
    height: float
    shapes: tuple[Shape, ...]


def text_width(text: str, size: float, *, bold: bool = False) -> float:
    """Return the width of a line of text, a lower estimate for any sans-serif font."""
    thousandths = sum(
        _WIDTHS[ord(letter) - 32] if " " <= letter <= "~" else _WIDE for letter in text
    )
    return thousandths * size / 1000 * (_BOLD if bold else 1.0)


def svg_from_drawing(drawing: Drawing) -> str:
    """Return the drawing as a complete SVG document, which a page can include unchanged."""
    return svg.document(drawing.width, drawing.height, map(_element, drawing.shapes))


def _element(shape: Shape) -> str:
    if isinstance(shape, FilledBox):
        style = f' rx="4" fill="#ffffff" stroke="{shape.colour}"'
        return svg.rectangle(shape.x, shape.y, shape.width, shape.height, style)
    if isinstance(shape, Line):
        dashes = ' stroke-dasharray="5 3"' if shape.dashed else ""
        return svg.polyline(shape.points, shape.colour, shape.width, dashes)
    weight = ' font-weight="bold"' if shape.bold else ""
    return svg.text(shape.x, shape.y, shape.text, shape.size, shape.colour, weight)
