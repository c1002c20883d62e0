"""A lesson: its files, the programs that are started, and its checks."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

from turtle_lesson.files import solved

__all__ = ["Lesson", "LessonTurtle", "Program", "load_lesson"]

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
