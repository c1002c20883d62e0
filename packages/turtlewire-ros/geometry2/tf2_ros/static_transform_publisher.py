"""`ros2 run tf2_ros static_transform_publisher`: publishes one static transform."""

from __future__ import annotations

import math
import random
import string
import sys
from collections.abc import Sequence
from typing import NamedTuple

import rclpy
from geometry_msgs.msg import TransformStamped
from rcl_interfaces.msg import ParameterDescriptor, ParameterEvent
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import qos_profile_parameter_events
from rclpy.utilities import remove_ros_args
from tf_transformations import quaternion_from_euler
from turtlewire.distro import KILTED, LYRICAL, since

from .static_transform_broadcaster import StaticTransformBroadcaster

_USAGE = """usage: static_transform_publisher --frame-id FRAME_ID --child-frame-id CHILD_FRAME_ID
           [--x X] [--y Y] [--z Z] [--qx QX] [--qy QY] [--qz QZ] [--qw QW]
           [--roll ROLL] [--pitch PITCH] [--yaw YAW]

Publishes the pose of the child frame in the frame: a translation in metres, and a rotation either
as a quaternion or as roll, pitch and yaw in radians about the fixed axes x, y and z. Numbers that
are not given are zero, except QW, which is 1. Give a quaternion of length 1.

old style, deprecated, gone in Lyrical (mind the order of the angles):
       static_transform_publisher X Y Z QX QY QZ QW FRAME_ID CHILD_FRAME_ID
       static_transform_publisher X Y Z YAW PITCH ROLL FRAME_ID CHILD_FRAME_ID"""

_NUMBERS = ("--x", "--y", "--z", "--qx", "--qy", "--qz", "--qw", "--roll", "--pitch", "--yaw")
_TEXTS = ("--frame-id", "--child-frame-id")
_QUATERNION = ("--qx", "--qy", "--qz", "--qw")
_EULER = ("--roll", "--pitch", "--yaw")
_TOLERANCE = 0.01


class ArgumentsError(Exception):
    """The command line is wrong; the text is ROS 2's."""


class Placement(NamedTuple):
    """The pose of a frame.

    Attributes:
        translation: x, y, z in metres.
        rotation: Quaternion x, y, z, w.
        frame_id: The parent.
        child_frame_id: The frame.
        old_style: Whether the command line used the old style.
    """

    translation: tuple[float, float, float]
    rotation: tuple[float, float, float, float]
    frame_id: str
    child_frame_id: str
    old_style: bool = False


def parse(arguments: Sequence[str]) -> Placement:
    """Read the command line, without the program's name and without ``--ros-args``.

    Raises:
        ArgumentsError: The command line is wrong.
    """
    flags: dict[str, str] = {}
    rest = []
    words = iter(arguments)
    for word in words:
        if word in _NUMBERS or word in _TEXTS:
            flags[word] = next(words, "")
            if not flags[word] and word in _NUMBERS:
                raise ArgumentsError(f"Not enough arguments for {word}")
        else:
            rest.append(word)
    # Lyrical ignores all other words.
    if since(LYRICAL):
        return _checked(_new_style(flags))
    # The old style: a translation, a quaternion or three angles, and two frame ids.
    if flags and len(rest) in {8, 9}:
        raise ArgumentsError("Cannot specify both new-style (flags) and old-style (arguments)")
    if len(rest) in {8, 9}:
        return _checked(_old_style(rest))
    if rest:
        raise ArgumentsError("Extra unparsed arguments on command-line")
    return _checked(_new_style(flags))


def _new_style(flags: dict[str, str]) -> Placement:
    number = {flag: _float(flags[flag], flag) if flag in flags else 0.0 for flag in _NUMBERS}
    if any(flag in flags for flag in _QUATERNION) and any(flag in flags for flag in _EULER):
        raise ArgumentsError("Cannot specify both quaternion and Euler rotations")
    if any(flag in flags for flag in _QUATERNION):
        rotation = (
            number["--qx"],
            number["--qy"],
            number["--qz"],
            number["--qw"] if "--qw" in flags else 1.0,
        )
    else:
        roll, pitch, yaw = (number[flag] for flag in _EULER)
        rotation = quaternion_from_euler(roll, pitch, yaw)
    translation = (number["--x"], number["--y"], number["--z"])
    return Placement(
        translation, rotation, flags.get("--frame-id", ""), flags.get("--child-frame-id", "")
    )


def _old_style(words: list[str]) -> Placement:
    names = (
        ("x", "y", "z", "qx", "qy", "qz", "qw")
        if len(words) == 9
        else ("x", "y", "z", "yaw", "pitch", "roll")
    )
    # The frame ids come last and remain.
    x, y, z, *turn = (_float(word, name) for word, name in zip(words, names, strict=False))
    # The old style has yaw first.
    rotation = (
        (turn[0], turn[1], turn[2], turn[3])
        if len(turn) == 4
        else quaternion_from_euler(turn[2], turn[1], turn[0])
    )
    return Placement((x, y, z), rotation, words[-2], words[-1], old_style=True)


def _float(word: str, name: str) -> float:
    try:
        number = float(word)
    except ValueError:
        raise ArgumentsError(f"Failed to parse {name} argument as float") from None
    if not math.isfinite(number):
        raise ArgumentsError(
            f"{name} is {word}: listeners reject a transform whose numbers are not finite"
        )
    return number


def _checked(placement: Placement) -> Placement:
    if not placement.frame_id:
        raise ArgumentsError("Frame id must not be empty")
    if not placement.child_frame_id:
        raise ArgumentsError("Child frame id must not be empty")
    if not any(placement.rotation):
        raise ArgumentsError(
            "A quaternion of zeros is not a rotation, and every listener rejects it"
        )
    # tf2's limit since Kilted; Jazzy's listeners normalise the quaternion.
    if since(KILTED) and abs(sum(each * each for each in placement.rotation) - 1) >= _TOLERANCE:
        raise ArgumentsError(
            "The quaternion must have the length 1, and every listener rejects others"
        )
    return placement


class StaticTransformPublisher(Node):
    """Publishes the static transform that its parameters describe.

    Args:
        placement: Where the frame stands.

    Raises:
        RuntimeError: The two frame ids are equal.
    """

    def __init__(self, placement: Placement) -> None:
        # As in ROS 2, because several of these nodes may run.
        letters = string.ascii_letters + string.digits
        suffix = "".join(random.choices(letters, k=16))  # noqa: S311 -- no secret
        super().__init__(f"static_transform_publisher_{suffix}")
        # ROS 2's is a C++ node, and each of those listens to this topic.
        self.create_subscription(
            ParameterEvent, "/parameter_events", lambda _: None, qos_profile_parameter_events
        )
        transform = TransformStamped()
        read_only = ParameterDescriptor(read_only=True)
        for part, names in (("translation", "xyz"), ("rotation", "xyzw")):
            for name, number in zip(names, getattr(placement, part), strict=True):
                # The parameter's value and not the argument: a parameter file may have set another
                # one.
                value = self.declare_parameter(f"{part}.{name}", number, read_only).value
                setattr(getattr(transform.transform, part), name, value)
        transform.header.frame_id = self.declare_parameter(
            "frame_id", placement.frame_id, read_only
        ).value
        transform.child_frame_id = self.declare_parameter(
            "child_frame_id", placement.child_frame_id, read_only
        ).value
        if transform.header.frame_id == transform.child_frame_id:
            raise RuntimeError("child_frame_id cannot equal frame_id")
        transform.header.stamp = self.get_clock().now().to_msg()
        self._broadcaster = StaticTransformBroadcaster(self)
        self._broadcaster.sendTransform(transform)
        self.transform = transform

    def describe(self) -> str:
        """Return the transform in ROS 2's words."""
        t, q = self.transform.transform.translation, self.transform.transform.rotation
        return (
            "Spinning until stopped - publishing transform\n"
            f"translation: ('{t.x:f}', '{t.y:f}', '{t.z:f}')\n"
            f"rotation: ('{q.x:f}', '{q.y:f}', '{q.z:f}', '{q.w:f}')\n"
            f"from '{self.transform.header.frame_id}' to '{self.transform.child_frame_id}'"
        )


def main(args: list[str] | None = None) -> int:
    """Publish until stopped; return the exit status."""
    argv = sys.argv if args is None else args
    words = remove_ros_args(argv)[1:]
    if {"-h", "--help"} & {*words}:
        print(_USAGE)  # noqa: T201
        return 0
    try:
        placement = parse(words)
    except ArgumentsError as error:
        text = f"error parsing command line arguments: {error}\n{_USAGE}"
        print(text, file=sys.stderr)  # noqa: T201
        return 1
    rclpy.init(args=argv)
    try:
        node = StaticTransformPublisher(placement)
        if placement.old_style:
            node.get_logger().warning(
                "Old-style arguments are deprecated; see --help for new-style arguments"
            )
        node.get_logger().info(node.describe())
        rclpy.spin(node)
    except RuntimeError as error:
        print(error, file=sys.stderr)  # noqa: T201
        return 1
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()
    return 0
