"""A simulation that runs the programs of a lesson and that checks examine."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator, Mapping
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, NamedTuple

from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import Buffer, TransformException, TransformListener
from tf_transformations import euler_from_quaternion
from turtle_lesson.lesson import imported
from turtlesim.testing import Simulation
from turtlesim.testing.programs import ProgramError, rclpy_in_step

if TYPE_CHECKING:
    from contextlib import AbstractContextManager

    from turtle_lesson.lesson import Lesson, Program
    from turtlesim.testing.stage import Stage

__all__ = ["Exercise", "FramePlace", "NotYet", "exercise_of", "programs_here", "start_program"]

#: Simulated time at the start [s], so that lookups of the recent past have an answer.
_BEGIN = 100.0
_NO_MAIN = "Keep the function main() at the end of the file: `ros2 run` also calls it."


class NotYet(Exception):
    """A check that is not passed: what was seen, and what helps.

    Attributes:
        hint: What helps.
    """

    def __init__(self, text: str, hint: str) -> None:
        super().__init__(text)
        self.hint = hint


class FramePlace(NamedTuple):
    """The pose of a frame: metres ahead and to the left, and radians to the left."""

    x: float
    y: float
    yaw: float


class Exercise:
    """The simulation, the student's files in it, and a TF buffer.

    Attributes:
        simulation: Turtlesim and all nodes, in lock-step.
        files: Source texts of the student by file name.
        buffer: Knows all transforms.
    """

    def __init__(self, simulation: Simulation, files: Mapping[str, str]) -> None:
        self.simulation = simulation
        self.files = files
        self._observer = simulation.start(lambda: Node("observer"), name="_observer")
        self.buffer = Buffer(node=self._observer)
        self._listener = TransformListener(self.buffer, self._observer)

    def call_regularly(self, call: Callable[[], object]) -> None:
        """Call a function twice in a simulated second."""
        self._observer.create_timer(0.5, call)

    def place(self, target: str, source: str, hint: str = "") -> FramePlace:
        """Return the pose of ``source`` in ``target`` at the latest known time.

        Raises:
            NotYet: TF does not know; tf2 says why. The hint is this, or the buffer's.
        """
        try:
            found = self.buffer.lookup_transform(target, source, Time()).transform
        except TransformException as error:
            raise NotYet(
                f"TF cannot say where {source} is as {target} sees it: {error}", hint or error.hint
            ) from error
        rotation = found.rotation
        _, _, yaw = euler_from_quaternion((rotation.x, rotation.y, rotation.z, rotation.w))
        return FramePlace(found.translation.x, found.translation.y, yaw)

    def stamp(self, target: str, source: str) -> float:
        """Return the newest time at which the two are known [s].

        Raises:
            NotYet: TF does not know; tf2 says why.
        """
        self.place(target, source)
        stamp = self.buffer.lookup_transform(target, source, Time()).header.stamp
        return float(stamp.sec + stamp.nanosec / 1e9)

    def another_buffer(self) -> Buffer:
        """Return a buffer that listens from now on."""
        buffer = Buffer(node=self._observer)
        self._late = TransformListener(buffer, self._observer)
        return buffer

    def frames(self) -> dict[str, str]:
        """Return each frame's parent."""
        import yaml

        told = yaml.safe_load(self.buffer.all_frames_as_yaml())
        return {frame: facts["parent"] for frame, facts in told.items()} if told else {}

    def expect(self, condition: bool, text: str, hint: str) -> None:
        """Fail the check with what was seen and what helps, unless the condition is true."""
        if not condition:
            raise NotYet(text, hint)


def start_program(stage: Stage, program: Program, modules: Mapping[str, ModuleType]) -> None:
    """Start a program of a lesson.

    Args:
        stage: Where its nodes take part.
        program: The program.
        modules: The student's files; other programs are imported.

    Raises:
        BaseException: Whatever its code raises at its start.
    """
    module = modules.get(program.source)
    if module is None:
        with rclpy_in_step():
            module = import_module(program.source)
    main = getattr(module, "main", None)
    if not callable(main):
        raise ProgramError(f"{program.source} has no function main()", _NO_MAIN)
    name = {"name": program.name} if program.name else {}
    stage.start_program(main, *program.arguments, **name, **program.parameters)


@contextlib.contextmanager
def programs_here(stage: Stage, files: Mapping[str, str]) -> Iterator[Callable[[Program], None]]:
    """Import the student's files; yields what starts a program in this process.

    Raises:
        BaseException: Whatever the student's code raises when it is imported.
    """
    with contextlib.ExitStack() as stack:
        with rclpy_in_step():
            modules = stack.enter_context(imported(files))
        yield lambda program: start_program(stage, program, modules)


@contextlib.contextmanager
def exercise_of(
    lesson: Lesson,
    files: Mapping[str, str],
    prepare: Callable[[Simulation], None] = lambda _: None,
    programs: Callable[
        [Simulation, Mapping[str, str]], AbstractContextManager[Callable[[Program], None]]
    ] = programs_here,
) -> Iterator[Exercise]:
    """Open a simulation and start the programs of a lesson in it.

    Args:
        lesson: The lesson.
        files: The student's files.
        prepare: Called with the simulation before anything else is in it.
        programs: Where the programs run: :func:`programs_here`, or in another process.

    Raises:
        BaseException: Whatever the student's code raises at its start.
    """
    with Simulation(begin=_BEGIN) as simulation:
        prepare(simulation)
        for turtle in lesson.turtles:
            simulation.spawn(turtle.name, x=turtle.x, y=turtle.y, theta=turtle.theta)
        exercise = Exercise(simulation, files)
        with programs(simulation, files) as start:
            for program in lesson.programs:
                start(program)
            yield exercise
