"""``urdf_to_graphviz FILE [OUTPUT]``: draws the tree of a robot as Graphviz text and as PDF."""

from __future__ import annotations

import sys

from tf2_tools.pdf import pdf_from_drawing
from turtlewire.program import program
from turtlewire.terminal.printable import printable
from turtlewire.urdf import UrdfError
from urdfdom.dot import dot_from_robot
from urdfdom.drawing import draw_robot
from urdfdom.reading import read_robot

__all__ = ["main"]

_USAGE = """Usage: urdf_to_graphviz input.xml [OUTPUT]
  Will create either ${ROBOT_NAME}.gv & ${ROBOT_NAME}.pdf in CWD,
  or OUTPUT.gv & OUTPUT.pdf."""


@program
def main(args: list[str] | None = None) -> int:
    """Write both files; returns 0, 1 for what cannot be read or written, or 255 for usage.

    The PDF is drawn here; Graphviz is not needed.
    """
    words = sys.argv[1:] if args is None else args[1:]
    if words in (["-h"], ["--help"]):
        print(_USAGE)  # noqa: T201
        return 0
    if len(words) not in (1, 2):
        print(_USAGE, file=sys.stderr)  # noqa: T201
        return 255
    try:
        robot = read_robot(words[0])
        # A robot's name comes from the file: it must not choose the folder.
        name = words[1] if len(words) == 2 else robot.name.replace("/", "_").replace("\0", "_")
        _write(f"{name}.gv", dot_from_robot(robot).encode())
        _write(f"{name}.pdf", pdf_from_drawing(draw_robot(robot)))
    except UrdfError:
        print("ERROR: Model Parsing the xml failed", file=sys.stderr)  # noqa: T201
        return 1
    except OSError as error:
        text = f"urdf_to_graphviz: {error.filename}: {error.strerror}"
        print(printable(text), file=sys.stderr)  # noqa: T201
        return 1
    return 0


def _write(path: str, data: bytes) -> None:
    with open(path, "wb") as file:
        file.write(data)
    print(f"Created file {printable(path)}")  # noqa: T201
