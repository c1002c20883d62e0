"""Reads robot descriptions with the log lines of urdf, urdfdom and kdl_parser."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from typing import TYPE_CHECKING

from turtlewire.urdf import Robot, UrdfError
from turtlewire.urdf.faults import log_lines

if TYPE_CHECKING:
    from turtlewire.urdf import Joint


class RobotDescriptionError(RuntimeError):
    """The description is not a robot; the message is ROS 2's."""


def parse_description(text: str) -> Robot:
    """Return the robot. What urdfdom logs goes to stderr, with line and element.

    Raises:
        RobotDescriptionError: urdfdom rejects the description.
    """
    try:
        robot = Robot.from_xml(text)
    except UrdfError as error:
        _print(*log_lines(error))
        _print("Failed to parse robot description using: urdf_xml_parser/URDFXMLParser")
        raise RobotDescriptionError(
            "Unable to initialize urdf::model from robot description"
        ) from error
    for warning in robot.warnings:
        _print(*log_lines(warning))
    return robot


def oddities(robot: Robot) -> Iterator[str]:
    """The warnings of kdl_parser: inertia of the root link, joints that it treats as fixed."""
    if robot.links[robot.root].inertial is not None:
        yield (
            f"The root link {robot.root} has an inertia specified in the URDF, but KDL does not"
            " support a root link with an inertia.  As a workaround, you can add an extra dummy"
            " link to your URDF."
        )
    for joint in _in_depth(robot):
        if joint.type in {"floating", "planar"}:
            yield f"Converting unknown joint type of joint '{joint.name}' into a fixed joint"


def static_joints(robot: Robot) -> list[Joint]:
    """Joints whose transforms never change, sorted by name: fixed ones, and planar ones as in KDL.

    Floating joints are missing: another program publishes their transforms.
    """
    found = [joint for joint in robot.joints.values() if joint.type in {"fixed", "planar"}]
    return sorted(found, key=lambda joint: joint.name)


def _in_depth(robot: Robot) -> Iterator[Joint]:
    # Reversed, because the last item is popped first: the order is kdl_parser's, depth first.
    left = list(reversed(robot.child_joints[robot.root]))
    while left:
        joint = left.pop()
        yield joint
        left += reversed(robot.child_joints[joint.child])


def _print(*lines: str) -> None:
    print(*lines, sep="\n", file=sys.stderr, flush=True)  # noqa: T201 -- as urdfdom does
