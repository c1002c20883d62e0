"""The tokens of an .idl file, and a reader that steps through them."""

from __future__ import annotations

import re
from typing import NamedTuple

from turtlewire.errors import InterfaceError

__all__ = ["IdlToken", "IdlTokens"]

_TOKEN = re.compile(
    r"(?P<include>\#\s*include\s*[<\"](?P<path>[^>\"\n]*)[>\"])"
    r"|(?P<space>\s+|//[^\n]*|/\*.*?\*/|\#[^\n]*)"
    r"|L?(?P<text>\"(?:[^\"\\]|\\.)*\")"
    r"|L?(?P<character>'(?:[^'\\]|\\.[^']*)')"
    r"|(?P<number>[-+]?(?:\d[\w.]*|\.\d\w*)(?:(?<=[eE])[-+]\d+)?)"
    r"|(?P<name>[A-Za-z_]\w*(?:::[A-Za-z_]\w*)*)"
    r"|(?P<symbol>[{}()\[\]<>;:,=@])",
    re.DOTALL,
)


class IdlToken(NamedTuple):
    """A token.

    Attributes:
        kind: ``text``, ``character``, ``number``, ``name``, ``symbol`` or ``end``.
        text: As written, but without the ``L`` of wide texts and characters.
        line: Its line, from 1.
    """

    kind: str
    text: str
    line: int


class IdlTokens:
    """Steps through the tokens of a file.

    Args:
        label: What errors call the file.
        text: What it holds.

    Attributes:
        includes: The files that it includes.

    Raises:
        InterfaceError: A part is not a token; the message contains the line.
    """

    def __init__(self, label: str, text: str) -> None:
        self._label = label
        self._at = 0
        self.includes: list[str] = []
        self._tokens = self._split(text)

    def peek(self) -> IdlToken:
        """Return the next token, which stays the next one."""
        return self._tokens[self._at]

    def next(self, kind: str = "") -> IdlToken:
        """Take the next token.

        Raises:
            InterfaceError: The token is missing or of another kind.
        """
        token = self.peek()
        if token.kind == "end" or (kind and token.kind != kind):
            raise self.error(f"expected a {kind or 'value'}, got '{token.text}'", token.line)
        self._at += 1
        return token

    def take(self, symbol: str) -> bool:
        """Take a symbol if it comes next; returns whether it did."""
        if self.peek().text != symbol:
            return False
        self._at += 1
        return True

    def expect(self, symbol: str) -> None:
        """Take a symbol.

        Raises:
            InterfaceError: Something else comes next.
        """
        if not self.take(symbol):
            token = self.peek()
            raise self.error(f"expected '{symbol}', got '{token.text}'", token.line)

    def error(self, text: str, line: int) -> InterfaceError:
        """Return an error that names the file and a line."""
        return InterfaceError(f"{self._label}, line {line}: {text}")

    def _split(self, text: str) -> list[IdlToken]:
        tokens = []
        at, line = 0, 1
        while at < len(text):
            match = _TOKEN.match(text, at)
            if match is None:
                raise self.error(f"cannot read {text[at : at + 10]!r}", line)
            kind = str(match.lastgroup)
            if kind == "include":
                self.includes.append(match["path"])
            elif kind != "space":
                tokens.append(IdlToken(kind, match[kind], line))
            line += match[0].count("\n")
            at = match.end()
        return [*tokens, IdlToken("end", "the end of the file", line)]
