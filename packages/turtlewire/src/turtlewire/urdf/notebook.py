"""The display of robots in a notebook."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from turtlewire.errors import UrdfError
from turtlewire.tf import svg
from turtlewire.tf.notebook import MOST_ROWS, html_table, html_text, projected
from turtlewire.urdf.kinematics import Kinematics
from turtlewire.wording import counted

if TYPE_CHECKING:
    from turtlewire.urdf.model import Description, Joint

__all__ = ["robot_html"]

_HEADS = ("link", "joint", "type", "limits")
#: Deeper links are not indented further.
_DEEPEST = 20
_INDENT = "\N{NO-BREAK SPACE}" * 2
_SIDE, _MARGIN = 240.0, 12.0
#: Both are visible on white and on black.
_BONE, _JOINT = "#888888", "#d55e00"


def robot_html(robot: Description) -> str:
    """Return the tree of links with joints and limits, and the robot with all joints at 0."""
    rows = list(_tree(robot))
    caption = f": {counted(len(robot.links), 'link')}, {counted(len(robot.joints), 'joint')}"
    if len(robot.links) > len(rows):
        caption += f"; the first {len(rows)} links shown"
    cells = [(_INDENT * min(depth, _DEEPEST) + link, *_joint(joint)) for depth, link, joint in rows]
    table = html_table(robot.name, caption, _HEADS, cells)
    warned = counted(len(robot.warnings), "warning")
    note = f"<p>{warned}; see robot.warnings</p>" if robot.warnings else ""
    return (
        '<div style="display:flex;flex-wrap:wrap;align-items:flex-start;gap:1em">'
        f"<div>{table}{note}</div>{_picture(robot, [link for _, link, _ in rows])}</div>"
    )


def _tree(robot: Description) -> Iterator[tuple[int, str, Joint | None]]:
    """Yield the first links with their depths, each after its parent, and the joints above them."""
    waiting: list[tuple[int, str, Joint | None]] = [(0, robot.root, None)]
    for _ in range(MOST_ROWS):
        if not waiting:
            return
        depth, link, joint = waiting.pop()
        yield depth, link, joint
        below = robot.child_joints[link]
        waiting += [(depth + 1, each.child, each) for each in reversed(below)]


def _joint(joint: Joint | None) -> tuple[str, str, str]:
    """Return a joint's name, its type, and its limits or the joint that it follows."""
    if joint is None:
        return "", "", ""
    unit = "m" if joint.type == "prismatic" else "rad"
    limits = ""
    if joint.mimic is not None:
        limits = f"follows {joint.mimic.joint}"
    elif joint.limits is not None and joint.type in ("revolute", "prismatic"):
        limits = f"{joint.limits.lower:.5g} to {joint.limits.upper:.5g} {unit}"
    return joint.name, joint.type, limits


def _picture(robot: Description, links: Sequence[str]) -> str:
    """Return lines between the origins of links with all joints at 0; empty if that is a point."""
    with np.errstate(all="ignore"):  # a robot may be larger than any page
        try:
            kinematics = Kinematics(robot)
        except UrdfError as error:  # joints mimic each other in a loop
            return f"<p>{html_text(str(error))}</p>"
        poses = kinematics.link_poses({})[0]
        positions = dict(zip(kinematics.links, poses[:, :3], strict=True))
        points = np.stack([positions[link] for link in links], axis=1)
        across = np.stack(projected(points))
        low = across.min(axis=1, keepdims=True)
        extent = float((across - low).max())
    if not np.isfinite(extent) or extent <= 0:
        return ""
    places = _MARGIN + (across - low) * ((_SIDE - 2 * _MARGIN) / extent)
    at = dict(zip(links, zip(*places.tolist(), strict=True), strict=True))
    joints = [robot.parent_joints[link] for link in links[1:]]
    bones = [
        svg.polyline((at[j.parent], at[j.child]), _BONE, 3, ' stroke-linecap="round"')
        for j in joints
    ]
    moving = [j for j in joints if j.moves]
    dots = [svg.circle(x, y, 4, f' fill="{_JOINT}"') for x, y in (at[j.child] for j in moving)]
    width, height = (places.max(axis=1) + _MARGIN).tolist()
    return svg.document(width, height, [*bones, *dots])
