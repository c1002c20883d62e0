"""Reads the file that a command line names, and prints what urdfdom logs."""

from __future__ import annotations

import sys

from turtlewire.urdf import Robot, UrdfError, load_urdf, parse_urdf
from turtlewire.urdf.faults import log_lines

__all__ = ["read_robot"]


def read_robot(path: str) -> Robot:
    """Return the robot in a file; ``-`` is stdin. Errors and warnings are printed on stderr.

    Raises:
        OSError: The file cannot be read.
        UrdfError: urdfdom refuses the description.
    """
    try:
        robot = parse_urdf(sys.stdin.buffer.read()) if path == "-" else load_urdf(path)
    except UrdfError as error:
        print(*log_lines(error), sep="\n", file=sys.stderr)  # noqa: T201
        raise
    for warning in robot.warnings:
        print(*log_lines(warning), sep="\n", file=sys.stderr)  # noqa: T201
    return robot
