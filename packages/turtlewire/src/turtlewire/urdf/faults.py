"""Errors of a URDF: urdfdom's texts, and the line and element that they are about."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from turtlewire.errors import UrdfError
from turtlewire.terminal.printable import printable

__all__ = ["XACRO_LEFT", "UrdfWarning", "left_out", "log_lines", "reported"]

#: The warning of a description in which elements of xacro are left.
XACRO_LEFT = (
    "The description has elements of xacro, which are ignored, and so are the links and joints that"
    " xacro makes of them. Expand it first: xacro FILE > robot.urdf"
)

_LONGEST = 1000


@dataclass(frozen=True, slots=True)
class UrdfWarning:
    """Something odd that urdfdom accepts.

    Attributes:
        text: urdfdom's text; ours where urdfdom is silent.
        line: The line of the element.
        element: The element.
        errors: All texts, if urdfdom logs them as errors and goes on without a part of a link.
    """

    text: str
    line: int
    element: str
    errors: tuple[str, ...] = ()

    @property
    def place(self) -> str:
        """Line and element, for example ``line 7 in <link name="arm">``."""
        return f"line {self.line} in {self.element}"


def left_out(error: UrdfError) -> UrdfWarning:
    """Return the warning for an element that urdfdom logs as an error and goes on without."""
    return UrdfWarning(str(error), error.line, error.element, tuple(error.reports))


def log_lines(fault: UrdfError | UrdfWarning) -> Iterator[str]:
    """Yield urdfdom's lines on stderr; line numbers are the description's, not the C++ code's."""
    if isinstance(fault, UrdfWarning) and not fault.errors:
        first, others = f"Warning: {_line(fault.text)}", []
    else:
        errors = fault.errors if isinstance(fault, UrdfWarning) else fault.reports
        first, *others = (f"Error:   {_line(text)}" for text in errors)
    yield first
    yield f"         at {_line(fault.place)}"
    yield from others


def _line(text: str) -> str:
    """Without what a terminal obeys; a name or number of the file may have any length."""
    return printable(text if len(text) <= _LONGEST else text[:_LONGEST] + "…")


@contextmanager
def reported(*texts: str) -> Iterator[None]:
    """Add what urdfdom logs after an error of the block, as it returns from its functions."""
    try:
        yield
    except UrdfError as error:
        error.reports += texts
        raise
