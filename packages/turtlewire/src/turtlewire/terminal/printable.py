"""Text for a terminal: tables, and text from other processes, made safe.

Names, types, strings and log lines of a peer may hold anything: an escape sequence that changes
the window's title or clears the screen, a carriage return that hides the beginning of a line,
direction marks that show a line's words in another order. Print none of it unescaped.
"""

from __future__ import annotations

from collections.abc import Sequence

#: ``str.isprintable`` refuses these, and languages need them: two spaces, and the joiners of
#: Persian, Hindi and emoji.
_HARMLESS = frozenset(
    "\N{NO-BREAK SPACE}\N{IDEOGRAPHIC SPACE}\N{ZERO WIDTH NON-JOINER}\N{ZERO WIDTH JOINER}"
)
_LINES = _HARMLESS | {"\n", "\t"}


def printable(text: str) -> str:
    r"""``text`` on one line.

    Control, direction and invisible characters as ``\x1b``, ``\u202e``.
    """
    return text if text.isprintable() else _escaped(text, _HARMLESS)


def printable_lines(text: str) -> str:
    """:func:`printable` for text of several lines: keeps line feeds and tabs."""
    return text if text.isprintable() else _escaped(text, _LINES)


def table_lines(rows: Sequence[Sequence[str]], left: Sequence[int]) -> list[str]:
    """Return the lines of a table without borders.

    Args:
        rows: The heading and the rows of cells.
        left: The columns that are aligned to the left; the others hold numbers.
    """
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return [
        "  ".join(
            cell.ljust(width) if column in left else cell.rjust(width)
            for column, (cell, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in rows
    ]


def _escaped(text: str, kept: frozenset[str]) -> str:
    return "".join(
        letter
        if letter.isprintable() or letter in kept
        else letter.encode("unicode_escape").decode()
        for letter in text
    )
