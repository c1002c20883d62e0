"""Runs the checks of a lesson: each in its own simulation, with the same result every time."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, NamedTuple

from turtle_lesson.exercise import NotYet, exercise_of, programs_here
from turtle_lesson.mistakes import mistake_of

if TYPE_CHECKING:
    from contextlib import AbstractContextManager

    from turtle_lesson.exercise import Exercise
    from turtle_lesson.lesson import Lesson, Program
    from turtlesim.testing import Simulation

__all__ = ["LessonResult", "check_name", "grade"]


class LessonResult(NamedTuple):
    """The result of a check.

    Attributes:
        check: What is checked, in words.
        passed: Whether it is so.
        text: What was seen instead; empty if it passed.
        hint: What helps.
        file: The file of the student to look at, if an error points to a line.
        line: The line, from 1; 0 if none.
    """

    check: str
    passed: bool
    text: str = ""
    hint: str = ""
    file: str = ""
    line: int = 0


def check_name(check: Callable[[Exercise], None]) -> str:
    """Return a check's name: the first line of its docstring."""
    return (check.__doc__ or check.__name__).strip().splitlines()[0].removesuffix(".")


def grade(
    lesson: Lesson,
    files: Mapping[str, str],
    alive: Callable[[], object] = lambda: None,
    programs: Callable[
        [Simulation, Mapping[str, str]], AbstractContextManager[Callable[[Program], None]]
    ] = programs_here,
) -> Iterator[LessonResult]:
    """Run the checks in their order; ends after the first that is not passed.

    Later checks build on earlier ones, and one thing to fix at a time is enough.

    Args:
        lesson: The lesson.
        files: The student's files.
        alive: Called twice in a simulated second.
        programs: Where the student's programs run, as in :func:`.exercise_of`.
    """

    def opened() -> AbstractContextManager[Exercise]:
        return exercise_of(lesson, files, programs=programs)

    for check in lesson.checks():
        result = _run(check, opened, files, alive)
        yield result
        if not result.passed:
            return


def _run(
    check: Callable[[Exercise], None],
    opened: Callable[[], AbstractContextManager[Exercise]],
    files: Mapping[str, str],
    alive: Callable[[], object],
) -> LessonResult:
    name = check_name(check)
    try:
        with opened() as exercise:
            exercise.call_regularly(alive)
            check(exercise)
    except NotYet as seen:
        return LessonResult(name, False, str(seen), seen.hint)
    except BaseException as error:  # noqa: BLE001 - students raise anything
        mistake = mistake_of(error, files)
        return LessonResult(name, False, mistake.text, mistake.hint, mistake.file, mistake.line)
    return LessonResult(name, True)
