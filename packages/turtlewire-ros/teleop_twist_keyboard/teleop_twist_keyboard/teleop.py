"""Keys to velocities, and the node that publishes them."""

from __future__ import annotations

import contextlib
import signal
import sys
import threading
from collections.abc import Callable
from typing import Any

import rclpy
from geometry_msgs.msg import Twist, TwistStamped
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.executors import ExternalShutdownException
from rclpy.impl.unheard import warn_if_unheard
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from turtlewire.terminal.keyboard import (
    ENDING_SIGNALS,
    Keyboard,
    foreground_terminal,
    signals_for_this_thread,
)

BANNER = """
This node takes keypresses from the keyboard and publishes them
as Twist/TwistStamped messages. It works best with a US keyboard layout.
---------------------------
Moving around:
   u    i    o
   j    k    l
   m    ,    .

For Holonomic mode (strafing), hold down the shift key:
---------------------------
   U    I    O
   J    K    L
   M    <    >

t : up (+z)
b : down (-z)

anything else : stop

q/z : increase/decrease max speeds by 10%
w/x : increase/decrease only linear speed by 10%
e/c : increase/decrease only angular speed by 10%

CTRL-C to quit
"""
_NO_TERMINAL = (
    "teleop_twist_keyboard reads keys from a terminal: run it, or launch it, in the foreground of "
    "one."
)

#: Key to directions: x, y, z and the rotation about z.
_MOVES = {
    "i": (1, 0, 0, 0),
    "o": (1, 0, 0, -1),
    "j": (0, 0, 0, 1),
    "l": (0, 0, 0, -1),
    "u": (1, 0, 0, 1),
    ",": (-1, 0, 0, 0),
    ".": (-1, 0, 0, 1),
    "m": (-1, 0, 0, -1),
    "O": (1, -1, 0, 0),
    "I": (1, 0, 0, 0),
    "J": (0, 1, 0, 0),
    "L": (0, -1, 0, 0),
    "U": (1, 1, 0, 0),
    "<": (-1, 0, 0, 0),
    ">": (-1, -1, 0, 0),
    "M": (-1, 1, 0, 0),
    "t": (0, 0, 1, 0),
    "b": (0, 0, -1, 0),
}
#: Key to factors of speed and turn.
_SPEEDS = {
    "q": (1.1, 1.1),
    "z": (0.9, 0.9),
    "w": (1.1, 1.0),
    "x": (0.9, 1.0),
    "e": (1.0, 1.1),
    "c": (1.0, 0.9),
}
_CTRL_C = "\x03"
#: The banner is printed again after this many changes of speed.
_CHANGES_PER_BANNER = 15
_DEPTH = 10


class TeleopTwistKeyboard(Node):
    """Publishes a velocity for each key.

    Attributes:
        speed: Linear velocity of a moving key [m/s].
        turn: Angular velocity of a turning key [rad/s].
    """

    def __init__(self) -> None:
        super().__init__("teleop_twist_keyboard")
        self._stamped: bool = self._constant("stamped", False)
        self._frame: str = self._constant("frame_id", "")
        if not self._stamped and self._frame:
            raise ValueError("'frame_id' can only be set when 'stamped' is True")
        self.speed: float = self._constant("speed", 0.5)
        self.turn: float = self._constant("turn", 1.0)
        self._changes = 0
        publisher = self.create_publisher(
            TwistStamped if self._stamped else Twist, "cmd_vel", _DEPTH
        )
        warn_if_unheard(self, publisher)
        self._publish: Callable[[Any], None] = publisher.publish

    def _constant(self, name: str, default: Any) -> Any:
        descriptor = ParameterDescriptor(read_only=True)
        return self.declare_parameter(name, default, descriptor).value

    def speeds(self) -> str:
        """Return the line with the current speeds."""
        return f"currently:\tspeed {self.speed}\tturn {self.turn} "

    def press(self, key: str) -> str:
        """Act on a key and publish; returns the text to print, empty if there is nothing to say."""
        text = ""
        if key in _SPEEDS:
            linear, angular = _SPEEDS[key]
            self.speed *= linear
            self.turn *= angular
            text = self.speeds()
            self._changes = (self._changes + 1) % _CHANGES_PER_BANNER
            if self._changes == 0:
                text += f"\n{BANNER}"
        self.drive(*_MOVES.get(key, (0, 0, 0, 0)))
        return text

    def drive(self, x: int, y: int, z: int, rotation: int) -> None:
        """Publish the velocity of a direction, each of -1, 0 and 1."""
        twist = Twist()
        twist.linear.x, twist.linear.y = x * self.speed, y * self.speed
        twist.linear.z, twist.angular.z = z * self.speed, rotation * self.turn
        if not self._stamped:
            self._publish(twist)
            return
        message = TwistStamped(twist=twist)
        message.header.stamp = self.get_clock().now().to_msg()
        message.header.frame_id = self._frame
        self._publish(message)


def main(args: list[str] | None = None) -> int:
    """Read keys until Ctrl-C or the end of the terminal; the robot is stopped at the end.

    Returns:
        The exit status: 1 when there is no terminal to read.
    """
    try:
        keyboard = Keyboard(foreground_terminal())
    except OSError:
        return _complain(_NO_TERMINAL)
    ending = (signal.SIGINT, signal.SIGTERM, *ENDING_SIGNALS)
    with signals_for_this_thread(*ending):
        rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
        rclpy.get_default_context().on_shutdown(keyboard.stop)
        for signum in ending:  # the robot is stopped before shutdown
            signal.signal(signum, lambda *_: keyboard.stop())
        try:
            node = TeleopTwistKeyboard()
        except ValueError as error:
            rclpy.try_shutdown()
            return _complain(str(error))
        spinner = threading.Thread(target=_spin, args=(node,), name="teleop-spin")
        spinner.start()
    try:
        _drive(node, keyboard)
    finally:
        rclpy.try_shutdown()
        spinner.join()
        node.destroy_node()
    return 0


def _drive(node: TeleopTwistKeyboard, keyboard: Keyboard) -> None:
    with keyboard:
        print(BANNER, flush=True)  # noqa: T201 - the terminal is this program's face
        print(node.speeds(), flush=True)  # noqa: T201
        while (key := keyboard.read().decode("latin-1")) not in ("", _CTRL_C):
            if text := node.press(key):
                print(text, flush=True)  # noqa: T201
        node.drive(0, 0, 0, 0)


def _spin(node: Node) -> None:
    """Serve the node's parameters while the keyboard is read."""
    with contextlib.suppress(ExternalShutdownException):
        rclpy.spin(node)


def _complain(text: str) -> int:
    print(text, file=sys.stderr)  # noqa: T201 - there is no node yet that could log it
    return 1
