"""Sources without a network: a buffer of the program, and a robot whose joints pages move."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

import numpy as np

from turtlewire import msg
from turtlewire.errors import TurtlewireError
from turtlewire_view.live import LiveTimeline, newest_stamp_ns
from turtlewire_view.robots import RobotJoints, zero_of
from turtlewire_view.source import OfflineSource, Topic

if TYPE_CHECKING:
    from turtlewire.msg import Message
    from turtlewire.tf.buffer import Buffer
    from turtlewire.urdf import Robot
    from turtlewire.urdf.robot import Positions

__all__ = [
    "BufferSource",
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
    joints: RobotJoints | None = None
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


def _start_of(robot: Robot, positions: Positions) -> dict[str, float]:
    """Return a position of each free joint."""
    rows = len(robot.within_limits(positions))
    if rows != 1:
        raise ValueError(
            f"show draws a robot at one position of each joint, and got {rows}; for several, pass "
            "the buffer robot.transforms(positions, stamps)"
        )
    start = {name: zero_of(robot, name) for name in robot.joint_names}
    if isinstance(positions, Mapping):
        given = {name: np.ravel(value)[0] for name, value in positions.items()}
    else:
        given = dict(zip(robot.joint_names, np.ravel(positions), strict=True))
    return start | {name: float(value) for name, value in given.items()}
