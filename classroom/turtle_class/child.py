"""One exercise of one student, in a process of its own: ``python -m turtle_class.child``.

It writes each result as a line of JSON as soon as it is there, so that those before a crash count.
This process protects the grader from mistakes. It is no sandbox for malice.
"""

from __future__ import annotations

import json
import os
import signal
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from turtle_lesson.grading import check_name, grade
from turtle_lesson.lesson import load_lesson

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["main"]

#: Computing time without a sign of life after which code counts as endless [s].
_PATIENCE_S = 5.0
_ONE_PROCESS = (
    "This exercise runs in one process: it neither starts programs nor ends others. Nodes are "
    "started by a launch file, or by the exercise."
)
_FORBIDDEN = frozenset(
    {
        *("os.fork", "os.forkpty", "os.posix_spawn", "os.spawn", "os.system", "os.startfile"),
        *("os.exec", "os.kill", "os.killpg", "subprocess.Popen", "pty.spawn"),
    }
)


class _ForbiddenError(RuntimeError):
    """The student's code starts or ends a process."""

    hint = _ONE_PROCESS


def main(arguments: list[str]) -> None:
    """Grade.

    Args:
        arguments: The file for the results, the exercise's folder, and the student's.
    """
    results, lesson_folder, folder = map(Path, arguments)
    lesson = load_lesson(lesson_folder)
    files = {file: (folder / file).read_text(encoding="utf-8") for file in lesson.files}
    this_process = os.getpid()
    with results.open("w", encoding="utf-8") as output:

        def tell(**facts: Any) -> None:
            if os.getpid() == this_process:
                output.write(json.dumps(facts) + "\n")
                output.flush()

        tell(checks=[check_name(check) for check in lesson.checks()])
        alive = _watchdog()
        sys.addaudithook(_refuse_processes)
        for result in grade(lesson, files, alive):
            tell(result=result._asdict())
            alive()
        tell(end=True)


def _watchdog() -> Callable[[], None]:
    """Interrupt code that computes without an end; a call of what this returns defers it."""
    if sys.platform == "win32":
        return lambda: None  # there, the limit of the whole run ends it

    def defer() -> None:
        signal.setitimer(signal.ITIMER_PROF, _PATIENCE_S, 1.0)

    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    signal.signal(signal.SIGPROF, interrupt)
    defer()
    return defer


def _refuse_processes(event: str, _: object) -> None:
    if event in _FORBIDDEN:
        raise _ForbiddenError(f"the program calls {event.replace('subprocess.Popen', 'a program')}")


if __name__ == "__main__":
    main(sys.argv[1:])
    # Threads and exit functions of the student's code must not hold up the end.
    os._exit(0)
