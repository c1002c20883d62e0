"""The verbs that grade and hand out files; `turtlewire class` calls them."""

from __future__ import annotations

import contextlib
import json
import os
import shlex
import signal
import sys
import threading
import time
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from turtle_class import ClassError
from turtle_class.catalogue import LAUNCH_FILE, chosen, exercises
from turtle_class.grading import grade_all, students_in
from turtle_class.pages import as_junit, overview, student_page
from turtle_class.runner import Limits
from turtle_lesson.lesson import load_lesson
from turtlewire.new_file import new_file
from turtlewire.terminal.printable import printable
from turtlewire.wording import counted

if TYPE_CHECKING:
    from pathlib import Path

    from turtle_class.catalogue import ExerciseFolder
    from turtle_class.grading import GradeReport
    from turtle_lesson.lesson import Lesson, Program

__all__ = [
    "check",
    "grade",
    "launch_text",
    "list_exercises",
    "show",
    "start",
]

_TEXT = '''\
"""{title}.

Run it: ros2 launch {file} (Ctrl-C ends it).
"""

import os
import shutil
import sys
from pathlib import Path

from launch import LaunchDescription
from launch.actions import ExecuteProcess
from launch_ros.actions import Node

HERE = Path(__file__).resolve().parent
BESIDE_PYTHON = f"{{Path(sys.executable).parent}}{{os.pathsep}}{{os.environ['PATH']}}"
ROS2 = shutil.which("ros2", path=BESIDE_PYTHON) or "ros2"


def generate_launch_description():
    return LaunchDescription(
        [
            Node(package="turtlesim", executable="turtlesim_node", name="sim"),
{actions}
        ]
    )
'''


def launch_text(exercise: ExerciseFolder) -> str:
    """Return a launch file that starts turtlesim, its turtles, and the programs of an exercise.

    The files of the student are run by Python from the launch file's own folder.
    """
    actions = "\n".join(" " * 12 + line for line in _actions(load_lesson(exercise.folder)))
    return _TEXT.format(title=exercise.title, file=LAUNCH_FILE, actions=actions)


def _actions(lesson: Lesson) -> Iterator[str]:
    for turtle in lesson.turtles:
        place = f"{{x: {turtle.x}, y: {turtle.y}, theta: {turtle.theta}, name: {turtle.name}}}"
        words = ["service", "call", "/spawn", "turtlesim/srv/Spawn", place]
        yield from _process(["ROS2", *map(json.dumps, words)])
    for program in lesson.programs:
        if program.source in lesson.files:
            yield from _own_file(program)
        else:
            yield from _installed(program)


def _own_file(program: Program) -> Iterator[str]:
    given = ["-r", f"__node:={program.name}"] if program.name else []
    for name, value in program.parameters.items():
        given += ["-p", f"{name}:={value}"]
    words = [*program.arguments, *(["--ros-args", *given] if given else [])]
    file = f"str(HERE / {json.dumps(program.source)})"
    yield from _process(["sys.executable", file, *map(json.dumps, words)], output="screen")


def _process(command: list[str], output: str = "log") -> Iterator[str]:
    """Yield the action for a command, each of whose words is Python's text for it."""
    yield "ExecuteProcess("
    yield "    cmd=["
    yield from (f"        {word}," for word in command)
    yield "    ],"
    yield f'    output="{output}",'
    yield "),"


def _installed(program: Program) -> Iterator[str]:
    package, executable = program.source.split(".")
    yield "Node("
    yield f'    package="{package}",'
    yield f'    executable="{executable}",'
    if program.name:
        yield f'    name="{program.name}",'
    if program.arguments:
        yield f"    arguments={json.dumps(program.arguments)},"
    if program.parameters:
        yield f"    parameters=[{json.dumps(dict(program.parameters))}],"
    yield "),"


def list_exercises(*, as_json: bool = False) -> None:
    """Print the exercises.

    Args:
        as_json: Print one JSON object instead of a table.
    """
    if as_json:
        listed = [{"name": exercise.name, "title": exercise.title} for exercise in exercises()]
        print(json.dumps({"exercises": listed}))  # noqa: T201
        return
    width = max(len(exercise.name) for exercise in exercises())
    for exercise in exercises():
        print(f"{exercise.name:{width}}  {exercise.title}")  # noqa: T201


def start(folder: Path, names: Sequence[str]) -> None:
    """Write the first files and the texts of exercises into a folder.

    Raises:
        ClassError: No such exercise, or a file exists already.
    """
    wanted = {
        folder / exercise.name / name: text
        for exercise in chosen(names)
        for name, text in {
            "README.md": exercise.plain_text(),
            LAUNCH_FILE: launch_text(exercise),
            **load_lesson(exercise.folder).starter(),
        }.items()
    }
    there = [path for path in wanted if path.exists()]
    if there:
        raise ClassError(f"{printable(str(there[0]))} exists already; nothing was written")
    for path, text in wanted.items():
        _write(path, text)
    made = counted(len({path.parent for path in wanted}), "exercise")
    print(f"{made} in {printable(str(folder))}")  # noqa: T201


def check(folder: Path, names: Sequence[str], limit_s: float, junit: Path | None) -> int:
    """Grade one student's folder, and print what helps; the exit status."""
    if not folder.is_dir():
        raise ClassError(f"there is no folder {printable(str(folder))}")
    wanted = chosen(names)
    if not names:  # what the folder holds
        wanted = [exercise for exercise in wanted if (folder / exercise.name).is_dir()]
    if not wanted:
        here = folder.resolve()
        if here.name in (exercise.name for exercise in exercises()):
            above = shlex.quote(printable(os.path.relpath(here.parent)))
            raise ClassError(
                f"{printable(str(folder))} is a single exercise: "
                f"`turtlewire class check {above} -e {here.name}` checks it"
            )
        raise ClassError(
            f"{printable(str(folder))} holds no exercise: `turtlewire class start "
            f"{printable(str(folder))}` puts their first files there"
        )
    [report] = grade_all([folder.resolve()], wanted, Limits(seconds=limit_s), _progress)
    _progress("")
    if junit is not None:
        _write(junit, as_junit(report))
    for line in _lines(report):
        print(line)  # noqa: T201
    return 0 if report.passed == len(report.outcomes) else 1


def _lines(report: GradeReport) -> Iterator[str]:
    for outcome in report.outcomes:
        checks = counted(len(outcome.results), "check")
        state = "solved" if outcome.passed else f"{outcome.points} of {checks}"
        yield f"{outcome.exercise.name}: {state}"
        for result in outcome.results:
            if result.state == "failed" or not outcome.handed_in:
                place = f"{result.file}, line {result.line}: " if result.line else ""
                yield f"    {printable(result.check)}"
                yield f"    {printable(place + result.text)}"
                yield f"    {printable(result.hint)}"


def grade(folder: Path, names: Sequence[str], limit_s: float, output: Path) -> None:
    """Grade all students' folders in a folder, and write the reports.

    Raises:
        ClassError: No students were found, an exercise does not exist, or the reports cannot be
            written.
    """
    students, wanted = students_in(folder, output), chosen(names)
    if output.exists() and not output.is_dir():
        raise ClassError(f"{printable(str(output))} is not a folder for the reports")
    reports = grade_all(students, wanted, Limits(seconds=limit_s), _progress)
    _progress("")
    when = time.strftime("%Y-%m-%d %H:%M")
    for report in reports:
        page = student_page(report, when)
        _write(output / f"{report.slug}.html", page)
        _write(output / "junit" / f"{report.slug}.xml", as_junit(report))
    title = f"Exercises of {folder.resolve().name}"
    _write(output / "index.html", overview(reports, title, when))
    width = max(len(report.student) for report in reports)
    for report in reports:
        print(f"{report.student:{width}}  {report.passed} of {len(wanted)} solved")  # noqa: T201
    print(f"The reports are at {printable(str(output / 'index.html'))}")  # noqa: T201


def _write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    with new_file(path) as unfinished, open(unfinished, "w", encoding="utf-8") as file:
        file.write(text)


def show(domains: str, roster: Path | None, port: int | None, *, lan: bool) -> None:
    """Serve the page of the class until Ctrl-C or SIGTERM.

    Raises:
        ClassError: The domains or the roster are wrong, or a domain cannot be joined.
    """
    from turtle_class.roster import read_roster, seats_of_domains

    seats = seats_of_domains(domains) if roster is None else read_roster(roster)
    # The next imports are slow, and an invalid roster is reported before them.
    from turtle_class.show import ClassPage
    from turtlewire.errors import WireError
    from turtlewire.web.desktop import open_browser, wanted_lan
    from turtlewire.web.lan import invite

    ended = threading.Event()
    signal.signal(signal.SIGTERM, lambda *_: ended.set())
    lan = lan or wanted_lan()
    try:
        page = ClassPage(seats, port=port, lan=lan)
    except WireError as error:
        raise ClassError(f"{error} {error.hint}".rstrip()) from None
    with contextlib.ExitStack() as at_the_end:
        at_the_end.callback(_progress, "")
        at_the_end.callback(page.close)
        at_the_end.callback(_progress, f"Leaving {len(seats)} domains …")
        print(  # noqa: T201
            f"The class of {len(seats)} is at {page.url} (Ctrl-C ends it)", flush=True
        )
        if lan:
            invite(page.url, print)
        open_browser(page.url)
        ended.wait()


def _progress(text: str) -> None:
    """Replace the line of progress, if a terminal shows it."""
    if sys.stderr.isatty():
        sys.stderr.write(f"\r\x1b[K{text}")
        sys.stderr.flush()
