"""The joints' positions, shared by the node and the page: randomised, centred, set and played."""

from __future__ import annotations

import random
import threading
from typing import TYPE_CHECKING, Any, NamedTuple

from joint_state_publisher_gui.page_commands import Center, Play, Randomize, Set

if TYPE_CHECKING:
    from joint_state_publisher.joints import FreeJoint, JointSet
    from joint_state_publisher_gui.page_commands import Command

#: How long a joint that plays takes from one limit to the other [s], if its velocity allows it.
_SWEEP_S = 6.0


class Snapshot(NamedTuple):
    """The state of the sliders that the page shows.

    Attributes:
        version: Changes with the description.
        positions: The position of each joint [rad or m], in the order of the description.
        playing: Whether the joints move by themselves.
    """

    version: int
    positions: tuple[float, ...]
    playing: bool


class Sliders:
    """Guards a set of joints. Every method may be called from any thread."""

    def __init__(self, joints: JointSet) -> None:
        self.lock = threading.RLock()
        self._joints = joints
        self._version = 0
        self._playing = False

    def show(self, joints: JointSet) -> None:
        """Use the joints of another description."""
        with self.lock:
            self._joints = joints
            self._version += 1

    def obey(self, command: Command) -> None:
        """Carry out a command of the page; one for a joint that is gone does nothing."""
        # The joints' lock as well: the node's thread moves and publishes the same joints.
        with self.lock, self._joints.lock:
            if isinstance(command, Play):
                self._playing = command.on
            elif isinstance(command, Set):
                joint = self._joints.free.get(command.joint)
                if joint is not None:
                    joint.position = joint.clipped(command.position)
            else:
                for joint in self._joints.free.values():
                    joint.position = _position_after(command, joint)

    def advance(self, seconds: float) -> None:
        """Let the joints move on while they play."""
        with self.lock, self._joints.lock:
            if self._playing:
                for joint in self._joints.free.values():
                    joint.sweep(_speed(joint) * seconds)

    def snapshot(self) -> Snapshot:
        """Return the present positions."""
        with self.lock:
            positions = self._joints.state().positions
            return Snapshot(self._version, tuple(positions), self._playing)

    def description(self) -> dict[str, Any]:
        """Return names, limits and formulas, for the page."""
        with self.lock:
            return {
                "version": self._version,
                "robot": self._joints.robot,
                "joints": [self._describe(name) for name in self._joints.order],
            }

    def _describe(self, name: str) -> dict[str, Any]:
        mimic = self._joints.mimics.get(name)
        if mimic is not None:
            return {"name": name, "kind": self._joints.kinds[name], "mimic": mimic._asdict()}
        joint = self._joints.free[name]
        return {
            "name": name,
            "kind": joint.kind,
            "mimic": None,
            "minimum": joint.minimum,
            "maximum": joint.maximum,
            "zero": joint.zero,
            "max_velocity": joint.max_velocity,
        }


def _position_after(command: Randomize | Center, joint: FreeJoint) -> float:
    if isinstance(command, Randomize):
        return random.uniform(joint.minimum, joint.maximum)  # noqa: S311 - not for secrets
    return joint.zero


def _speed(joint: FreeJoint) -> float:
    """Return the speed of a playing joint [rad/s or m/s], at most its limit."""
    speed = (joint.maximum - joint.minimum) / _SWEEP_S
    # Many descriptions give 0 for an unknown limit.
    return min(speed, joint.max_velocity) if joint.max_velocity else speed
