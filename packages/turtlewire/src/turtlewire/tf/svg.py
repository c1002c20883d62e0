"""Elements of SVG documents as text. Lengths are pixels, y grows downwards."""

from __future__ import annotations

import re
from collections.abc import Iterable
from xml.sax.saxutils import escape

__all__ = ["circle", "document", "line", "path", "polyline", "rectangle", "text"]

_NOT_IN_XML = re.compile("[^\t\n\r -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def document(width: float, height: float, elements: Iterable[str]) -> str:
    """Return a complete SVG document, which a page can include unchanged."""
    opening = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{height:.0f}" '
        f'viewBox="0 0 {width:.0f} {height:.0f}" '
        'style="max-width:100%;height:auto" font-family="Helvetica, Arial, sans-serif">'
    )
    return "\n".join([opening, *elements, "</svg>\n"])


# `style` is further attributes, each with a space before it.


def rectangle(x: float, y: float, width: float, height: float, style: str) -> str:
    """Return a rectangle."""
    return f'<rect x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}"{style}/>'


def line(x1: float, y1: float, x2: float, y2: float, colour: str, width: float) -> str:
    """Return a line between two points."""
    return (
        f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{colour}" '
        f'stroke-width="{width:g}"/>'
    )


def polyline(
    points: Iterable[tuple[float, float]], colour: str, width: float, style: str = ""
) -> str:
    """Return a line through points."""
    corners = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    return (
        f'<polyline points="{corners}" fill="none" stroke="{colour}" '
        f'stroke-width="{width:g}"{style}/>'
    )


def path(way: str, colour: str, width: float, *, title: str = "") -> str:
    """Return a line along a way in SVG's notation, with a title that browsers show beside it."""
    tip = f"<title>{_escaped(title)}</title>" if title else ""
    return f'<path d="{way}" fill="none" stroke="{colour}" stroke-width="{width:g}">{tip}</path>'


def circle(x: float, y: float, radius: float, style: str) -> str:
    """Return a circle."""
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius:g}"{style}/>'


def text(x: float, y: float, content: str, size: float, colour: str, style: str = "") -> str:
    """Return one line of text; characters that XML forbids are replaced."""
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size:g}" fill="{colour}"{style}>'
        f"{_escaped(content)}</text>"
    )


def _escaped(content: str) -> str:
    return escape(_NOT_IN_XML.sub("\N{REPLACEMENT CHARACTER}", content))
