"""A lesson: its programs and checks, and the student's files as modules, imported afresh."""

from __future__ import annotations

import contextlib
import json
import linecache
import os
import re
import sys
from collections.abc import Callable, Iterator, Mapping
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import MappingProxyType, ModuleType
from typing import Any, NamedTuple

__all__ = ["Lesson", "LessonTurtle", "Program", "imported", "load_lesson", "solved"]

#: The tutorial's programs, with which several lessons start.
_TUTORIAL = Path(__file__).parent / "lessons" / "tutorial"


class Program(NamedTuple):
    """A program that a lesson starts.

    Attributes:
        source: A file of the student, or the name of an installed module.
        name: Name of its node; empty for the one that it has.
        arguments: Its command line.
        parameters: Its node's parameters.
    """

    source: str
    name: str = ""
    arguments: tuple[str, ...] = ()
    parameters: Mapping[str, Any] = MappingProxyType({})


class LessonTurtle(NamedTuple):
    """A turtle besides turtle1: its name and place [m, rad]."""

    name: str
    x: float
    y: float
    theta: float = 0.0


class Lesson(NamedTuple):
    """A lesson.

    Attributes:
        files: Names of the files that the student edits.
        programs: What is started, in this order.
        turtles: Turtles that are there besides turtle1.
        folder: Where it lies.
    """

    files: tuple[str, ...]
    programs: tuple[Program, ...]
    turtles: tuple[LessonTurtle, ...]
    folder: Path

    def starter(self) -> dict[str, str]:
        """Return the files that the student starts with, by name.

        A file that the lesson does not bring is the tutorial's, as it is printed there.
        """
        own = self.folder / "starter"
        return {
            file: ((own if (own / file).exists() else _TUTORIAL) / file).read_text(encoding="utf-8")
            for file in self.files
        }

    def solution(self) -> dict[str, str]:
        """Return the solved files, by name."""
        diff = (self.folder / "solution.diff").read_text(encoding="utf-8")
        return solved(self.starter(), diff)

    def checks(self) -> list[Callable[[Any], None]]:
        """The functions of ``checks.py`` whose names begin with ``check_``, in their order."""
        spec = spec_from_file_location("checks", self.folder / "checks.py")
        assert spec is not None
        assert spec.loader is not None
        module = module_from_spec(spec)
        spec.loader.exec_module(module)
        return [value for name, value in vars(module).items() if name.startswith("check_")]


def load_lesson(folder: Path) -> Lesson:
    """Read ``lesson.json`` of a folder."""
    data = json.loads((folder / "lesson.json").read_text(encoding="utf-8"))
    programs = [
        Program(**{**program, "arguments": tuple(program.get("arguments", ()))})
        for program in data["programs"]
    ]
    turtles = [LessonTurtle(**turtle) for turtle in data.get("turtles", ())]
    return Lesson(tuple(data["files"]), tuple(programs), tuple(turtles), folder)


@contextlib.contextmanager
def imported(files: Mapping[str, str]) -> Iterator[dict[str, ModuleType]]:
    """Run files as modules, in their order; they can import each other until the block ends.

    Args:
        files: Name to source text.

    Yields:
        The modules by file name.

    Raises:
        BaseException: Whatever the code raises.
    """
    modules: dict[str, ModuleType] = {}
    try:
        for file, source in files.items():
            # Tracebacks, and inspect, show the lines from here.
            lines = source.splitlines(keepends=True)
            linecache.cache[file] = (len(source), None, lines, file)
            module = ModuleType(os.path.splitext(file)[0])
            module.__file__ = file
            modules[file] = sys.modules[module.__name__] = module
            exec(compile(source, file, "exec"), vars(module))  # noqa: S102 - it is what runs here
        yield modules
    finally:
        for module in modules.values():
            sys.modules.pop(module.__name__, None)


def solved(starter: Mapping[str, str], diff: str) -> dict[str, str]:
    """Return the files of a lesson with the changes of a unified diff.

    The line numbers of a hunk do not count: its old lines must occur exactly once in the file, so
    that a change of the first files cannot move the solution to another line unnoticed.

    Args:
        starter: Source texts by file name.
        diff: The changes, as ``diff -u`` prints them.

    Raises:
        ValueError: The old lines of a hunk do not occur exactly once.
    """
    files = dict(starter)
    for file, old, new in _hunks(diff):
        if (count := files[file].count(old)) != 1:
            raise ValueError(f"{file} has {count} of these lines, expected 1:\n{old}")
        files[file] = files[file].replace(old, new)
    return files


def _hunks(diff: str) -> Iterator[tuple[str, str, str]]:
    """Yield the file, the old and the new lines of each hunk."""
    for section in re.split(r"^--- .*\n", diff, flags=re.MULTILINE)[1:]:
        head, *hunks = re.split(r"^@@.*\n", section, flags=re.MULTILINE)
        file = head.strip().rpartition("/")[2]
        for hunk in hunks:
            lines = [line or " " for line in hunk.splitlines()]  # editors strip the last space
            yield file, _side(lines, "-"), _side(lines, "+")


def _side(lines: list[str], sign: str) -> str:
    return "".join(f"{line[1:]}\n" for line in lines if line[0] in {" ", sign})
