"""Joints that follow others, also through several joints."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from turtlewire.errors import UrdfError

if TYPE_CHECKING:
    from turtlewire.urdf.model import Description, Joint, Mimic

__all__ = ["Follower", "followers_of"]


@dataclass(frozen=True, slots=True)
class Follower:
    """A joint that follows a free one: ``position = multiplier * position of leader + offset``.

    Attributes:
        leader: Name of the joint at the end of the chain, which follows none.
        multiplier: Product of the chain's factors.
        offset: What the chain adds.
    """

    leader: str
    multiplier: float
    offset: float


def followers_of(robot: Description) -> dict[str, Follower]:
    """Return the moving joints that follow others, by name, in the order of the file.

    A joint that follows one that does not exist or does not move is missing: it is free.

    Raises:
        UrdfError: Joints follow each other in a loop.
    """
    found: dict[str, Follower] = {}
    for joint in robot.joints.values():
        chain = _unresolved_chain(robot, joint, found)
        for part in reversed(chain):
            assert part.mimic is not None, "a joint without mimic ends the chain"
            found[part.name] = _behind(part.mimic, found.get(part.mimic.joint))
    return {name: found[name] for name in robot.joints if name in found}


def _behind(mimic: Mimic, leader: Follower | None) -> Follower:
    if leader is None:
        return Follower(mimic.joint, mimic.multiplier, mimic.offset)
    return Follower(
        leader.leader,
        mimic.multiplier * leader.multiplier,
        mimic.multiplier * leader.offset + mimic.offset,
    )


def _unresolved_chain(robot: Description, joint: Joint, found: dict[str, Follower]) -> list[Joint]:
    """Return the joint, the one that it follows, and so on, as far as they are not in ``found``."""
    chain: dict[str, Joint] = {}
    while joint.name not in found and (leader := _leader_of(robot, joint)) is not None:
        if joint.name in chain:
            names = list(chain)
            loop = " -> ".join([*names[names.index(joint.name) :], joint.name])
            raise UrdfError(
                f"Joints mimic each other in a loop: {loop}",
                joint.line,
                f'<mimic> in <joint name="{joint.name}">',
            )
        chain[joint.name] = joint
        joint = leader
    return list(chain.values())


def _leader_of(robot: Description, joint: Joint) -> Joint | None:
    if joint.mimic is None or not joint.moves:
        return None
    leader = robot.joints.get(joint.mimic.joint)
    return leader if leader is not None and leader.moves else None
