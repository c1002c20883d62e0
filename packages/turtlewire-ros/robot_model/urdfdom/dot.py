"""The tree of a robot as Graphviz text, as urdfdom's urdf_to_graphviz writes it."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from turtlewire.urdf import Joint, Robot

__all__ = ["dot_from_robot"]


def dot_from_robot(robot: Robot) -> str:
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
    xyz, rpy = (" ".join(f"{number:g}" for number in row) for row in _origin(joint))
    name = _quoted(joint.name)
    yield f'{_quoted(joint.parent)} -> {name} [label="xyz: {xyz} \\nrpy: {rpy}"]'
    yield f"{name} -> {_quoted(joint.child)}"


def _origin(joint: Joint) -> tuple[tuple[float, ...], tuple[float, ...]]:
    return joint.origin.xyz, joint.origin.rpy


def _in_depth(robot: Robot) -> Iterator[Joint]:
    left = list(reversed(robot.child_joints[robot.root]))
    while left:
        joint = left.pop()
        yield joint
        left += reversed(robot.child_joints[joint.child])


def _quoted(name: str) -> str:
    escaped = name.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'
