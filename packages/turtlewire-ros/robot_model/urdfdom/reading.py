"""Reads the file that a command line names, and prints what urdfdom logs."""

from __future__ import annotations

import sys

from turtlewire.urdf import Robot, UrdfError
from turtlewire.urdf.faults import log_lines


def read_robot(path: str) -> Robot:
    """Return the robot in a file; ``-`` is stdin. Errors and warnings are printed on stderr.

    Raises:
        OSError: The file cannot be read.
        UrdfError: urdfdom rejects the description.
    """
    try:
        robot = Robot.from_xml(sys.stdin.buffer.read()) if path == "-" else Robot.load(path)
    except UrdfError as error:
        print(*log_lines(error), sep="\n", file=sys.stderr)  # noqa: T201
        raise
    for warning in robot.warnings:
        print(*log_lines(warning), sep="\n", file=sys.stderr)  # noqa: T201
    return robot
