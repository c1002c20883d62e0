"""Lexemes of the rules in ``--ros-args``; error texts name them by ROS 2's numbers."""

from __future__ import annotations

import re
from enum import IntEnum


class RuleError(ValueError):
    """A rule of ``--ros-args`` is malformed; the text is ROS 2's."""


class Lexeme(IntEnum):
    """The kinds of lexemes."""

    NONE = 0
    EOF = 1
    TILDE_SLASH = 2
    URL_SERVICE = 3
    URL_TOPIC = 4
    COLON = 5
    NODE = 6
    NS = 7
    SEPARATOR = 8
    # One for each digit: ROS 2 numbers them from 9 to 17.
    BACKREFERENCE = 9
    TOKEN = 18
    FORWARD_SLASH = 19
    WILD_ONE = 20
    WILD_MULTI = 21
    DOT = 22


# As in ROS 2, a token has no two underscores in a row.
_PATTERN = re.compile(
    r"(?P<TILDE_SLASH>~/)|(?P<URL_SERVICE>rosservice://)|(?P<URL_TOPIC>rostopic://)|(?P<SEPARATOR>:=)|(?P<COLON>:)"
    r"|(?P<NODE>__node|__name)|(?P<NS>__ns)|(?P<BACKREFERENCE>\\[1-9])|(?P<TOKEN>(?:[A-Za-z]_?|_(?!_))(?:[0-9A-Za-z]_?)*)"
    r"|(?P<FORWARD_SLASH>/)|(?P<WILD_MULTI>\*\*)|(?P<WILD_ONE>\*)|(?P<DOT>\.)"
)


class Lexer:
    """Reads one rule from left to right, with two lexemes of look-ahead."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.index = 0

    @property
    def rest(self) -> str:
        """Text that has not been read yet."""
        return self.text[self.index :]

    def peek(self) -> Lexeme:
        """Return the kind of the next lexeme."""
        return self._lexeme_at(self.index)[0]

    def peek2(self) -> tuple[Lexeme, Lexeme]:
        """Return the kinds of the next two lexemes."""
        first, end = self._lexeme_at(self.index)
        return first, self._lexeme_at(end)[0]

    def accept(self) -> str:
        """Read the next lexeme, whatever it is, and return its text."""
        start = self.index
        self.index = self._lexeme_at(start)[1]
        return self.text[start : self.index]

    def expect(self, wanted: Lexeme) -> str:
        """Read the next lexeme and return its text.

        Raises:
            RuleError: The next lexeme is of another kind.
        """
        found = self.peek()
        if found == wanted:
            return self.accept()
        if found in (Lexeme.NONE, Lexeme.EOF):
            raise RuleError(
                f"Expected lexeme type ({wanted.value}) not found, search ended at index "
                f"{self.index}"
            )
        raise RuleError(
            f"Expected lexeme type {wanted.value}, got {found.value} at index {self.index}"
        )

    def _lexeme_at(self, index: int) -> tuple[Lexeme, int]:
        if index == len(self.text):
            return Lexeme.EOF, index
        match = _PATTERN.match(self.text, index)
        if match is None:
            return Lexeme.NONE, index
        return Lexeme[str(match.lastgroup)], match.end()
