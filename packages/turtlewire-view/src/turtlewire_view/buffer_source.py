"""Sources without a network: a buffer of the program, and a robot whose joints pages move."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from turtlewire import msg
from turtlewire.errors import TurtlewireError
from turtlewire.terminal.suggestion import did_you_mean
from turtlewire.urdf.joints import followers_of
from turtlewire.web.commands import is_finite_number
from turtlewire_view.live import LiveTimeline, newest_stamp_ns
from turtlewire_view.source import Joints, OfflineSource, Topic

if TYPE_CHECKING:
    from turtlewire.msg import Message
    from turtlewire.tf.buffer import Buffer
    from turtlewire.urdf import Robot
    from turtlewire.urdf.robot import Positions

__all__ = [
    "BufferSource",
    "RobotJoints",
    "RobotSource",
]

#: The page can go back to the first sample of a buffer.
_ALL_NS = 1 << 62


class BufferSource(OfflineSource):
    """The frames of a buffer. Pages follow its changes, and can go back to all of its samples.

    Args:
        buffer: The frames.
        name: What the page calls it.
        messages: A message of each topic.
    """

    kind = "live"
    _WHAT = "a buffer"
    joints: Joints | None = None
    problem = ""
    history_ns = _ALL_NS

    def __init__(
        self, buffer: Buffer, name: str, messages: Mapping[str, Message] | None = None
    ) -> None:
        self.buffer = buffer
        self.name = name
        self._messages = dict(messages or {})
        self._ends: list[Callable[[], None]] = []

    def now_ns(self) -> int:
        """Return the newest stamp; the system time if all transforms are static."""
        newest = newest_stamp_ns(self.buffer)
        return time.time_ns() if newest is None else newest

    def new_timeline(self) -> LiveTimeline:
        """Return a page's own time, which follows the buffer until the page is paused."""
        return LiveTimeline(self)

    def topics(self) -> list[Topic]:
        """Return the topics of the messages."""
        return [
            Topic(name, msg.type_name(type(message)), 1)
            for name, message in sorted(self._messages.items())
        ]

    def subscribe(
        self,
        topic: str,
        type_name: str,  # noqa: ARG002 - Source's
        on_message: Callable[[bytes], None],
    ) -> Callable[[], None]:
        """Deliver the topic's message at once."""
        if topic in self._messages:
            on_message(msg.serialize(self._messages[topic]))
        return lambda: None

    def publish(self, topic: str, type_name: str, cdr: bytes) -> int:  # noqa: ARG002 - Source's
        """Refused.

        Raises:
            TurtlewireError: Always.
        """
        raise TurtlewireError(
            f"The view shows a buffer, not a network, so nothing was published on {topic}."
        )

    def on_change(self, call: Callable[[], None]) -> None:
        """Call ``call()`` on the threads that write to the buffer."""
        self._ends.append(self.buffer.on_change(call))

    def close(self) -> None:
        """Stop following the buffer."""
        while self._ends:
            self._ends.pop()()


class RobotSource(BufferSource):
    """A robot whose joints pages can move.

    Args:
        robot: The robot.
        positions: One position of each joint, as for `Robot.link_poses`. Joints that are not named
            are at 0, or in the middle of their limits if these exclude 0.

    Raises:
        KeyError: No free joint has such a name.
        ValueError: A joint has several positions.
    """

    def __init__(self, robot: Robot, positions: Positions | None = None) -> None:
        start = _start_of(robot, {} if positions is None else positions)
        description = msg.get_message("std_msgs/msg/String")(data=robot.xml)
        buffer = robot.transforms(start)
        super().__init__(buffer, robot.name, {"/robot_description": description})
        self.joints = RobotJoints(robot, start, buffer)


class RobotJoints:
    """The joints of a robot; all pages share them. Thread-safe.

    Args:
        robot: The robot.
        positions: The position of each free joint [rad or m].
        buffer: Has the transforms of all links, and gets new ones.
    """

    def __init__(self, robot: Robot, positions: dict[str, float], buffer: Buffer) -> None:
        self._robot = robot
        self._positions = positions
        self._buffer = buffer
        self._lock = threading.Lock()
        self._followers = followers_of(robot)
        self._moving = [each for each in robot.joints.values() if each.moves]

    def description(self) -> list[dict[str, Any]]:
        """Return name, kind, limits and formula of each joint, in the order of the file."""
        return [self._describe(each.name, each.type) for each in self._moving]

    def positions(self) -> list[float]:
        """Return where the joints of :meth:`description` are [rad or m]."""
        with self._lock:
            return [self._position(each.name) for each in self._moving]

    def move(self, positions: Mapping[str, Any]) -> None:
        """Move joints, within their limits.

        Args:
            positions: Positions of free joints by name [rad or m].

        Raises:
            ValueError: The robot has no such joint, or a position is not a finite number.
        """
        for name, position in positions.items():
            if name not in self._positions:
                near = did_you_mean(name, self._positions)
                raise ValueError(f"the robot has no free joint {name!r:.100}. {near}".rstrip())
            if not is_finite_number(position):
                raise ValueError(
                    f"the position of {name!r} must be a number, got {position!r:.100}"
                )
        with self._lock:
            for name, position in positions.items():
                low, high = _limits(self._robot, name)
                self._positions[name] = min(max(float(position), low), high)
            self._write()

    def _write(self) -> None:
        moved = self._robot.transforms(self._positions)
        for joint in self._moving:
            link = moved.lookup_transform(joint.parent, joint.child)
            self._buffer.set_static_transform(
                joint.parent, joint.child, link.translation, link.rotation
            )

    def _position(self, name: str) -> float:
        follower = self._followers.get(name)
        if follower is None:
            return self._positions[name]
        return self._positions[follower.leader] * follower.multiplier + follower.offset

    def _describe(self, name: str, kind: str) -> dict[str, Any]:
        follower = self._followers.get(name)
        if follower is not None:
            formula = {
                "parent": follower.leader,
                "factor": follower.multiplier,
                "offset": follower.offset,
            }
            return {"name": name, "kind": kind, "mimic": formula}
        low, high = _limits(self._robot, name)
        limits = self._robot.joints[name].limits
        return {
            "name": name,
            "kind": kind,
            "mimic": None,
            "minimum": low,
            "maximum": high,
            "zero": _zero(self._robot, name),
            "max_velocity": limits.velocity if limits and math.isfinite(limits.velocity) else None,
        }


def _start_of(robot: Robot, positions: Positions) -> dict[str, float]:
    """Return a position of each free joint."""
    rows = len(robot.within_limits(positions))
    if rows != 1:
        raise ValueError(
            f"show draws a robot at one position of each joint, and got {rows}; for several, pass "
            "the buffer robot.transforms(positions, stamps)"
        )
    start = {name: _zero(robot, name) for name in robot.joint_names}
    if isinstance(positions, Mapping):
        given = {name: np.ravel(value)[0] for name, value in positions.items()}
    else:
        given = dict(zip(robot.joint_names, np.ravel(positions), strict=True))
    return start | {name: float(value) for name, value in given.items()}


def _limits(robot: Robot, name: str) -> tuple[float, float]:
    """Return the least and the greatest position; a continuous joint makes one turn."""
    column = robot.joint_names.index(name)
    low, high = float(robot.lower[column]), float(robot.upper[column])
    return (low, high) if math.isfinite(low) and math.isfinite(high) else (-math.pi, math.pi)


def _zero(robot: Robot, name: str) -> float:
    low, high = _limits(robot, name)
    return 0.0 if low <= 0.0 <= high else (low + high) / 2
