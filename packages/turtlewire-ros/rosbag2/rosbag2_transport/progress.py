"""One line on a terminal that shows the progress of a recording or playback."""

from __future__ import annotations

import os
import sys
import threading
from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from typing_extensions import Self

_REDRAW_SECONDS = 0.5
_FASTEST_HZ = 30
_COLUMNS = 80


class ProgressLine:
    """Draws the line on stderr while it is a terminal; a context manager.

    The cursor rests at the line's beginning, so that a line of the log replaces it.

    Args:
        text: Returns the line, or an empty string.
        rate: How often it is drawn [Hz]: 0 for never, negative for as often as a terminal shows;
            None for every half second.
    """

    def __init__(self, text: Callable[[], str], rate: float | None = None) -> None:
        self._text = text
        self._is_drawn = rate != 0
        self._seconds = _REDRAW_SECONDS
        if rate is not None:
            self._seconds = 1 / (min(rate, _FASTEST_HZ) if rate > 0 else _FASTEST_HZ)
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._draw, name="progress", daemon=True)

    def __enter__(self) -> Self:
        if self._is_drawn and sys.stderr is not None and sys.stderr.isatty():
            self._thread.start()
        return self

    def __exit__(self, *_error: object) -> None:
        self._ended.set()
        if self._thread.is_alive():
            self._thread.join()
            self._print("")

    def _draw(self) -> None:
        while not self._ended.wait(self._seconds):
            columns = os.get_terminal_size(sys.stderr.fileno()).columns or _COLUMNS
            self._print(self._text()[: columns - 1])  # a line that wraps could not be replaced

    def _print(self, text: str) -> None:
        print(f"\r{text}\033[K\r", end="", file=sys.stderr, flush=True)  # noqa: T201


def time_text(seconds: float) -> str:
    """Format a time as ``1:02:03.4``, without hours below an hour."""
    minutes, rest = divmod(max(0.0, seconds), 60)
    hours, minutes = divmod(int(minutes), 60)
    return f"{hours}:{minutes:02d}:{rest:04.1f}" if hours else f"{minutes}:{rest:04.1f}"
