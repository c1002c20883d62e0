"""Errors of the student's code: position, text and hint."""

from __future__ import annotations

import re
import traceback
from collections.abc import Collection
from typing import NamedTuple

from turtlewire.errors import TransformException

__all__ = ["Mistake", "ReportedMistake", "mistake_of"]

_ENDLESS = (
    "A callback must return, and main() must reach rclpy.spin: use a timer instead of a loop that "
    "waits."
)
_UNCAUGHT = "Catch TransformException: at the start, and now and then, TF has no answer."
#: Parts of error texts, and what helps.
_HINTS = (
    (r"expected ':'", "Lines with def, class, if, for, while, try and except end with a colon."),
    (r"was never closed", "A bracket that is opened here has no partner further down."),
    (r"unterminated string", "The text needs a quotation mark at its end."),
    (r"indent", "Lines of one block begin in the same column: four spaces for each level."),
    (
        r"NoneType' object has no attribute",
        "The object on the left is None: look where it is set.",
    ),
    (
        r"takes \d+ positional arguments? but \d+ (was|were) given",
        "A method's first parameter is `self`; callbacks of subscriptions also get a message.",
    ),
    (
        r"No module named",
        "The lesson has rclpy, tf2_ros, turtlesim and the messages. NumPy is not loaded here.",
    ),
    (
        r"recursion depth",
        "The function calls itself again and again: let it return before, or use a loop that ends.",
    ),
    (
        r"MemoryError|index-sized integer",
        "That is more than the memory of a tab: keep fewer or smaller objects.",
    ),
    (
        r"EOFError",
        "There is no keyboard input here: a node gets values from parameters and topics.",
    ),
    (r"start new thread", "A tab has one thread: use a timer instead, or a callback."),
    (r"does not support processes", "A tab runs no other programs."),
    (
        r"name '(\w+)' is not defined",
        "Import the name at the top of the file, or correct its spelling.",
    ),
)


class Mistake(NamedTuple):
    """An error in a file.

    Attributes:
        file: Name of the file; empty if no line of the student is to blame.
        line: Number of the line, from 1; 0 if unknown.
        text: What Python says.
        hint: What helps; may be empty.
    """

    file: str
    line: int
    text: str
    hint: str


class ReportedMistake(Exception):
    """A mistake that another process, in which the student's code runs, has described.

    Attributes:
        mistake: The description.
    """

    def __init__(self, mistake: Mistake) -> None:
        super().__init__(mistake.text)
        self.mistake = mistake


def mistake_of(error: BaseException, files: Collection[str]) -> Mistake:
    """Describe an error that came out of the student's files, or of what they called."""
    if isinstance(error, ReportedMistake):
        return error.mistake
    if isinstance(error, KeyboardInterrupt):
        file, line = _place(error, files)
        return Mistake(file, line, "Your code was stopped because it did not return.", _ENDLESS)
    told = traceback.TracebackException.from_exception(error)
    text = "".join(told.format_exception_only()).strip()
    if isinstance(error, SyntaxError):
        text = f"{type(error).__name__}: {error.msg}"
        file, line = error.filename or "", error.lineno or 0
    else:
        file, line = _place(error, files)
    known = (hint for pattern, hint in _HINTS if re.search(pattern, text))
    hint = str(getattr(error, "hint", "")) or next(known, "")
    # The hint is also a note of the error, but the text already ends with it.
    text = re.sub(r"^[\w.]+\.(\w+:)", r"\1", text).removesuffix(hint).strip()
    if isinstance(error, TransformException):
        hint = f"{_UNCAUGHT} {hint}".strip()
    return Mistake(file, line, text, hint)


def _place(error: BaseException, files: Collection[str]) -> tuple[str, int]:
    """Return the innermost line of the student's files."""
    place = ("", 0)
    for frame in traceback.extract_tb(error.__traceback__):
        if frame.filename in files:
            place = (frame.filename, frame.lineno or 0)
    return place
