"""Charts as PDF and PNG: their SVG, element by element."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Callable
from typing import TYPE_CHECKING
from xml.etree import ElementTree as ET

import numpy as np

from turtlewire.tf.drawing import text_width
from turtlewire.tf.pdf import colour_operands, pdf_file, text_operators

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

    from numpy.typing import NDArray

__all__ = ["pdf_of", "png_of"]

_SVG = "{http://www.w3.org/2000/svg}"
#: Pixels of a PNG for each of the SVG: enough for a page of paper.
_SCALE = 3.0
#: How far the control points of a quarter of a circle of radius 1 lie from its ends.
_ARC = 0.5523


def pdf_of(svg: str) -> bytes:
    """Return the PDF of a chart."""
    root = ET.fromstring(svg)  # noqa: S314 - `chart` has written it
    width, height = float(root.attrib["width"]), float(root.attrib["height"])
    drawn = [_OPERATORS[element.tag.removeprefix(_SVG)](element, height) for element in root]
    return pdf_file(width, height, drawn)


def png_of(svg: str) -> bytes:
    """Return the PNG of a chart.

    Raises:
        ModuleNotFoundError: pypdfium2 is not installed.
    """
    try:
        import pypdfium2
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(
            "PNG needs the package pypdfium2: pip install 'turtlewire[png]', or pip install "
            "pypdfium2. SVG and PDF need nothing.",
            name="pypdfium2",
        ) from error
    with pypdfium2.PdfDocument(pdf_of(svg)) as document:
        bitmap = document[0].render(scale=_SCALE, rev_byteorder=True)
        return _png(np.ascontiguousarray(bitmap.to_numpy()[:, :, :3]))


def _png(pixels: NDArray[np.uint8]) -> bytes:
    """Return a PNG file of (height, width, 3) red, green and blue."""
    height, width, _ = pixels.shape
    rows = np.zeros((height, 1 + 3 * width), np.uint8)  # each row begins with its filter: none
    rows[:, 1:] = pixels.reshape(height, 3 * width)
    chunks = (
        (b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)),
        (b"IDAT", zlib.compress(rows.tobytes())),
        (b"IEND", b""),
    )
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        for kind, data in chunks
    )


def _number(element: Element, name: str, default: float = 0.0) -> float:
    return float(element.get(name, default))


def _rect(element: Element, height: float) -> str:
    x, y, width, tall = (_number(element, name) for name in ("x", "y", "width", "height"))
    box = f"{x:.2f} {height - y - tall:.2f} {width:.2f} {tall:.2f} re"
    fill, stroke = element.get("fill", "none"), element.get("stroke")
    if fill == "none":
        return f"{colour_operands(stroke or '#000000')} RG 1 w {box} S"
    return f"{colour_operands(fill, _number(element, 'opacity', 1.0))} rg {box} f"


def _line(element: Element, height: float) -> str:
    a, b, c, d = (_number(element, name) for name in ("x1", "y1", "x2", "y2"))
    return f"{_pen(element)} {a:.2f} {height - b:.2f} m {c:.2f} {height - d:.2f} l S"


def _polyline(element: Element, height: float) -> str:
    points = [point.split(",") for point in element.get("points", "").split()]
    placed = [f"{float(x):.2f} {height - float(y):.2f}" for x, y in points]
    if not placed:
        return ""
    dashes = f"[{element.get('stroke-dasharray', '')}] 0 d"
    path = " ".join([f"{placed[0]} m", *(f"{place} l" for place in placed[1:])])
    return f"{_pen(element)} {dashes} 1 j {path} S [] 0 d 0 j"


def _circle(element: Element, height: float) -> str:
    x, y, r = _number(element, "cx"), height - _number(element, "cy"), _number(element, "r")
    corner: list[tuple[float, ...]] = [(1, _ARC, _ARC, 1, 0, 1), (-_ARC, 1, -1, _ARC, -1, 0)]
    corner += [tuple(-part for part in quarter) for quarter in corner]
    arcs = [
        " ".join(f"{(x, y)[k % 2] + r * part:.2f}" for k, part in enumerate(quarter)) + " c"
        for quarter in corner
    ]
    fill = colour_operands(element.get("fill", "#ffffff"))
    return f"{fill} rg {_pen(element)} {x + r:.2f} {y:.2f} m {' '.join(arcs)} B"


def _text(element: Element, height: float) -> str:
    text, size = element.text or "", _number(element, "font-size")
    bold = element.get("font-weight") == "bold"
    x, y = _number(element, "x"), height - _number(element, "y")
    share = {"middle": 0.5, "end": 1.0}.get(element.get("text-anchor", "start"), 0.0)
    before = share * text_width(text, size, bold=bold)
    if element.get("transform"):  # the charts only rotate text to vertical
        place = f"0 1 -1 0 {x:.2f} {y - before:.2f} Tm"
    else:
        place = f"{x - before:.2f} {y:.2f} Td"
    return text_operators(text, size, element.get("fill", "#000000"), place, bold=bold)


def _pen(element: Element) -> str:
    colour = colour_operands(element.get("stroke", "#000000"), _number(element, "opacity", 1.0))
    return f"{colour} RG {_number(element, 'stroke-width', 1.0):g} w"


_OPERATORS: dict[str, Callable[[Element, float], str]] = {
    "rect": _rect,
    "line": _line,
    "polyline": _polyline,
    "circle": _circle,
    "text": _text,
}
