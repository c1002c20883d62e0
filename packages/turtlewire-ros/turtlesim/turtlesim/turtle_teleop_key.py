"""Drives turtle1 from a terminal: arrow keys are velocity commands, letters turn to a heading."""

from __future__ import annotations

import contextlib
import signal
import sys
import threading
from typing import TYPE_CHECKING, NamedTuple

import rclpy
from geometry_msgs.msg import Twist
from rclpy.action import ActionClient
from rclpy.executors import ExternalShutdownException
from rclpy.impl.unheard import warn_if_unheard
from turtlesim.action import RotateAbsolute
from turtlesim.cpp_node import CppNode
from turtlesim.turtle_endpoints import QUEUE_DEPTH
from turtlewire.terminal.keyboard import (
    ENDING_SIGNALS,
    Keyboard,
    foreground_terminal,
    signals_for_this_thread,
)

if TYPE_CHECKING:
    from rclpy.task import Future

BANNER = """\
Reading from keyboard
---------------------------
Use arrow keys to move the turtle.
Use G|B|V|C|D|E|R|T keys to rotate to absolute orientations. 'F' to cancel a rotation.
'Q' to quit."""
NO_TERMINAL = "Failed to get old console mode"
NO_TERMINAL_HINT = (
    "turtle_teleop_key reads keys from a terminal: run it, or launch it, in the foreground of one. "
    "The arrow keys also work in turtlesim's page."
)


class _Drive(NamedTuple):
    linear: float
    angular: float


#: An arrow key arrives as ESC, [ and one of these letters; as in the original only the letter
#: counts.
_DRIVES = {
    b"A": _Drive(1.0, 0.0),
    b"B": _Drive(-1.0, 0.0),
    b"C": _Drive(0.0, -1.0),
    b"D": _Drive(0.0, 1.0),
}
#: The keys around F with headings [rad]: each key means its own direction as seen from F.
_HEADINGS = {
    b"g": 0.0,
    b"t": 0.7854,
    b"r": 1.5708,
    b"e": 2.3562,
    b"d": 3.1416,
    b"c": -2.3562,
    b"v": -1.5708,
    b"b": -0.7854,
}
_CANCEL = b"f"
_QUIT = b"q"


class TeleopTurtle(CppNode):
    """Turns keys into commands for turtle1. Not for several threads."""

    def __init__(self) -> None:
        super().__init__("teleop_turtle")
        self.declare_parameter("scale_angular", 2.0)
        self.declare_parameter("scale_linear", 2.0)
        self._cmd_vel = self.create_publisher(Twist, "turtle1/cmd_vel", QUEUE_DEPTH)
        warn_if_unheard(self, self._cmd_vel)
        self._rotate = ActionClient(self, RotateAbsolute, "turtle1/rotate_absolute")
        self._goal: Future | None = None

    def press(self, key: bytes) -> None:
        """Act on one byte from the keyboard; most mean nothing."""
        if key in _DRIVES:
            self._drive(_DRIVES[key])
        elif key in _HEADINGS:
            self._goal = self._rotate.send_goal_async(RotateAbsolute.Goal(theta=_HEADINGS[key]))
        elif key == _CANCEL:
            self._cancel()

    def _drive(self, drive: _Drive) -> None:
        message = Twist()
        message.linear.x = self.get_parameter("scale_linear").value * drive.linear
        message.angular.z = self.get_parameter("scale_angular").value * drive.angular
        self._cmd_vel.publish(message)

    def _cancel(self) -> None:
        """Cancel the last rotation, if the simulator took it; one that has ended stays as it is."""
        if self._goal is not None and self._goal.done() and self._goal.result().accepted:
            self._goal.result().cancel_goal_async()


def main(args: list[str] | None = None) -> int:
    """Read keys until ``q``, Ctrl-C or the end of the terminal.

    Returns:
        The exit status: 1 when there is no terminal to read.
    """
    try:
        keyboard = Keyboard(foreground_terminal())
    except OSError:
        _complain(NO_TERMINAL, NO_TERMINAL_HINT)
        return 1
    # rclpy handles the other signals; these would leave the terminal without echo.
    with signals_for_this_thread(*ENDING_SIGNALS):
        rclpy.init(args=args)
        rclpy.get_default_context().on_shutdown(keyboard.stop)
        for signum in ENDING_SIGNALS:
            signal.signal(signum, lambda *_: keyboard.stop())
        node = TeleopTurtle()
        spinner = threading.Thread(target=_spin, args=(node,), name="teleop-spin")
        spinner.start()
    with contextlib.suppress(KeyboardInterrupt):  # Ctrl-C, which may also come while it shuts down
        try:
            with keyboard:
                print(BANNER, flush=True)  # noqa: T201 - the terminal is this program's face
                while (key := keyboard.read()) not in (b"", _QUIT):
                    node.press(key)
        finally:
            rclpy.try_shutdown()
            spinner.join()
            node.destroy_node()
    return 0


def _spin(node: CppNode) -> None:
    """Serve the node's parameters while the keyboard is read."""
    with contextlib.suppress(ExternalShutdownException):
        rclpy.spin(node)


def _complain(*lines: str) -> None:
    print(*lines, sep="\n", file=sys.stderr)  # noqa: T201 - there is no node yet that could log it


if __name__ == "__main__":
    sys.exit(main())
