"""A PDF file of one page, with fonts that every reader has."""

from __future__ import annotations

import zlib

__all__ = ["colour_operands", "pdf_file", "text_operators"]

#: Readers refuse pages with a longer side [points].
_LONGEST_SIDE = 14_400.0


def pdf_file(width: float, height: float, operators: list[str]) -> bytes:
    """Return a page with these drawing operators; one that is too large for PDF is scaled down.

    Args:
        width: Width of the page in points.
        height: Height of the page; PDF counts y upwards from its bottom.
        operators: What is drawn. The fonts are ``/F1`` and, bold, ``/F2``.
    """
    scale = min(1.0, _LONGEST_SIDE / max(width, height))
    page = "\n".join([f"{scale:.6f} 0 0 {scale:.6f} 0 0 cm", *operators])
    content = zlib.compress(page.encode("ascii"))
    font = b"<< /Type /Font /Subtype /Type1 /BaseFont /%s /Encoding /WinAnsiEncoding >>"
    return _file(
        [
            b"<< /Type /Catalog /Pages 2 0 R >>",
            b"<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
            b"<< /Type /Page /Parent 2 0 R /MediaBox [0 0 %.2f %.2f] /Contents 4 0 R "
            b"/Resources << /Font << /F1 5 0 R /F2 6 0 R >> >> >>"
            % (width * scale, height * scale),
            b"<< /Length %d /Filter /FlateDecode >>\nstream\n%s\nendstream"
            % (len(content), content),
            font % b"Helvetica",
            font % b"Helvetica-Bold",
        ]
    )


def text_operators(text: str, size: float, colour: str, place: str, *, bold: bool = False) -> str:
    r"""Return the operators of a line of text.

    Letters outside the fonts are written as escapes, ``\u732b`` for example.

    Args:
        text: The text.
        size: Its size in points.
        colour: ``#rrggbb``.
        place: The operator that moves to its begin, ``10 20 Td`` for example.
        bold: Whether it is bold.
    """
    letters = text.encode("cp1252", "backslashreplace").hex()
    font = "/F2" if bold else "/F1"
    return f"BT {colour_operands(colour)} rg {font} {size:g} Tf {place} <{letters}> Tj ET"


def colour_operands(colour: str, opacity: float = 1.0) -> str:
    """Return red, green and blue from 0 to 1 of ``#rrggbb``, as it looks on white."""
    parts = (int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5))
    return " ".join(f"{1 - opacity * (1 - part):.3f}" for part in parts)


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
