"""``urdf_to_graphviz FILE [OUTPUT]``: draws the tree of a robot as Graphviz text and as PDF."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator
from typing import TYPE_CHECKING

from tf2_tools.pdf import pdf_from_drawing
from turtlewire.new_file import new_file
from turtlewire.program import program
from turtlewire.terminal.printable import printable
from turtlewire.tf.drawing import Drawing, FilledBox, Line, Text, text_width
from turtlewire.tf.tree_drawing import tidy_positions
from turtlewire.urdf import UrdfError
from urdfdom.check_urdf import read_robot

if TYPE_CHECKING:
    from turtlewire.tf.drawing import Shape
    from turtlewire.urdf import Joint, Robot

_USAGE = """Usage: urdf_to_graphviz input.xml [OUTPUT]
  Will create either ${ROBOT_NAME}.gv & ${ROBOT_NAME}.pdf in CWD,
  or OUTPUT.gv & OUTPUT.pdf."""
#: The sine of the pitch from which on urdfdom takes a rotation as upright.
_UPRIGHT = 0.99999


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
        _write(f"{name}.gv", _dot_from_robot(robot).encode())
        _write(f"{name}.pdf", pdf_from_drawing(_draw_robot(robot)))
    except UrdfError:
        print("ERROR: Model Parsing the xml failed", file=sys.stderr)  # noqa: T201
        return 1
    except OSError as error:
        text = f"urdf_to_graphviz: {error.filename}: {error.strerror}"
        print(printable(text), file=sys.stderr)  # noqa: T201
        return 1
    return 0


def _write(path: str, data: bytes) -> None:
    with new_file(path) as unfinished, open(unfinished, "wb") as file:
        file.write(data)
    print(f"Created file {printable(path)}")  # noqa: T201


def _dot_from_robot(robot: Robot) -> str:
    """Return Graphviz text: links as boxes, joints as blue ellipses with origins on the arrows."""
    joints = list(_in_depth(robot))
    links = [robot.root, *(joint.child for joint in joints)]
    return "\n".join(
        [
            "digraph G {",
            "node [shape=box];",
            *(f"{_quoted(link)} [label={_quoted(link)}];" for link in links),
            "node [shape=ellipse, color=blue, fontcolor=blue];",
            *(line for joint in joints for line in _arrows(joint)),
            "}\n",
        ]
    )


def _arrows(joint: Joint) -> Iterator[str]:
    rows = (joint.origin.xyz, _angles(joint.origin.quaternion))
    xyz, rpy = (" ".join(f"{number:g}" for number in row) for row in rows)
    name = _quoted(joint.name)
    yield f'{_quoted(joint.parent)} -> {name} [label="xyz: {xyz} \\nrpy: {rpy}"]'
    yield f"{name} -> {_quoted(joint.child)}"


def _angles(rotation: tuple[float, float, float, float]) -> tuple[float, float, float]:
    """Return roll, pitch and yaw as urdfdom computes them of its quaternion, with its -0."""
    x, y, z, w = rotation
    sine = -2 * (x * z - w * y) / (x * x + y * y + z * z + w * w)
    if abs(sine) >= _UPRIGHT:
        side = math.copysign(1.0, sine)
        return 0.0, side * math.pi / 2, 2 * math.atan2(-side * x, side * y)
    roll = math.atan2(2 * (y * z + w * x), w * w - x * x - y * y + z * z)
    return roll, math.asin(sine), math.atan2(2 * (x * y + w * z), w * w + x * x - y * y - z * z)


def _in_depth(robot: Robot) -> Iterator[Joint]:
    left = list(reversed(robot.child_joints[robot.root]))
    while left:
        joint = left.pop()
        yield joint
        left += reversed(robot.child_joints[joint.child])


def _quoted(name: str) -> str:
    escaped = name.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'


_NAME_SIZE, _NOTE_SIZE, _LINE = 12.0, 8.5, 11.0
_PADDING, _GAP, _MARGIN = 7.0, 14.0, 12.0
_HEIGHT, _ROW = 30.0, 72.0
_BORDER, _INK, _JOINT = "#4a6785", "#1d2a36", "#2255aa"


def _draw_robot(robot: Robot) -> Drawing:
    """Draw all links and joints, the root on top."""
    notes = {link: (joint.name, joint.type) for link, joint in robot.parent_joints.items()}
    widths = {link: _width(link, notes.get(link, ())) for link in robot.links}
    children = {
        link: [joint.child for joint in joints] for link, joints in robot.child_joints.items()
    }
    places = tidy_positions([robot.root], children, widths, _GAP)
    # Kept apart, so that the lines lie below the boxes that they touch.
    lines: list[Shape] = []
    cards: list[Shape] = []
    for link, (middle, row) in places.items():
        x, y = middle + _MARGIN, row * _ROW + _MARGIN
        for child in children[link]:
            end = places[child][0] + _MARGIN, y + _ROW - 2 * _LINE
            lines.append(Line(((x, y + _HEIGHT), end), _BORDER))
        left = x - widths[link] / 2
        cards.append(FilledBox(left, y, widths[link], _HEIGHT, _BORDER))
        cards.append(Text(left + _PADDING, y + 19.0, link, _NAME_SIZE, _INK, bold=True))
        for number, note in enumerate(reversed(notes.get(link, ()))):
            size = text_width(note, _NOTE_SIZE)
            at = x - size / 2, y - 4.0 - number * (_LINE - 1.0)
            cards.append(Text(*at, note, _NOTE_SIZE, _JOINT))
    width = max(place + widths[link] / 2 for link, (place, _) in places.items()) + 2 * _MARGIN
    height = max(row for _, row in places.values()) * _ROW + _HEIGHT + 2 * _MARGIN
    return Drawing(width, height, (*lines, *cards))


def _width(link: str, notes: tuple[str, ...]) -> float:
    name = text_width(link, _NAME_SIZE, bold=True) + 2 * _PADDING
    return max([name, *(text_width(note, _NOTE_SIZE) for note in notes)])
