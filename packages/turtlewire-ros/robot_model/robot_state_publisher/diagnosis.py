"""Log lines that say why transforms are missing; a real robot_state_publisher is silent there."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from turtlewire.terminal.printable import printable

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.timer import Timer
    from turtlewire.urdf import Joint, Robot

_PATIENCE = 2.0  # seconds without a joint that is known
_MOST_NAMES = 12


class Diagnosis:
    """Says once what goes wrong with joint states.

    Args:
        node: Whose logger and timers are used.

    Attributes:
        is_settled: A joint is known, or the warning about unknown joints was given.
        tells_of_skipping: The next joint state that is skipped is worth a line.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._robot: Robot | None = None
        self._timer: Timer | None = None
        self._unknown: dict[str, None] = {}
        self.is_settled = False
        self.tells_of_skipping = True

    def start(self, robot: Robot) -> None:
        """Restart with a new robot, and log its joints that no message moves."""
        self._robot = robot
        self._cancel()
        self._unknown.clear()
        self.is_settled = False
        for joint in robot.joints.values():
            if joint.type == "floating":
                self._node.get_logger().info(_floating(joint))

    def received(self, names: Iterable[str], knows_a_joint: bool) -> None:
        """Note a joint state; ``knows_a_joint`` says if one of its joints is the robot's."""
        if self.is_settled:
            return
        if knows_a_joint:
            self.is_settled = True
            self._cancel()
            return
        for name in names:
            # One more than are listed, for "and others".
            if len(self._unknown) <= _MOST_NAMES:
                self._unknown[name] = None
        # Waits, because several nodes may each publish a part of the joints.
        if self._timer is None and self._unknown:
            self._timer = self._node.create_timer(_PATIENCE, self._tell_of_unknown_joints)

    def skipped(self, stamp: int, last: int, interval_ms: int, frequency: float) -> None:
        """Log, once, that a joint state was skipped: its stamp is too near to the last one."""
        if not self.tells_of_skipping:
            return
        self.tells_of_skipping = False
        ignore = "ignore_timestamp true", "To publish them anyway"
        if stamp == last:
            what = f"whose stamp, {stamp / 1e9:.9f} s, does not advance"
            (setting, purpose) = ignore
        else:
            what = (
                f"whose stamps are less than {interval_ms} ms after the last one published, because"
                f" publish_frequency is {frequency:g}"
            )
            more = "publish_frequency 1000.0", "To publish more of them"
            # 1000 Hz is the highest frequency that the parameter allows.
            (setting, purpose) = more if frequency < 1000.0 else ignore
        name = self._node.get_fully_qualified_name()
        text = f"Skipping joint states {what}. {purpose}: ros2 param set {name} {setting}"
        self._node.get_logger().info(text)

    def frequency_changed(self) -> None:
        """Log the next skipped joint state again."""
        self.tells_of_skipping = True

    def _tell_of_unknown_joints(self) -> None:
        self.is_settled = True
        self._cancel()
        robot = self._robot
        assert robot is not None, "joint states are received after the start"
        missing = [joint.name for joint in robot.joints.values() if joint.moves]
        has = f"its moving joints are {_listed(missing)}" if missing else "none of its joints moves"
        self._node.get_logger().warning(
            f"No joint in the joint states is a moving joint of the robot '{printable(robot.name)}'"
            f", so no transforms are published: received {_listed(self._unknown)}; {has}."
        )

    def _cancel(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._node.destroy_timer(self._timer)
            self._timer = None


def _floating(joint: Joint) -> str:
    name, parent, child = printable(joint.name), printable(joint.parent), printable(joint.child)
    return (
        f"The joint '{name}' is floating, so its transform is not published here; another node must"
        f" publish it, from '{parent}' to '{child}'."
    )


def _listed(names: Iterable[str]) -> str:
    found = [printable(name) for name in names]
    rest = len(found) - _MOST_NAMES
    return ", ".join(found[:_MOST_NAMES]) + (" and others" if rest > 0 else "")
