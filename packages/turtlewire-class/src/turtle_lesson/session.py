"""A lesson's programs, run step by step for the page, and its panels next to the field."""

from __future__ import annotations

import contextlib
import json
from argparse import Namespace
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from rclpy.node import Node
from rclpy.time import Time
from rosidl_runtime_py import message_to_yaml
from rosidl_runtime_py.utilities import get_message
from tf2_ros import Buffer, TransformException, TransformListener
from tf2_ros.tf2_echo import describe
from turtle_lesson.exercise import exercise_of
from turtle_lesson.mistakes import mistake_of
from turtlesim.model import TICK_NS
from turtlesim.picture import FieldPicture, Scene
from turtlesim.testing import faults
from turtlesim.transform_view import TransformView, field_frames
from turtlewire.doctor.examination import report
from turtlewire.doctor.graph_findings import graph_findings
from turtlewire.doctor.tf_findings import tf_findings
from turtlewire.doctor.tf_traffic import TfListener

if TYPE_CHECKING:
    from rclpy.subscription import Subscription
    from turtle_lesson.lesson import Lesson
    from turtlesim.testing import Simulation
    from turtlesim.testing.faults import Fault

__all__ = ["LessonSession"]

#: Simulated time between two texts for the page [ticks].
_WATCH_TICKS = 12
#: As long as the doctor listens to the transforms [ticks].
_DOCTOR_TICKS = 188


class LessonSession:
    """A lesson that runs. The page makes one at each press of Run, and closes it before the next.

    Args:
        lesson: The lesson.
        files: The student's files.
        faults: Names of faults that are switched on.
    """

    def __init__(
        self, lesson: Lesson, files: Mapping[str, str], faults: Sequence[str] = ()
    ) -> None:
        self._files = files
        self._faults = faults
        self._screen = _LessonScreen()
        self._stack = contextlib.ExitStack()
        self._mistake: str | None = None
        self._ticks = self._next_watch = 0
        self._doctor: _Doctor | None = None
        self._doctor_ends = 0
        self._field_frames: tuple[str, list[str]] = ("", [])
        try:
            exercise = self._stack.enter_context(exercise_of(lesson, files, self._prepare))
        except BaseException as error:  # noqa: BLE001 - students raise anything
            self._note(error)
            return
        self._simulation = exercise.simulation
        watcher = self._simulation.start(lambda: Node("watcher"), name="_watcher")
        self._watcher = watcher
        self._topic_echo, self._transform_echo = _TopicEcho(watcher), _TransformEcho(watcher)
        self._transforms = TransformView(
            watcher.context.wire, "/", lambda: round(exercise.simulation.now * 1e9)
        )
        self._transforms.join()
        self._stack.callback(self._transforms.close)

    def _prepare(self, simulation: Simulation) -> None:
        simulation.node.show_on(self._screen)
        for name in self._faults:
            simulation.inject(_FAULTS[name]())

    def _note(self, error: BaseException) -> None:
        self._mistake = json.dumps(mistake_of(error, self._files)._asdict())
        self.close()

    def close(self) -> None:
        """End all nodes."""
        # A callback that was interrupted may leave a node that cannot be closed.
        with contextlib.suppress(Exception):
            self._stack.close()

    @property
    def mistake(self) -> str | None:
        """The error that ended the session, as JSON."""
        return self._mistake

    def step(self, ticks: int, wishes: str) -> list[str]:
        """Let time pass.

        Args:
            ticks: How many times 16 ms.
            wishes: JSON object of what the page wants: ``drive`` (a list of `[turtle, linear,
                angular]`), ``target`` and ``source`` (frames), ``axes`` (whether the frames are
                drawn on the field), ``topic``.

        Returns:
            Texts for the page, each a JSON object with a ``type``.
        """
        if self._mistake is not None:
            return []
        wanted = json.loads(wishes)
        try:
            for turtle, linear, angular in wanted.get("drive", ()):
                self._simulation.drive(turtle, linear, angular)
            self._simulation.step(ticks)
        except BaseException as error:  # noqa: BLE001 - students raise anything
            self._note(error)
            return []
        self._ticks += ticks
        return self._texts(wanted)

    def frame(self) -> bytes:
        """Return the picture, as turtlesim's page understands it."""
        return self._screen.take_frame()

    def examine(self) -> None:
        """Start the doctor; a later step returns its report."""
        self._doctor = _Doctor(self._watcher)
        self._doctor_ends = self._ticks + _DOCTOR_TICKS

    def _texts(self, wanted: dict[str, Any]) -> list[str]:
        scene = self._screen.take_scene()
        texts = [] if scene is None else [scene]
        if self._doctor is not None and self._ticks >= self._doctor_ends:
            texts.append(json.dumps({"type": "doctor", "text": self._doctor.report()}))
            self._doctor = None
        if self._ticks >= self._next_watch:
            self._next_watch = self._ticks + _WATCH_TICKS
            texts += self._watched(wanted)
        if wanted.get("axes"):
            axes = self._transforms.axes(*self._field_frames)
            texts.append(json.dumps({"type": "axes", "frames": axes}))
        return texts

    def _watched(self, wanted: dict[str, Any]) -> list[str]:
        target, source = wanted.get("target"), wanted.get("source")
        relation = self._transforms.relation(target, source) if target and source else None
        frames = self._transforms.frames()
        self._field_frames = field_frames(frames, self._screen.turtles)
        tf = {"type": "tf", "frames": frames, "target": target, "source": source}
        echo = {
            "type": "echo",
            "seconds": round(self._ticks * TICK_NS / 1e9, 1),
            "topics": _topics_of(self._watcher),
            "topic": self._topic_echo.text(wanted.get("topic") or ""),
            "transform": self._transform_echo.text(target, source) if target and source else "",
        }
        return [json.dumps({**tf, "relation": relation}), json.dumps(echo)]


_FAULTS: dict[str, Callable[[], Fault]] = {
    "delay": lambda: faults.Delay(3.0, "turtle1"),
    "loss": lambda: faults.Loss(0.9),
    "wrong_frame": lambda: faults.WrongFrame("turtle1", "wolrd"),
    "wrong_time": lambda: faults.WrongTime(5.0, "turtle1"),
    "missing_static": lambda: faults.MissingStatic("tower"),
    "two_publishers": lambda: faults.TwoPublishers("turtle1", x=9.0, y=9.0),
}
"""What each name stands for."""


class _LessonScreen(FieldPicture):
    """Takes what the simulator draws; the page fetches it after each step."""

    def __init__(self) -> None:
        super().__init__(Scene("", (), (0, 0, 0), ()))
        self._seen_version = 0
        self._position = -1

    def close(self) -> None:
        """Nothing is open."""

    @property
    def turtles(self) -> tuple[str, ...]:
        """Names of all turtles."""
        return self.scene.turtles

    def take_scene(self) -> str | None:
        """Return the scene as JSON if it has changed since the last call."""
        self._seen_version, scene = self.scene_since(self._seen_version)
        return scene

    def take_frame(self) -> bytes:
        """Return the newest poses, and the strokes since the last call."""
        self._position, frame = self.frame_since(self._position)
        return frame


_ECHO_OPTIONS = Namespace(precision=3, degrees=False, distance=False)
_HIDDEN = {"/clock", "/parameter_events", "/rosout"}


def _topics_of(node: Node) -> list[str]:
    """Topics with a publisher, for the list of the page."""
    return sorted(
        name
        for name, _ in node.get_topic_names_and_types()
        if name not in _HIDDEN and "/_action/" not in name and node.count_publishers(name)
    )


class _TopicEcho:
    """The newest message of a topic, as ``ros2 topic echo`` prints it.

    Args:
        node: Subscribes.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._topic = ""
        self._subscription: Subscription[Any] | None = None
        self._newest: Any = None

    def text(self, topic: str) -> str:
        """Return the newest message; empty until one has come."""
        if topic != self._topic:
            self._change(topic)
        return "" if self._newest is None else f"{message_to_yaml(self._newest)}---"

    def _change(self, topic: str) -> None:
        publishers = self._node.get_publishers_info_by_topic(topic) if topic else []
        if self._subscription is not None:
            self._node.destroy_subscription(self._subscription)
            self._subscription = None
        self._newest = None
        self._topic = topic if publishers else ""  # asked for again until a node publishes it
        if publishers:
            self._subscription = self._node.create_subscription(
                get_message(publishers[0].topic_type),
                topic,
                self._take,
                publishers[0].qos_profile,
            )

    def _take(self, message: Any) -> None:
        self._newest = message


class _TransformEcho:
    """A transform as ``tf2_echo`` prints it.

    Args:
        node: Listens.
    """

    def __init__(self, node: Node) -> None:
        self._buffer = Buffer(node=node)
        self._listener = TransformListener(self._buffer, node)

    def text(self, target: str, source: str) -> str:
        """Return the newest transform, or the error with its hint."""
        try:
            return describe(self._buffer.lookup_transform(target, source, Time()), _ECHO_OPTIONS)
        except TransformException as error:
            return f"{error}\n{error.hint}".strip()


class _Doctor:
    """Listens to the transforms from now on, for a report of ``turtlewire doctor``.

    Args:
        node: A node of the graph that is examined.
    """

    def __init__(self, node: Node) -> None:
        self._wire = node.context.wire
        self._listener = TfListener(self._wire)

    def report(self) -> str:
        """Stop listening and say what is wrong."""
        traffic = self._listener.close()
        graph = self._wire.graph
        return report([*graph_findings(graph), *tf_findings(graph, traffic)])
