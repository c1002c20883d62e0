"""The commands of a CMake file as a tree of blocks such as ``if`` and ``foreach``."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from turtlewire_colcon.cmake.syntax import CMakeCommand, CMakeError

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["Block", "Branch", "Node", "build_tree"]

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
