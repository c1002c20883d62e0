"""`ros2 run tf2_ros tf2_echo SOURCE TARGET`: prints the pose of a frame repeatedly."""

from __future__ import annotations

import json
import math
import sys
import threading
from typing import TYPE_CHECKING, Any

import rclpy
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time
from rclpy.utilities import remove_ros_args
from tf_transformations import euler_from_quaternion
from turtlewire.errors import TransformException
from turtlewire.geometry import quaternions
from turtlewire.terminal.printable import printable_lines

from .buffer import Buffer
from .command_line import ToolParser, count, digits, frame_id
from .transform_listener import TransformListener

if TYPE_CHECKING:
    import argparse

    from geometry_msgs.msg import TransformStamped

#: The first second that a stamp of ROS 2 cannot hold.
_TOO_LATE_S = 2.0**31
_BAD_NUMBER = "Failed to convert %s argument '%s' to a floating-point number"


def main(args: list[str] | None = None) -> int:
    """Print until stopped.

    Returns:
        The exit status: 1 for a wrong command line, 2 for a rate that is not a number or, with
        ``-r``, not positive, 3 for a positional rate that is not positive, and for a time that is
        not a number.
    """
    argv = sys.argv if args is None else args
    options = _parser().parse_args(remove_ros_args(argv)[1:])
    asked_rate = options.rate if options.echo_rate is None else options.echo_rate
    rate, time = _number(asked_rate), _number(options.time)
    status, fault = 0, ""
    if math.isnan(rate):
        status, fault = 2, _BAD_NUMBER % ("rate", asked_rate)
    elif not 0.0 < rate < math.inf and options.echo_rate is None:
        status, fault = 2, "Rate must be positive"
    elif not 0.0 < rate < math.inf:
        status, fault = 3, f"Echo rate must be > 0.0, got '{asked_rate}'"
    elif not 0.0 <= time < _TOO_LATE_S:
        status, fault = 3, _BAD_NUMBER % ("time", options.time)
    if fault:
        print(fault, file=sys.stderr)  # noqa: T201
        return status
    rclpy.init(args=argv)
    try:
        with Node("tf2_echo") as node:
            _echo(node, options, 1.0 / rate, Time(seconds=time))
    except KeyboardInterrupt:
        pass
    finally:
        rclpy.try_shutdown()
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = ToolParser(
        prog="tf2_echo",
        description="Print the pose of TARGET in SOURCE; it transforms data from TARGET to SOURCE.",
    )
    parser.add_argument(
        "source_frame", type=frame_id, help="the frame that the pose is expressed in"
    )
    parser.add_argument("target_frame", type=frame_id, help="the frame whose pose is printed")
    # The releases of Jazzy replaced this by the option; both work here.
    parser.add_argument("echo_rate", nargs="?", metavar="rate", help="the same as --rate")
    parser.add_argument(
        "-r", "--rate", default="1.0", help="how often, per second (default: %(default)s)"
    )
    parser.add_argument(
        "-t", "--time", default="0", help="look up at this time, in seconds (default: the latest)"
    )
    parser.add_argument(
        "-p",
        "--precision",
        type=digits,
        default=3,
        help="digits after the point (default: %(default)s)",
    )
    parser.add_argument(
        "-n", "--limit", type=count, default=0, help="exit after this many transforms"
    )
    parser.add_argument("--degrees", action="store_true", help="angles in degrees only")
    parser.add_argument("--distance", action="store_true", help="also print the distance")
    parser.add_argument(
        "--json", action="store_true", help="one JSON object in a line for each transform"
    )
    return parser


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return math.nan


def _echo(node: Node, options: argparse.Namespace, period_s: float, time: Time) -> None:
    buffer, stopped = Buffer(node=node), threading.Event()
    rclpy.get_default_context().on_shutdown(stopped.set)
    TransformListener(buffer, node, spin_thread=True)  # a simulated clock needs the spinning
    source, target = options.source_frame, options.target_frame
    printed = 0
    # Each hint only once: the line itself is repeated every second.
    said: set[str] = set()
    while not stopped.is_set():
        answer: Any = buffer.can_transform(
            source, target, Time(), Duration(seconds=1), return_debug_tuple=True
        )
        known, reason = answer
        if known:
            break
        hints = _hints(buffer, source, target, node.context.get_domain_id())
        why = printable_lines("\n".join([reason, *(hint for hint in hints if hint not in said)]))
        said.update(hints)
        # ROS 2's text, with its two blanks.
        node.get_logger().info(f"Waiting for transform {source} ->  {target}: {why}")
    while not stopped.is_set():
        try:
            transform = buffer.lookup_transform(source, target, time)
        except TransformException as error:
            text = _failure(node.get_clock().now().nanoseconds, error, buffer)
            print(printable_lines(text), flush=True)  # noqa: T201
        else:
            text = as_json(transform) if options.json else describe(transform, options)
            print(text, flush=True)  # noqa: T201
            printed += 1
        if printed == options.limit > 0 or stopped.wait(period_s):
            return


def _hints(buffer: Buffer, source: str, target: str, domain: int) -> list[str]:
    """Return what may help with a lookup that fails, and with a domain without transforms."""
    from turtlewire.doctor.network import other_domains_hint

    try:
        buffer.lookup_transform(source, target, Time())
    except TransformException as error:
        hints = [error.hint, "" if buffer.all_frames_as_string() else other_domains_hint(domain)]
        return [hint for hint in hints if hint]
    return []  # the transform has arrived in between


def _failure(now_ns: int, error: TransformException, buffer: Buffer) -> str:
    """Return ROS 2's text for a transform that was known before, and is not any more."""
    return (
        f"Failure at {now_ns / 1e9:f}\nException thrown:{error}\n"
        f"The current list of frames is:\n{buffer.all_frames_as_string()}"
    )


def describe(transform: TransformStamped, options: argparse.Namespace) -> str:
    """Describe a transform as ROS 2 does, with padded nanoseconds and a last line in words."""
    t, q = transform.transform.translation, transform.transform.rotation
    stamp, digits = transform.header.stamp, options.precision

    def row(numbers: Any) -> str:
        return ", ".join(f"{number:.{digits}f}" for number in numbers)

    angles = euler_from_quaternion((q.x, q.y, q.z, q.w))
    lines = [
        f"At time {stamp.sec}.{stamp.nanosec:09d}",
        f"- Translation: [{row((t.x, t.y, t.z))}]",
        f"- Rotation: in Quaternion [{row((q.x, q.y, q.z, q.w))}]",
    ]
    if not options.degrees:
        lines.append(f"- Rotation: in RPY (radian) [{row(angles)}]")
    lines.append(f"- Rotation: in RPY (degree) [{row(math.degrees(angle) for angle in angles)}]")
    lines.append("- Matrix:")
    lines += [
        "".join(f" {number:{digits + 3}.{digits}f}" for number in numbers)
        for numbers in _matrix(t, q)
    ]
    if options.distance:
        lines.append(f"- Distance: {math.hypot(t.x, t.y, t.z):.{digits}f}")
    return "\n".join([*lines, f"- In words: {in_words(transform, digits)}"])


def _matrix(t: Any, q: Any) -> list[list[float]]:
    """Return the transform as a 4x4 matrix, on plain floats: a browser tab has no NumPy."""
    no_rotation = not (q.x or q.y or q.z or q.w)
    rows = quaternions.matrix((0.0, 0.0, 0.0, 1.0) if no_rotation else (q.x, q.y, q.z, q.w))
    return [
        [*rows[:3], t.x],
        [*rows[3:6], t.y],
        [*rows[6:], t.z],
        [0.0, 0.0, 0.0, 1.0],
    ]


def in_words(transform: TransformStamped, digits: int = 2) -> str:
    """Describe the child's position in the header's frame: x ahead, y left, z up."""
    t = transform.transform.translation
    parts = [
        f"{abs(number):.{digits}f} m {positive if number >= 0 else negative}"
        for number, positive, negative in (
            (t.x, "ahead", "behind"),
            (t.y, "to the left", "to the right"),
            (t.z, "above", "below"),
        )
        if round(abs(number), digits) > 0
    ]
    place = ", ".join(parts) if parts else "at the same place"
    return f"seen from {transform.header.frame_id}, {transform.child_frame_id} is {place}"


def as_json(transform: TransformStamped) -> str:
    """Return a transform as a JSON object in one line."""
    t, q = transform.transform.translation, transform.transform.rotation
    return json.dumps(
        {
            "source_frame": transform.header.frame_id,
            "target_frame": transform.child_frame_id,
            "stamp_ns": transform.header.stamp.sec * 1_000_000_000 + transform.header.stamp.nanosec,
            "translation": [t.x, t.y, t.z],
            "rotation_xyzw": [q.x, q.y, q.z, q.w],
            "rpy": list(euler_from_quaternion((q.x, q.y, q.z, q.w))),
        }
    )
