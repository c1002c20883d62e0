"""Splits the output of a process into lines."""

from __future__ import annotations

# A process that never ends its line must not fill the memory.
_LONGEST_REST = 1 << 20


class OutputLines:
    """Collects the bytes of one stream.

    Bytes that are not UTF-8 become replacement characters. A line of more than 1 MiB may come in
    pieces.
    """

    def __init__(self) -> None:
        self._rest = bytearray()

    def feed(self, data: bytes) -> list[str]:
        """Add bytes; returns the lines that they complete, without line ends."""
        first, *more = data.split(b"\n")
        self._rest += first
        if not more:
            return self.rest() if len(self._rest) > _LONGEST_REST else []
        lines = [bytes(self._rest), *more[:-1]]
        self._rest = bytearray(more[-1])
        return [_text(line) for line in lines]

    def rest(self) -> list[str]:
        """Return the beginning of an incomplete line; an empty list without one."""
        line, self._rest = bytes(self._rest), bytearray()
        return [_text(line)] if line else []


def _text(line: bytes) -> str:
    return line.decode("utf-8", errors="replace").removesuffix("\r")
