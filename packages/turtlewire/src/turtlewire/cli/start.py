# PYTHON_ARGCOMPLETE_OK
"""Starts the ``turtlewire`` command, so that Ctrl-C during its imports shows no traceback."""

from __future__ import annotations

import os
import signal

_INTERRUPTED = 130


def main() -> int | str:
    """Run the command line of this process, and return what ``sys.exit`` takes."""
    former = signal.getsignal(signal.SIGINT)
    if former is signal.default_int_handler:  # not if the parent ignores SIGINT
        signal.signal(signal.SIGINT, _end)
    from turtlewire.cli.main import main as run

    try:
        signal.signal(signal.SIGINT, former)
        return run()
    except KeyboardInterrupt:  # before `run` handles it
        return _INTERRUPTED


def _end(*_: object) -> None:
    """End at once: Python drops an exception that comes at the end of an import."""
    os._exit(_INTERRUPTED)
