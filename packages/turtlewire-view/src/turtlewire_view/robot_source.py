"""A robot as a source: its description, and its links where pages have moved the joints to."""

from __future__ import annotations

import math
import threading
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from turtlewire import msg
from turtlewire.terminal.suggestion import did_you_mean
from turtlewire.urdf.joints import followers_of
from turtlewire.web.commands import is_finite_number
from turtlewire_view.buffer_source import BufferSource

if TYPE_CHECKING:
    from turtlewire.tf.buffer import Buffer
    from turtlewire.urdf import Robot
    from turtlewire.urdf.robot import Positions

__all__ = ["RobotJoints", "RobotSource"]


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
