"""Functions that the page's worker calls; they take a lesson's name and return text."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

from turtle_lesson import grading
from turtle_lesson.lesson import load_lesson
from turtle_lesson.session import LessonSession

__all__ = ["grade", "open_session"]

_LESSONS = Path(__file__).resolve().parent / "lessons"


def open_session(lesson: str, files: str, faults: str) -> LessonSession:
    """Run a lesson.

    Args:
        lesson: Its name.
        files: JSON object of the student's files.
        faults: JSON list of the names of faults that are switched on.
    """
    return LessonSession(load_lesson(_LESSONS / lesson), json.loads(files), json.loads(faults))


def grade(
    lesson: str, files: str, tell: Callable[[str], object], alive: Callable[[], object]
) -> None:
    """Run the checks of a lesson.

    Args:
        lesson: Its name.
        files: JSON object of the student's files.
        tell: Called with each result, as a JSON object, as soon as it is available.
        alive: Called now and then while the checks run.
    """
    for result in grading.grade(load_lesson(_LESSONS / lesson), json.loads(files), alive):
        tell(json.dumps(result._asdict()))
