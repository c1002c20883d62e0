"""Finds the line of a launch file in which an error was raised."""

from __future__ import annotations

#: Name under which Python launch files are run.
MODULE_NAME = "python_launch_file"


def raised_in(error: BaseException) -> str:
    """Return a line that names file and line, to be put behind a message.

    Args:
        error: What a launch file raised, or what reading it raised.

    Returns:
        A line break and ``raised in <file>:<line>``: the innermost line of a Python launch file, or
        the element of a file in another language; empty if the error comes from no launch file.
    """
    # If several loaders failed, the first error is the most likely one, and knows its own line.
    for inner in getattr(error, "likely_errors", ())[:1]:
        if found := raised_in(inner):
            return found
    place = getattr(error, "launch_file_line", None)
    trace = error.__traceback__
    while trace is not None:
        if trace.tb_frame.f_globals.get("__name__") == MODULE_NAME:
            place = f"{trace.tb_frame.f_code.co_filename}:{trace.tb_lineno}"
        trace = trace.tb_next
    return "" if place is None else f"\n  raised in {place}"
