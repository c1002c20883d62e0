"""A launch file for an exercise: runs on the network what the checks simulate."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from turtle_class.catalogue import LAUNCH_FILE
from turtle_lesson.lesson import load_lesson

if TYPE_CHECKING:
    from collections.abc import Iterator

    from turtle_class.catalogue import ExerciseFolder
    from turtle_lesson.lesson import Lesson, Program

__all__ = ["launch_text"]

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
