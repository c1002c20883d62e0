"""Text from other processes, made safe for a terminal.

Names, types, strings and log lines of a peer may hold anything: an escape sequence that changes
the window's title or clears the screen, a carriage return that hides the beginning of a line,
direction marks that show a line's words in another order. Print none of it unescaped.
"""

from __future__ import annotations

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


def _escaped(text: str, kept: frozenset[str]) -> str:
    return "".join(
        letter
        if letter.isprintable() or letter in kept
        else letter.encode("unicode_escape").decode()
        for letter in text
    )
