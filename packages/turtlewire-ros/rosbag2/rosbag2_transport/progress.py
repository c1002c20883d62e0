"""One line on a terminal that shows the progress of a recording or playback."""

from __future__ import annotations

import os
import sys
import threading
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import TracebackType

    from typing_extensions import Self

__all__ = ["ProgressLine", "bytes_text", "time_text"]

_REDRAW_SECONDS = 0.5
_COLUMNS = 80
_UNITS = ("B", "KiB", "MiB", "GiB", "TiB")


class ProgressLine:
    """Draws the line on stderr while it is a terminal; a context manager.

    The cursor rests at the line's beginning, so that a line of the log replaces it.

    Args:
        text: Returns the line, or an empty string.
    """

    def __init__(self, text: Callable[[], str]) -> None:
        self._text = text
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._draw, name="progress", daemon=True)

    def __enter__(self) -> Self:
        if sys.stderr is not None and sys.stderr.isatty():
            self._thread.start()
        return self

    def __exit__(
        self,
        _type: type[BaseException] | None,
        _error: BaseException | None,
        _traceback: TracebackType | None,
    ) -> None:
        self._ended.set()
        if self._thread.is_alive():
            self._thread.join()
            self._print("")

    def _draw(self) -> None:
        while not self._ended.wait(_REDRAW_SECONDS):
            columns = os.get_terminal_size(sys.stderr.fileno()).columns or _COLUMNS
            self._print(self._text()[: columns - 1])  # a line that wraps could not be replaced

    def _print(self, text: str) -> None:
        print(f"\r{text}\033[K\r", end="", file=sys.stderr, flush=True)  # noqa: T201


def time_text(seconds: float) -> str:
    """``1:02:03.4``; without hours below an hour."""
    minutes, rest = divmod(max(0.0, seconds), 60)
    hours, minutes = divmod(int(minutes), 60)
    return f"{hours}:{minutes:02d}:{rest:04.1f}" if hours else f"{minutes}:{rest:04.1f}"


def bytes_text(count: int) -> str:
    """``12.3 MiB``."""
    size, unit = float(count), 0
    while size >= 1024 and unit < len(_UNITS) - 1:
        size /= 1024
        unit += 1
    return f"{size:.1f} {_UNITS[unit]}" if unit else f"{count} B"
