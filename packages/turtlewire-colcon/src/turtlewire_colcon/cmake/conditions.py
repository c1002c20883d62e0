"""The conditions of ``if`` and ``while``."""

from __future__ import annotations

import operator
import os
import re
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Protocol

from turtlewire_colcon.cmake.syntax import CMakeArgument, CMakeError

if TYPE_CHECKING:
    from turtlewire_colcon.cmake.plan import Plan
    from turtlewire_colcon.cmake.syntax import SourcePosition

__all__ = ["CMakeCondition", "Surroundings", "is_false", "is_true", "note_match"]

_TRUE = frozenset({"1", "ON", "YES", "TRUE", "Y"})
_FALSE = frozenset({"", "0", "OFF", "NO", "FALSE", "N", "IGNORE", "NOTFOUND"})
_ORDER: dict[str, Callable[[Any, Any], bool]] = {
    "EQUAL": operator.eq,
    "LESS": operator.lt,
    "LESS_EQUAL": operator.le,
    "GREATER": operator.gt,
    "GREATER_EQUAL": operator.ge,
}
_UNARY = frozenset(
    {"DEFINED", "EXISTS", "IS_DIRECTORY", "IS_ABSOLUTE", "TARGET", "COMMAND", "POLICY", "TEST"}
)
_BINARY = frozenset(
    {"MATCHES", "IN_LIST", "PATH_EQUAL"}
    | {f"{prefix}{name}" for prefix in ("", "STR", "VERSION_") for name in _ORDER}
)


def is_true(text: str) -> bool:
    """Return True if a text is one of CMake's true constants: ``ON``, or a number but 0."""
    return text.upper() in _TRUE or (_is_number(text) and float(text) != 0)


def is_false(text: str) -> bool:
    """Return True if a text is one of CMake's false constants: empty, ``OFF``, ``X-NOTFOUND``."""
    upper = text.upper()
    return upper in _FALSE or upper.endswith("-NOTFOUND")


class Surroundings(Protocol):
    """The part of the interpreter that conditions query."""

    variables: dict[str, str]
    environment: Mapping[str, str]
    plan: Plan

    def knows(self, name: str) -> bool:
        """Return True if there is a command of this name."""

    def source_path(self, text: str) -> str:
        """Return a path, relative to the folder of the CMakeLists.txt."""


class CMakeCondition:
    """Evaluates one condition; ``NOT`` binds closer than ``AND``, and that closer than ``OR``.

    Args:
        words: The expanded arguments.
        interpreter: Knows variables, commands and targets.
        place: Of the command, for errors.
    """

    def __init__(
        self, words: Sequence[CMakeArgument], interpreter: Surroundings, place: SourcePosition
    ) -> None:
        self._words = words
        self._run = interpreter
        self._place = place
        self._at = 0

    def holds(self) -> bool:
        """Return True if the condition holds.

        Raises:
            CMakeError: The words are not a condition.
        """
        result = self._any()
        if self._at < len(self._words):
            raise CMakeError(
                self._place, f"unexpected {self._words[self._at].text!r} in a condition"
            )
        return result

    def _any(self) -> bool:
        result = self._all()
        while self._take("OR"):
            right = self._all()
            result = result or right
        return result

    def _all(self) -> bool:
        result = self._negated()
        while self._take("AND"):
            right = self._negated()
            result = result and right
        return result

    def _negated(self) -> bool:
        return not self._negated() if self._take("NOT") else self._test()

    def _test(self) -> bool:
        if self._take("("):
            result = self._any()
            if not self._take(")"):
                raise CMakeError(self._place, "a parenthesis is not closed in a condition")
            return result
        word = self._next()
        following = self._peek()
        if following is not None and following.kind == "plain" and following.text in _BINARY:
            self._at += 1
            return self._compare(word, following.text, self._next())
        if word.kind == "plain" and word.text in _UNARY and following is not None:
            self._at += 1
            return self._check(word.text, following.text)
        return self._truth(word)

    def _truth(self, word: CMakeArgument) -> bool:
        if is_true(word.text):
            return True
        if word.kind != "plain" or is_false(word.text):
            return False
        return not is_false(self._run.variables.get(word.text, ""))

    def _check(self, test: str, text: str) -> bool:
        if test == "DEFINED":
            environment = re.fullmatch(r"(?:ENV|CACHE)\{(.*)\}", text)
            return (
                environment[1] in self._run.environment
                if environment and text.startswith("ENV")
                else (environment[1] if environment else text) in self._run.variables
            )
        if test == "COMMAND":
            return self._run.knows(text.lower())
        if test == "TARGET":
            return text in self._run.plan.targets
        path = self._run.source_path(text)
        tests = {"EXISTS": os.path.exists, "IS_DIRECTORY": os.path.isdir}
        if test in tests:
            return bool(text) and tests[test](path)
        return test == "IS_ABSOLUTE" and os.path.isabs(text)

    def _compare(self, left: CMakeArgument, test: str, right: CMakeArgument) -> bool:
        a, b = self._value(left), self._value(right)
        if test == "MATCHES":
            return self._matches(a, right.text)
        if test == "IN_LIST":
            return a in self._run.variables.get(right.text, "").split(";")
        if test == "PATH_EQUAL":
            return os.path.normpath(a) == os.path.normpath(b)
        if test.startswith("STR"):
            return _ORDER[test.removeprefix("STR")](a, b)
        if test.startswith("VERSION_"):
            return _ORDER[test.removeprefix("VERSION_")](_version(a), _version(b))
        return _is_number(a) and _is_number(b) and _ORDER[test](float(a), float(b))

    def _matches(self, text: str, pattern: str) -> bool:
        try:
            match = re.search(pattern, text)
        except re.error as error:
            raise CMakeError(
                self._place, f"{pattern!r} is not a regular expression: {error}"
            ) from None
        note_match(self._run.variables, match)
        return match is not None

    def _value(self, word: CMakeArgument) -> str:
        return self._run.variables.get(word.text, word.text) if word.kind == "plain" else word.text

    def _peek(self) -> CMakeArgument | None:
        return self._words[self._at] if self._at < len(self._words) else None

    def _next(self) -> CMakeArgument:
        word = self._peek()
        if word is None:
            raise CMakeError(self._place, "a condition ends too early")
        self._at += 1
        return word

    def _take(self, keyword: str) -> bool:
        if self._peek() == CMakeArgument(keyword):
            self._at += 1
            return True
        return False


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def note_match(variables: dict[str, str], match: re.Match[str] | None) -> None:
    """Set the variables that have the last match and its groups; without a match, all are empty."""
    groups = (match[0], *match.groups("")) if match else ()
    for number in range(10):
        variables[f"CMAKE_MATCH_{number}"] = groups[number] if number < len(groups) else ""
    variables["CMAKE_MATCH_COUNT"] = str((match and match.lastindex) or 0)


def _version(text: str) -> tuple[int, ...]:
    start = re.match(r"\d+(?:\.\d+)*", text)  # the rest is not evaluated
    numbers = [int(part) for part in start[0].split(".")] if start else []
    while numbers and numbers[-1] == 0:
        numbers.pop()
    return tuple(numbers)
