"""Ends a program quietly when the reader of its output, such as ``head``, has closed the pipe."""

from __future__ import annotations

import os
import sys

__all__ = ["READER_GONE", "leave_pipe"]

#: The exit status that a shell shows for a program that wrote into a closed pipe.
READER_GONE = 141


def leave_pipe() -> int:
    """Call it after a ``BrokenPipeError``; returns the exit status.

    Python would write the rest of its buffer at exit, and fail again.
    """
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return READER_GONE
