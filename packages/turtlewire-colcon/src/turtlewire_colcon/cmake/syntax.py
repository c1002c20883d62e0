"""The commands of a CMake file: blocks, names and arguments, not yet evaluated."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import NamedTuple

__all__ = [
    "Block",
    "Branch",
    "CMakeArgument",
    "CMakeCommand",
    "CMakeError",
    "Node",
    "Parsed",
    "SourcePosition",
    "build_tree",
    "parse_commands",
    "parse_keywords",
]

_SPACE = re.compile(r"(?:[ \t\r\n]+|#\[(?P<level>=*)\[.*?\](?P=level)\]|#[^\n]*)+", re.DOTALL)
_NAME = re.compile(r"[A-Za-z_]\w*")
_BRACKET = re.compile(r"\[(?P<level>=*)\[\n?(?P<text>.*?)\](?P=level)\]", re.DOTALL)
_QUOTED = re.compile(r'"(?P<text>(?:[^"\\]|\\.)*)"', re.DOTALL)
# Quotes within an unquoted argument (-Da="b c") and $(MAKE) belong to it.
_UNQUOTED = re.compile(r'(?:[^\s()#"\\]|\\.|\$\([^()]*\)|(?<=[^\s(])"(?:[^"\\]|\\.)*")+', re.DOTALL)


class SourcePosition(NamedTuple):
    """The position of a command in its file.

    Attributes:
        file: The file's path.
        line: Line of the command's name; the first is 1.
    """

    file: str
    line: int

    def __str__(self) -> str:
        return f"{self.file}:{self.line}"


class CMakeError(Exception):
    """A CMake file cannot be read or evaluated; the text begins with file and line.

    Args:
        place: Where the trouble is.
        text: What it is.
        earlier: Lines about what went wrong before, and is likely the reason.
        is_final: True if the fault ends the evaluation, also in a package with C++.
    """

    def __init__(
        self,
        place: SourcePosition,
        text: str,
        earlier: Sequence[str] = (),
        *,
        is_final: bool = False,
    ) -> None:
        super().__init__("\n".join([*earlier, f"{place}: {text}"]))
        self.place = place
        self.text = text
        self.is_final = is_final


class CMakeArgument(NamedTuple):
    """One argument as written.

    Attributes:
        text: Without its quotes or brackets.
        kind: ``plain``, ``quoted`` or ``bracket``; nothing is replaced in the last.
    """

    text: str
    kind: str = "plain"


class CMakeCommand(NamedTuple):
    """One command.

    Attributes:
        name: In lower case.
        arguments: As written; each parenthesis is a separate argument.
        place: Where it stands.
    """

    name: str
    arguments: tuple[CMakeArgument, ...]
    place: SourcePosition


def parse_commands(text: str, file: str) -> list[CMakeCommand]:
    """Return the commands of a CMake file.

    Args:
        text: What the file holds.
        file: Its path, for errors.

    Raises:
        CMakeError: The text is not valid CMake.
    """
    return _Reader(text, file).commands()


class _Reader:
    def __init__(self, text: str, file: str) -> None:
        self._text = text
        self._file = file
        self._at = 0

    def commands(self) -> list[CMakeCommand]:
        found = []
        self._skip_space()
        while self._at < len(self._text):
            place = self._place()
            name = self._match(_NAME)
            if name is None:
                raise CMakeError(place, f"expected a command, got {self._next_word()!r}")
            self._skip_space()
            if not self._text.startswith("(", self._at):
                raise CMakeError(place, f"expected '(' after '{name[0]}'")
            self._at += 1
            found.append(CMakeCommand(name[0].lower(), self._arguments(place), place))
            self._skip_space()
        return found

    def _arguments(self, place: SourcePosition) -> tuple[CMakeArgument, ...]:
        found: list[CMakeArgument] = []
        depth = 1
        while True:
            self._skip_space()
            if self._at >= len(self._text):
                raise CMakeError(place, "the parenthesis that opens here is never closed")
            character = self._text[self._at]
            if character in "()":
                self._at += 1
                depth += 1 if character == "(" else -1
                if depth == 0:
                    return tuple(found)
                found.append(CMakeArgument(character))
            else:
                found.append(self._argument())

    def _argument(self) -> CMakeArgument:
        for pattern, kind in ((_BRACKET, "bracket"), (_QUOTED, "quoted")):
            match = self._match(pattern)
            if match is not None:
                text = match["text"]
                return CMakeArgument(text.replace("\\\n", "") if kind == "quoted" else text, kind)
        match = self._match(_UNQUOTED)
        if match is None:
            raise CMakeError(self._place(), f"cannot read {self._next_word()!r}")
        return CMakeArgument(match[0])

    def _match(self, pattern: re.Pattern[str]) -> re.Match[str] | None:
        match = pattern.match(self._text, self._at)
        if match is not None:
            self._at = match.end()
        return match

    def _skip_space(self) -> None:
        self._match(_SPACE)

    def _place(self) -> SourcePosition:
        return SourcePosition(self._file, self._text.count("\n", 0, self._at) + 1)

    def _next_word(self) -> str:
        return self._text[self._at :].split(None, 1)[0][:30]


_BLOCKS = {
    "if": "endif",
    "foreach": "endforeach",
    "while": "endwhile",
    "function": "endfunction",
    "macro": "endmacro",
}
_ENDS = frozenset(_BLOCKS.values())
_BRANCHES = ("elseif", "else")


class Branch(NamedTuple):
    """A command that opens a block (or ``elseif``, ``else``), and what follows it."""

    head: CMakeCommand
    body: tuple[Node, ...]


class Block(NamedTuple):
    """A block: one branch, more of them only in an ``if``."""

    branches: tuple[Branch, ...]


Node = CMakeCommand | Block


def build_tree(commands: Sequence[CMakeCommand]) -> tuple[Node, ...]:
    """Return the tree of the commands of a file.

    Raises:
        CMakeError: A block is not closed, or closed without having been opened.
    """
    nodes, at = _nodes(commands, 0)
    if at < len(commands):
        stray = commands[at]
        raise CMakeError(stray.place, f"{stray.name}() closes nothing")
    return nodes


def _nodes(commands: Sequence[CMakeCommand], at: int) -> tuple[tuple[Node, ...], int]:
    """Nodes up to the end of the commands, or up to a command that belongs to the outer block."""
    nodes: list[Node] = []
    while at < len(commands):
        command = commands[at]
        if command.name in _ENDS or command.name in _BRANCHES:
            break
        if command.name in _BLOCKS:
            block, at = _block(commands, at)
            nodes.append(block)
        else:
            nodes.append(command)
            at += 1
    return tuple(nodes), at


def _block(commands: Sequence[CMakeCommand], at: int) -> tuple[Block, int]:
    opening = commands[at]
    branches: list[Branch] = []
    while True:
        head = commands[at]
        body, at = _nodes(commands, at + 1)
        branches.append(Branch(head, body))
        name = commands[at].name if at < len(commands) else ""
        if name == _BLOCKS[opening.name]:
            return Block(tuple(branches)), at + 1
        if name not in _BRANCHES or opening.name != "if":
            raise CMakeError(opening.place, f"{opening.name}() has no {_BLOCKS[opening.name]}()")


class Parsed(NamedTuple):
    """The words of a command.

    Attributes:
        options: Which options were given.
        values: The value of each keyword with one value.
        lists: The values of each keyword with several.
        rest: What belongs to no keyword.
    """

    options: frozenset[str]
    values: dict[str, str]
    lists: dict[str, list[str]]
    rest: list[str]


def parse_keywords(
    words: Iterable[str],
    options: Iterable[str] = (),
    values: Iterable[str] = (),
    lists: Iterable[str] = (),
) -> Parsed:
    """Take words apart by keywords.

    Args:
        words: The words of the command.
        options: Keywords without a value.
        values: Keywords with one value.
        lists: Keywords with any number of values.
    """
    options, values, lists = frozenset(options), frozenset(values), frozenset(lists)
    found = Parsed(frozenset(), {}, {}, [])
    given: set[str] = set()
    keyword = ""
    for word in words:
        if word in options:
            given.add(word)
            keyword = ""
        elif word in values or word in lists:
            keyword = word
            if word in lists:
                found.lists.setdefault(word, [])
        elif keyword in values:
            found.values[keyword] = word
            keyword = ""
        elif keyword:
            found.lists[keyword].append(word)
        else:
            found.rest.append(word)
    return found._replace(options=frozenset(given))
