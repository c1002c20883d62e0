"""Writes a drawing as a PDF file of one page, with fonts that every reader has."""

from __future__ import annotations

import zlib
from typing import TYPE_CHECKING

from turtlewire.tf.drawing import Box, Line

if TYPE_CHECKING:
    from turtlewire.tf.drawing import Drawing, Shape, Text

__all__ = ["pdf_from_drawing"]

#: Readers refuse pages with a longer side [points].
_LONGEST_SIDE = 14_400.0


def pdf_from_drawing(drawing: Drawing) -> bytes:
    r"""A page of the size of the drawing; one that is too large for PDF is scaled down.

    Letters that the fonts lack are written as escapes, ``\u732b`` for example.
    """
    scale = min(1.0, _LONGEST_SIDE / max(drawing.width, drawing.height))
    width, height = drawing.width * scale, drawing.height * scale
    page = "\n".join(
        [
            f"{scale:.6f} 0 0 {scale:.6f} 0 0 cm",
            *(_operators(shape, drawing.height) for shape in drawing.shapes),
        ]
    )
    content = zlib.compress(page.encode("ascii"))
    font = b"<< /Type /Font /Subtype /Type1 /BaseFont /%s /Encoding /WinAnsiEncoding >>"
    return _file(
        [
            b"<< /Type /Catalog /Pages 2 0 R >>",
            b"<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
            b"<< /Type /Page /Parent 2 0 R /MediaBox [0 0 %.2f %.2f] /Contents 4 0 R "
            b"/Resources << /Font << /F1 5 0 R /F2 6 0 R >> >> >>" % (width, height),
            b"<< /Length %d /Filter /FlateDecode >>\nstream\n%s\nendstream"
            % (len(content), content),
            font % b"Helvetica",
            font % b"Helvetica-Bold",
        ]
    )


def _file(objects: list[bytes]) -> bytes:
    data = b"%PDF-1.4\n%\xe2\xe3\xcf\xd3\n"
    offsets = []
    for number, body in enumerate(objects, 1):
        offsets.append(len(data))
        data += b"%d 0 obj\n%s\nendobj\n" % (number, body)
    table = b"".join(b"%010d 00000 n \n" % offset for offset in offsets)
    size = len(objects) + 1
    trailer = b"trailer\n<< /Size %d /Root 1 0 R >>\nstartxref\n%d\n%%%%EOF\n" % (size, len(data))
    return data + b"xref\n0 %d\n0000000000 65535 f \n" % size + table + trailer


def _operators(shape: Shape, height: float) -> str:
    """PDF counts y upwards from the bottom of the page."""
    if isinstance(shape, Box):
        corner = f"{shape.x:.2f} {height - shape.y - shape.height:.2f}"
        size = f"{shape.width:.2f} {shape.height:.2f}"
        return f"1 1 1 rg {_colour(shape.colour)} RG 1 w {corner} {size} re B"
    if isinstance(shape, Line):
        points = [f"{x:.2f} {height - y:.2f}" for x, y in shape.points]
        dashes = "[5 3] 0 d" if shape.dashed else "[] 0 d"
        path = f"{points[0]} m {' l '.join(points[1:])} l"
        return f"{_colour(shape.colour)} RG {shape.width:g} w {dashes} {path} S [] 0 d"
    return _text(shape, height)


def _text(shape: Text, height: float) -> str:
    letters = shape.text.encode("cp1252", "backslashreplace").hex()
    font = "/F2" if shape.bold else "/F1"
    place = f"{shape.x:.2f} {height - shape.y:.2f}"
    colour = f"{_colour(shape.colour)} rg"
    return f"BT {colour} {font} {shape.size:g} Tf {place} Td <{letters}> Tj ET"


def _colour(colour: str) -> str:
    return " ".join(f"{int(colour[i : i + 2], 16) / 255:.3f}" for i in (1, 3, 5))
