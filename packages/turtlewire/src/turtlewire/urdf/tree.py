"""Checks that links and joints form a tree, with urdfdom's texts and order of checks."""

from __future__ import annotations

from typing import TYPE_CHECKING

from turtlewire.errors import UrdfError

if TYPE_CHECKING:
    from turtlewire.urdf.elements import Element
    from turtlewire.urdf.model import Joint, Link

__all__ = ["root_of"]


def root_of(robot: Element, links: dict[str, Link], joints: dict[str, Joint]) -> str:
    """Return the name of the root link.

    Raises:
        UrdfError: A joint has an end that does not exist; there is no root, or there are two; a
            link is the child of two joints; joints form a loop. urdfdom overlooks the last two.
    """
    above: dict[str, Joint] = {}
    for joint in sorted(joints.values(), key=lambda joint: joint.name):
        _check_ends(joint, links)
        if joint.child in above:
            raise _error(
                joint,
                f"Failed to build tree: link [{joint.child}] is the child of the joints"
                f" [{above[joint.child].name}] and [{joint.name}]",
            )
        above[joint.child] = joint
    roots = sorted(name for name in links if name not in above)
    if not roots:
        text = "No root link found. The robot xml is not a valid tree."
        raise robot.error(f"Failed to find root link: {text}")
    if len(roots) > 1:
        text = f"Two root links found: [{roots[0]}] and [{roots[1]}]"
        line = links[roots[1]].line
        raise UrdfError(f"Failed to find root link: {text}", line, f'<link name="{roots[1]}">')
    _check_loops(roots[0], links, above)
    return roots[0]


def _check_ends(joint: Joint, links: dict[str, Link]) -> None:
    name, parent = joint.name, joint.parent
    problem = None
    if not parent or not joint.child:
        problem = f"Joint [{name}] is missing a parent and/or child link specification."
    elif joint.child not in links:
        problem = f"child link [{joint.child}] of joint [{name}] not found"
    elif parent not in links:
        problem = (
            f"parent link [{parent}] of joint [{name}] not found.  This is not valid according to"
            " the URDF spec. Every link you refer to from a joint needs to be explicitly defined in"
            f" the robot description. To fix this problem you can either remove this joint [{name}]"
            f' from your urdf file, or add "<link name="{parent}" />" to your urdf file.'
        )
    if problem:
        raise _error(joint, f"Failed to build tree: {problem}")


def _check_loops(root: str, links: dict[str, Link], above: dict[str, Joint]) -> None:
    hanging = {root}  # links that are known to descend from the root
    for name in links:
        way: list[str] = []
        seen: set[str] = set()
        while name not in hanging:
            if name in seen:
                chain = " -> ".join([name, *reversed(way[way.index(name) :])])
                raise _error(above[name], f"Failed to build tree: the links {chain} form a loop")
            way.append(name)
            seen.add(name)
            name = above[name].parent  # noqa: PLW2901
        hanging.update(way)


def _error(joint: Joint, text: str) -> UrdfError:
    return UrdfError(text, joint.line, f'<joint name="{joint.name}">')
