"""``check_urdf FILE``: checks a URDF and prints its tree of links."""

from __future__ import annotations

import sys
from collections.abc import Iterator

from turtlewire.program import program
from turtlewire.terminal.printable import printable
from turtlewire.urdf import Robot, UrdfError
from turtlewire.urdf.faults import log_lines

_USAGE = "Expect URDF xml file to parse. Use - for stdin"


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


def tree_lines(robot: Robot) -> Iterator[str]:
    """Yield the tree in the words of urdfdom's check_urdf, children sorted by their joints."""
    children = robot.child_joints[robot.root]
    yield f"root Link: {printable(robot.root)} has {len(children)} child(ren)"
    # A stack instead of recursion, because a robot may be a long chain. Reversed, as the last one
    # is popped first.
    left = [(1, number, joint) for number, joint in reversed([*enumerate(children, 1)])]
    while left:
        level, number, joint = left.pop()
        yield f"{'    ' * level}child({number}):  {printable(joint.child)}"
        below = robot.child_joints[joint.child]
        left += [(level + 1, count, each) for count, each in reversed([*enumerate(below, 1)])]


@program
def main(args: list[str] | None = None) -> int:
    """Check a file; returns 0 for a robot, 1 for none, -1 (255) without a file."""
    words = sys.argv[1:] if args is None else args[1:]
    if words in (["-h"], ["--help"]):
        print(f"usage: check_urdf FILE\n\n{_USAGE}")  # noqa: T201
        return 0
    if not words:
        print(_USAGE, file=sys.stderr)  # noqa: T201
        # urdfdom returns -1, which a shell sees as 255.
        return 255
    try:
        robot = read_robot(words[0])
    except UrdfError:
        print("ERROR: Model Parsing the xml failed", file=sys.stderr)  # noqa: T201
        return 1
    except OSError as error:
        print(f"check_urdf: {words[0]}: {error.strerror}", file=sys.stderr)  # noqa: T201
        return 1
    heading = (
        f"robot name is: {printable(robot.name)}",
        "---------- Successfully Parsed XML ---------------",
    )
    print("\n".join([*heading, *tree_lines(robot)]))  # noqa: T201
    return 0
