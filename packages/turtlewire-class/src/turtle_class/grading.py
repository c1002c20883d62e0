"""All exercises of all students, several at a time."""

from __future__ import annotations

import os
import queue
import shlex
import signal
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, as_completed
from typing import TYPE_CHECKING, NamedTuple

from turtle_class import ClassError, catalogue
from turtle_class.runner import CheckResult, Outcome, Runner
from turtle_class.seclusion import hidden
from turtlewire.terminal.printable import printable
from turtlewire.terminal.signal_watch import watched

if TYPE_CHECKING:
    from pathlib import Path

    from turtle_class.catalogue import ExerciseFolder
    from turtle_class.runner import Limits

__all__ = ["GradeReport", "grade_all", "students_in"]

#: Domains of the children, from here downwards; the usual ones begin at 0.
_LAST_DOMAIN = 101


class GradeReport(NamedTuple):
    """The results of a student.

    Attributes:
        student: The name of the student's folder, safe to show.
        slug: A name for files: letters of any script, digits, dashes, dots and underscores.
        outcomes: One for each exercise.
    """

    student: str
    slug: str
    outcomes: tuple[Outcome, ...]

    @property
    def passed(self) -> int:
        """Number of exercises that passed."""
        return sum(outcome.passed for outcome in self.outcomes)


def students_in(folder: Path, reports: Path) -> list[Path]:
    """Return the students' folders, by name.

    Args:
        folder: It has a folder for each student.
        reports: The folder of the reports, which may be there since the last time.

    Raises:
        ClassError: The folder does not exist, has no subfolders, or holds exercises.
    """
    if not folder.is_dir():
        raise ClassError(f"there is no folder {printable(str(folder))}")
    found = sorted(
        each
        for each in folder.iterdir()
        if each.is_dir()
        and not each.name.startswith(".")
        and not (reports.exists() and each.samefile(reports))
    )
    if not found:
        raise ClassError(
            f"{printable(str(folder))} holds no folders: it must have one for each student, with "
            "a folder for each exercise in it (ana/static/static_frame_broadcaster.py)"
        )
    if {each.name for each in found} <= {exercise.name for exercise in catalogue.exercises()}:
        raise ClassError(
            f"{printable(str(folder))} holds exercises, not a folder for each student: "
            f"`turtlewire class check {shlex.quote(printable(str(folder)))}` checks them"
        )
    return found


def grade_all(
    students: Sequence[Path],
    exercises: Sequence[ExerciseFolder],
    limits: Limits | None = None,
    tell: Callable[[str], object] = lambda _: None,
) -> list[GradeReport]:
    """Grade each exercise of each student in its own processes, one at a time for each core.

    On Linux, other processes of this user cannot read this one's memory meanwhile.

    Args:
        students: Their folders.
        exercises: What is graded.
        limits: The limits of each exercise; None uses the defaults.
        tell: Called with the progress after each exercise.

    Raises:
        KeyboardInterrupt: Ctrl-C. All that ran has been stopped.
    """
    runner = Runner(limits)
    interrupted = threading.Event()

    def interrupt() -> None:
        interrupted.set()
        runner.stop()

    with hidden(), watched([signal.SIGINT], interrupt):
        outcomes = _outcomes(runner, students, exercises, tell)
    if interrupted.is_set():  # a stopped child has reported no results
        raise KeyboardInterrupt
    slugs = _slugs(students)
    return [
        GradeReport(
            printable(student.name),
            slugs[student],
            tuple(outcomes[student, exercise.name].result() for exercise in exercises),
        )
        for student in students
    ]


def _outcomes(
    runner: Runner,
    students: Sequence[Path],
    exercises: Sequence[ExerciseFolder],
    tell: Callable[[str], object],
) -> dict[tuple[Path, str], Future[Outcome]]:
    """Return the outcomes by student and name of the exercise; all are done, or cancelled."""
    jobs = os.cpu_count() or 1
    domains: queue.SimpleQueue[int] = queue.SimpleQueue()
    for number in range(jobs):
        domains.put(_LAST_DOMAIN - number % (_LAST_DOMAIN + 1))

    def run(student: Path, exercise: ExerciseFolder) -> Outcome:
        domain = domains.get()
        try:
            return runner.run(exercise, student / exercise.name, domain)
        except Exception as error:  # noqa: BLE001 - the others still get their results
            return _ungraded(exercise, error)
        finally:
            domains.put(domain)

    pool = ThreadPoolExecutor(jobs)
    try:
        work = {
            (student, exercise.name): pool.submit(run, student, exercise)
            for student in students
            for exercise in exercises
        }
        for number, _ in enumerate(as_completed(work.values()), 1):
            tell(f"{number} of {len(work)} graded")
    finally:  # after Ctrl-C, no further exercise starts
        pool.shutdown(wait=False, cancel_futures=True)
        runner.stop()
    return work


def _ungraded(exercise: ExerciseFolder, error: Exception) -> Outcome:
    """Return the outcome of an exercise whose grading failed."""
    text, hint = f"It could not be graded: {error!r}", "Grade it alone, and report the error."
    result = CheckResult("It can be graded", "failed", text, hint)
    return Outcome(exercise, True, (result,), "", 0.0, {})


def _slugs(students: Sequence[Path]) -> dict[Path, str]:
    slugs: dict[Path, str] = {}
    taken = {"index"}  # the overview; file systems may ignore case
    for student in students:
        plain = "".join(
            letter if letter.isalnum() or letter in "._-" else "_" for letter in student.name
        )
        slug, number = plain, 1
        while slug.casefold() in taken:
            number += 1
            slug = f"{plain}-{number}"
        taken.add(slug.casefold())
        slugs[student] = slug
    return slugs
