"""A line on the terminal that shows the progress of an operation."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable

__all__ = ["progress_line"]

_QUIET_SECONDS = 1.0
_REDRAW_SECONDS = 0.1
_WIDTH = 30


def progress_line(what: str) -> Callable[[float], None]:
    """Return a function that is called with the share that is done, from 0 to 1.

    On a terminal it draws a bar with the time that is left, once a second has passed, and removes
    it at the end (1). Elsewhere it does nothing.
    """
    started = time.monotonic()
    shown = 0.0

    def tell(share: float) -> None:
        nonlocal shown
        now = time.monotonic()
        if share >= 1.0 and shown:
            _draw("")
        elif now - started > _QUIET_SECONDS and now - shown > _REDRAW_SECONDS:
            shown = now
            bar = "#" * int(_WIDTH * share)
            left = (now - started) * (1.0 - share) / share if share > 0.0 else 0.0
            _draw(f"{what} [{bar:-<{_WIDTH}}] {share:4.0%}, {left:.0f} s left")

    return tell if sys.stderr.isatty() else lambda _share: None


def _draw(text: str) -> None:
    print(f"\r{text}\033[K", end="", file=sys.stderr, flush=True)  # noqa: T201
