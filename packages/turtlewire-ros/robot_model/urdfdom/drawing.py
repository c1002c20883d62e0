"""The picture of a robot's tree: a box for each link, with the joint above it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from turtlewire.tf.drawing import Drawing, FilledBox, Line, Text, text_width
from turtlewire.tf.tidy_tree import tidy_positions

if TYPE_CHECKING:
    from turtlewire.tf.drawing import Shape
    from turtlewire.urdf import Robot

__all__ = ["draw_robot"]

_NAME_SIZE, _NOTE_SIZE, _LINE = 12.0, 8.5, 11.0
_PADDING, _GAP, _MARGIN = 7.0, 14.0, 12.0
_HEIGHT, _ROW = 30.0, 72.0
_BORDER, _INK, _JOINT = "#4a6785", "#1d2a36", "#2255aa"


def draw_robot(robot: Robot) -> Drawing:
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
