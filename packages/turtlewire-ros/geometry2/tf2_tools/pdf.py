"""Writes a drawing as a PDF file of one page."""

from __future__ import annotations

from typing import TYPE_CHECKING

from turtlewire.tf.drawing import FilledBox, Line
from turtlewire.tf.pdf import colour_operands, pdf_file, text_operators

if TYPE_CHECKING:
    from turtlewire.tf.drawing import Drawing, Shape


def pdf_from_drawing(drawing: Drawing) -> bytes:
    """Return a page of the size of the drawing."""
    operators = [_operators(shape, drawing.height) for shape in drawing.shapes]
    return pdf_file(drawing.width, drawing.height, operators)


def _operators(shape: Shape, height: float) -> str:
    """PDF counts y upwards from the bottom of the page."""
    if isinstance(shape, FilledBox):
        corner = f"{shape.x:.2f} {height - shape.y - shape.height:.2f}"
        size = f"{shape.width:.2f} {shape.height:.2f}"
        return f"1 1 1 rg {colour_operands(shape.colour)} RG 1 w {corner} {size} re B"
    if isinstance(shape, Line):
        points = [f"{x:.2f} {height - y:.2f}" for x, y in shape.points]
        dashes = "[5 3] 0 d" if shape.dashed else "[] 0 d"
        path = f"{points[0]} m {' l '.join(points[1:])} l"
        return f"{colour_operands(shape.colour)} RG {shape.width:g} w {dashes} {path} S [] 0 d"
    place = f"{shape.x:.2f} {height - shape.y:.2f} Td"
    return text_operators(shape.text, shape.size, shape.colour, place, bold=shape.bold)
