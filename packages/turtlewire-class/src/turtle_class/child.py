"""The checks of one exercise of one student: ``python -m turtle_class.child EXERCISE FOLDER``.

It writes each result to stdout as a line of JSON as soon as it is available. The student's code
runs in a separate process, which it starts, so that the code reaches neither checks nor results.
"""

from __future__ import annotations

from turtle_class.seclusion import hidden, hide

if __name__ == "__main__":
    hide()  # before the slow imports: code of others who are graded now may be looking for it

import json
import os
import sys
from pathlib import Path
from typing import Any

from turtle_class.student_process import StudentProcess
from turtle_lesson.grading import check_name, grade
from turtle_lesson.lesson import load_lesson

__all__ = ["main"]


def main(arguments: list[str]) -> None:
    """Grade.

    Args:
        arguments: The exercise's folder, and the student's.
    """
    lesson_folder, folder = map(Path, arguments)
    lesson = load_lesson(lesson_folder)
    files = {file: (folder / file).read_text(encoding="utf-8") for file in lesson.files}
    with hidden(), os.fdopen(os.dup(1), "w", encoding="utf-8") as output:
        os.dup2(2, 1)  # the output of nodes goes to the log

        def tell(**facts: Any) -> None:
            output.write(json.dumps(facts) + "\n")
            output.flush()

        tell(checks=[check_name(check) for check in lesson.checks()])
        student = StudentProcess(folder)
        try:
            for result in grade(lesson, files, programs=student.programs):
                tell(result=result._asdict())
        finally:
            student.close()
        tell(end=True)


if __name__ == "__main__":
    main(sys.argv[1:])
