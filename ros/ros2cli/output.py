"""Output of the verbs: text from other processes must not control the terminal."""

from __future__ import annotations

import contextlib
import sys
from typing import TYPE_CHECKING, Any

from turtlewire.printable import printable_lines

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["escaped_output", "tell"]


def tell(text: str) -> None:
    """Print a message to stderr; what peers have put into it is escaped."""
    print(printable_lines(text), file=sys.stderr)


class _EscapingStream:
    """A text stream that escapes control characters other than line feeds and tabs."""

    def __init__(self, stream: Any) -> None:
        self._stream = stream

    def write(self, text: str) -> int:
        """Write the escaped text; returns the length of ``text``."""
        self._stream.write(printable_lines(text))
        return len(text)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)


@contextlib.contextmanager
def escaped_output() -> Iterator[None]:
    """Escape stdout within this context: names, strings and log lines may come from any peer."""
    stream = sys.stdout
    if stream is None:
        yield
        return
    escaping = _EscapingStream(stream)
    sys.stdout = escaping
    try:
        yield
    finally:
        if sys.stdout is escaping:  # a broken pipe has left None there
            sys.stdout = stream
