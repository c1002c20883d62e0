"""Where in a launch file an error was raised."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["MODULE_NAME", "raised_in"]

#: Name under which Python launch files are run.
MODULE_NAME = "python_launch_file"


def raised_in(error: BaseException) -> str:
    """A line that names file and line, to be put behind a message.

    Args:
        error: What a launch file raised, or what reading it raised.

    Returns:
        A line break and ``raised in <file>:<line>``: the innermost line of a Python launch file, or
        the element of one in another language; empty when neither was on the way.
    """
    for one in _errors(error):
        found = f"\n  raised in {one.launch_file_line}" if hasattr(one, "launch_file_line") else ""
        trace = one.__traceback__
        while trace is not None:
            if trace.tb_frame.f_globals.get("__name__") == MODULE_NAME:
                found = f"\n  raised in {trace.tb_frame.f_code.co_filename}:{trace.tb_lineno}"
            trace = trace.tb_next
        if found:
            return found
    return ""


def _errors(error: BaseException) -> Iterator[BaseException]:
    """The error, and the first of those that the loaders of a launch file had."""
    yield error
    yield from getattr(error, "likely_errors", ())[:1]
