"""Ends as other tools do when what reads the output, ``head`` for example, has seen enough."""

from __future__ import annotations

import os
import sys

__all__ = ["READER_GONE", "leave_pipe"]

#: The exit status that a shell shows for a program that wrote into a closed pipe.
READER_GONE = 141


def leave_pipe() -> int:
    """After a ``BrokenPipeError``: keep Python from writing the rest at its end; the exit status."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return READER_GONE
