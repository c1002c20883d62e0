"""Runs the commands of a CMake file: variables, blocks, functions and macros."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from turtlewire_colcon.cmake.conditions import CMakeCondition
from turtlewire_colcon.cmake.syntax import (
    Block,
    Branch,
    CMakeArgument,
    CMakeCommand,
    CMakeError,
    SourcePosition,
    build_tree,
    parse_commands,
)

if TYPE_CHECKING:
    from turtlewire_colcon.cmake.plan import Plan
    from turtlewire_colcon.cmake.syntax import Node
    from turtlewire_colcon.package_lookup import PackageLookup

    Handler = Callable[["Interpreter", "ExpandedCommand"], None]

__all__ = ["ExpandedCommand", "Interpreter"]

_ESCAPES = {"n": "\n", "t": "\t", "r": "\r", ";": "\\;"}
_REFERENCE = re.compile(r"\$(ENV|CACHE)?\{")
_SEPARATOR = re.compile(r"(?<!\\);")
#: Calls within calls; CMake's own limit is about as high.
_DEEPEST = 200


class ExpandedCommand(NamedTuple):
    """A command with expanded arguments."""

    name: str
    words: list[str]
    place: SourcePosition


class _Leave(Exception):
    """Leaves a loop or a function; `kind` is the command that asked for it."""

    def __init__(self, kind: str) -> None:
        super().__init__(kind)
        self.kind = kind


class Interpreter:
    """Runs CMake files, and lets the commands fill a plan.

    Args:
        commands: The built-in commands.
        plan: Filled by the commands.
        variables: The variables at the beginning.
        environment: What ``$ENV{…}`` reads.
        packages: Finds the packages that ``find_package`` names.
        strict: Commands whose faults end the evaluation, also in a package with C++.

    Attributes:
        plan: What the commands would install, generate and test.
        variables: The variables of the current scope.
        environment: What ``$ENV{…}`` reads.
        packages: Finds the packages that ``find_package`` names.
        testing: Greater than 0 inside ``if(BUILD_TESTING)``.
    """

    def __init__(
        self,
        commands: Mapping[str, Handler],
        plan: Plan,
        variables: dict[str, str],
        environment: Mapping[str, str],
        packages: PackageLookup,
        *,
        strict: frozenset[str],
    ) -> None:
        self._commands = commands
        self._strict = strict
        self._functions: dict[str, Branch] = {}
        self._outer: list[dict[str, str]] = []
        self.plan = plan
        self.variables = variables
        self.environment = environment
        self.packages = packages
        self.testing = 0

    def run_file(self, path: str | Path) -> None:
        """Run the commands of a file.

        What a command at the top level raises is added to the plan's faults, and the next one
        runs: if the package turns out to have C++, the fault may be the C++ part's.

        Raises:
            CMakeError: The file cannot be parsed, or a strict command failed; the text begins with
                file and line.
            OSError: The file cannot be read.
        """
        text = Path(path).read_text(encoding="utf-8", errors="replace")
        with self._listed(str(path)):
            for node in build_tree(parse_commands(text, str(path))):
                if not self._run_top_level(node):
                    break

    def run_text(self, text: str, place: SourcePosition) -> None:
        """Run the commands in a string."""
        self._call_body(build_tree(parse_commands(text, place.file)))

    def knows(self, name: str) -> bool:
        """Return True if there is a command or a function of this name."""
        return name in self._commands or name in self._functions

    def source_path(self, text: str) -> str:
        """Return a path as commands mean it: relative to the folder of the CMakeLists.txt."""
        return os.path.normpath(os.path.join(self.variables["CMAKE_CURRENT_SOURCE_DIR"], text))

    def binary_path(self, text: str) -> str:
        """Return the path of a file that a command writes."""
        return os.path.normpath(os.path.join(self.variables["CMAKE_CURRENT_BINARY_DIR"], text))

    def set_outside(self, name: str, value: str | None) -> None:
        """Set or, with None, remove a variable of the scope outside (``PARENT_SCOPE``)."""
        scope = self._outer[-1] if self._outer else self.variables
        if value is None:
            scope.pop(name, None)
        else:
            scope[name] = value

    @contextmanager
    def scope(self, **variables: str) -> Iterator[None]:
        """Open a scope with further variables."""
        self._outer.append(self.variables)
        self.variables = {**self.variables, **variables}
        try:
            yield
        finally:
            self.variables = self._outer.pop()

    def expand(self, argument: CMakeArgument) -> list[str]:
        """Return the words of an argument: a plain one is split at semicolons."""
        if argument.kind == "bracket":
            return [argument.text]
        text = self._replace(argument.text)
        if argument.kind == "quoted":
            return [text.replace("\\;", ";")]
        return [word.replace("\\;", ";") for word in _SEPARATOR.split(text) if word]

    def _replace(self, text: str) -> str:
        out = []
        at = 0
        while at < len(text):
            reference = _REFERENCE.match(text, at)
            if reference is not None:
                end = _closing_brace(text, reference.end())
                name = self._replace(text[reference.end() : end])
                found = self.environment if reference[1] == "ENV" else self.variables
                out.append(found.get(name, ""))
                at = end + 1
            elif text[at] == "\\" and at + 1 < len(text):
                out.append(_ESCAPES.get(text[at + 1], text[at + 1]))
                at += 2
            else:
                out.append(text[at])
                at += 1
        return "".join(out)

    @contextmanager
    def _listed(self, path: str) -> Iterator[None]:
        names = ("CMAKE_CURRENT_LIST_FILE", "CMAKE_CURRENT_LIST_DIR")
        before = [self.variables.get(name, "") for name in names]
        self.variables.update(zip(names, (path, os.path.dirname(path)), strict=True))
        try:
            yield
        finally:
            self.variables.update(zip(names, before, strict=True))

    def _run(self, nodes: Sequence[Node]) -> None:
        for node in nodes:
            if isinstance(node, CMakeCommand):
                self._run_command(node)
            else:
                self._run_block(node)

    def _run_top_level(self, node: Node) -> bool:
        """Run a statement of a file, and keep its fault; False if it ended the file."""
        try:
            self._run((node,))
        except CMakeError as error:
            if error.is_final:
                raise
            self.plan.faults.append(error)
        except _Leave as leave:
            if leave.kind != "return":
                raise
            return False
        return True

    def _call_body(self, nodes: Sequence[Node]) -> None:
        try:
            self._run(nodes)
        except _Leave as leave:
            if leave.kind != "return":
                raise

    def _run_command(self, command: CMakeCommand) -> None:
        if command.name in ("break", "continue", "return"):
            raise _Leave(command.name)
        words = [word for argument in command.arguments for word in self.expand(argument)]
        call = ExpandedCommand(command.name, words, command.place)
        if command.name in self._functions:
            self._run_function(call)
        elif command.name in self._commands:
            self._run_builtin(call)
        elif not self.testing:
            self.plan.unknown.append(
                f"{call.place}: the command {call.name}() is not known; turtlewire installs "
                "Python, data and interfaces, and does not run CMake"
            )

    def _run_builtin(self, call: ExpandedCommand) -> None:
        try:
            self._commands[call.name](self, call)
        except CMakeError as error:
            error.is_final = error.is_final or call.name in self._strict
            raise
        except (IndexError, KeyError, ValueError, re.error) as error:
            text = " ".join(call.words)
            raise CMakeError(
                call.place,
                f"wrong arguments: {call.name}({text[:80]}) ({error})",
                is_final=call.name in self._strict,
            ) from error

    def _run_block(self, block: Block) -> None:
        name = block.branches[0].head.name
        if name == "if":
            self._run_if(block)
        elif name == "foreach":
            self._run_foreach(block.branches[0])
        elif name == "while":
            self._run_while(block.branches[0])
        else:
            head = block.branches[0].head
            words = [word for argument in head.arguments for word in self.expand(argument)]
            if not words:
                raise CMakeError(head.place, f"{name}() needs a name")
            self._functions[words[0].lower()] = block.branches[0]

    def _run_if(self, block: Block) -> None:
        for branch in block.branches:
            arguments = branch.head.arguments
            if branch.head.name == "else" or self._holds(branch.head):
                tests = any("BUILD_TESTING" in argument.text for argument in arguments)
                self.testing += tests
                try:
                    self._run(branch.body)
                finally:
                    self.testing -= tests
                return

    def _holds(self, head: CMakeCommand) -> bool:
        words = [
            CMakeArgument(word, argument.kind)
            for argument in head.arguments
            for word in (self.expand(argument) or [""])
        ]
        return CMakeCondition(words, self, head.place).holds()

    def _run_foreach(self, branch: Branch) -> None:
        words = [word for argument in branch.head.arguments for word in self.expand(argument)]
        if not words:
            raise CMakeError(branch.head.place, "foreach() needs a variable")
        variable, *items = words
        before = self.variables.get(variable)
        for item in _loop_items(self, items, branch.head.place):
            self.variables[variable] = item
            if not self._run_round(branch):
                break
        if before is None:
            self.variables.pop(variable, None)
        else:
            self.variables[variable] = before

    def _run_while(self, branch: Branch) -> None:
        for _ in range(100_000):
            if not self._holds(branch.head) or not self._run_round(branch):
                return
        raise CMakeError(branch.head.place, "this loop has no end")

    def _run_round(self, branch: Branch) -> bool:
        """Run the body of a loop once; False if it has left the loop."""
        try:
            self._run(branch.body)
        except _Leave as leave:
            if leave.kind == "return":
                raise
            return leave.kind == "continue"
        return True

    def _run_function(self, call: ExpandedCommand) -> None:
        if len(self._outer) >= _DEEPEST:
            raise CMakeError(call.place, f"{call.name}() calls itself without end")
        branch = self._functions[call.name]
        names = [word for argument in branch.head.arguments for word in self.expand(argument)][1:]
        if len(call.words) < len(names):
            raise CMakeError(
                call.place,
                f"{call.name}() takes {len(names)} arguments ({' '.join(names)}), "
                f"got {len(call.words)}",
            )
        given = dict(zip(names, call.words, strict=False))
        given |= {f"ARGV{number}": word for number, word in enumerate(call.words)}
        given |= {
            "ARGC": str(len(call.words)),
            "ARGV": ";".join(call.words),
            "ARGN": ";".join(call.words[len(names) :]),
        }
        if branch.head.name == "macro":
            self._run(tuple(_with_arguments(node, given) for node in branch.body))
        else:
            with self.scope(**given):
                self._call_body(branch.body)


def _closing_brace(text: str, at: int) -> int:
    depth = 1
    while at < len(text):
        depth += {"{": 1, "}": -1}.get(text[at], 0)
        if depth == 0:
            return at
        at += 1
    return at


def _loop_items(run: Interpreter, items: list[str], place: SourcePosition) -> list[str]:
    if items[:1] == ["IN"]:
        found: list[str] = []
        lists = False
        for word in items[1:]:
            if word in ("LISTS", "ITEMS"):
                lists = word == "LISTS"
            elif lists:
                found += [item for item in run.variables.get(word, "").split(";") if item]
            else:
                found.append(word)
        return found
    return _range_items(items[1:], place) if items[:1] == ["RANGE"] else items


def _range_items(words: list[str], place: SourcePosition) -> list[str]:
    """Return the numbers of ``foreach(RANGE)``, the last one included; downwards too."""
    try:
        numbers = [int(word) for word in words]
    except ValueError:
        raise CMakeError(place, "foreach(RANGE) takes whole numbers") from None
    if not 1 <= len(numbers) <= 3:
        raise CMakeError(place, "foreach(RANGE) takes a last number, or a first, a last and a step")
    start, stop = numbers[:2] if len(numbers) > 1 else (0, numbers[0])
    direction = -1 if stop < start else 1
    step = (numbers[2] if len(numbers) == 3 else 0) or direction
    if step * direction < 0:
        raise CMakeError(place, f"foreach(RANGE): steps of {step} lead from {start} not to {stop}")
    return [str(number) for number in range(start, stop + direction, step)]


def _with_arguments(node: Node, given: dict[str, str]) -> Node:
    """Return a node of a macro's body, with the macro's arguments written into it."""
    if isinstance(node, CMakeCommand):
        return _command_with(node, given)
    return Block(
        tuple(
            Branch(
                _command_with(branch.head, given),
                tuple(_with_arguments(inner, given) for inner in branch.body),
            )
            for branch in node.branches
        )
    )


def _command_with(command: CMakeCommand, given: dict[str, str]) -> CMakeCommand:
    def replace(argument: CMakeArgument) -> CMakeArgument:
        text = argument.text
        for name, value in given.items():
            text = text.replace(f"${{{name}}}", value)
        return argument._replace(text=text)

    return command._replace(arguments=tuple(replace(argument) for argument in command.arguments))
