"""Reads ``joint`` elements with urdfdom's rules and texts."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING, cast

from turtlewire.errors import UrdfError
from turtlewire.urdf.elements import is_of_version, minor_version
from turtlewire.urdf.faults import reported
from turtlewire.urdf.model import (
    MOVING_TYPES,
    Calibration,
    Dynamics,
    Joint,
    JointLimits,
    Mimic,
    Safety,
)
from turtlewire.urdf.values import number_of, pose_of, vector_of

if TYPE_CHECKING:
    from typing import TypeVar

    from turtlewire.urdf.elements import Element
    from turtlewire.urdf.faults import UrdfWarning
    from turtlewire.urdf.model import JointType, Vector

    T = TypeVar("T")
    from turtlewire.urdf.model import Description

__all__ = ["Follower", "followers_of", "read_joint"]

_TYPES = MOVING_TYPES | {"fixed", "floating", "planar"}
_RATES = ("acceleration", "deceleration", "jerk")
_NO_LIMITS = {
    "revolute": "Joint [{}] is of type REVOLUTE but it does not specify limits",
    "prismatic": "Joint [{}] is of type PRISMATIC without limits",
}


def read_joint(element: Element, warnings: list[UrdfWarning]) -> Joint:
    """Return a ``joint`` element.

    Args:
        element: The element.
        warnings: Gets what is ignored, as it came with a later version.

    Raises:
        UrdfError: urdfdom refuses the joint, or it moves along an axis of no direction.
    """
    name = element.get("name")
    if name is None:
        raise element.error("unnamed joint found")
    with reported(f"Malformed parent origin element for joint [{name}]"):
        origin = pose_of(element.first("origin"), warnings)
    parent, child = _end(element, "parent"), _end(element, "child")
    kind = _type(element, name)
    axis = _axis(element, name, kind)
    limits = _part(
        element,
        "limit",
        lambda part: _limits(part, kind, warnings),
        f"Could not parse limit element for joint [{name}]",
    )
    if limits is None and kind in _NO_LIMITS:
        raise element.error(_NO_LIMITS[kind].replace("{}", name))
    could_not = "Could not parse {} element for joint "
    return Joint(
        name,
        kind,
        parent,
        child,
        origin,
        axis,
        limits,
        safety=_part(
            element, "safety_controller", _safety, f"{could_not.format('safety')}[{name}]"
        ),
        calibration=_part(
            element, "calibration", _calibration, f"{could_not.format('calibration')} [{name}]"
        ),
        mimic=_part(element, "mimic", _mimic, f"{could_not.format('mimic')} [{name}]"),
        dynamics=_part(element, "dynamics", _dynamics, f"{could_not.format('dynamics')}[{name}]"),
        line=element.line,
    )


def _part(
    element: Element, tag: str, read: Callable[[Element], T], after_an_error: str
) -> T | None:
    part = element.first(tag)
    if part is None:
        return None
    with reported(after_an_error):
        return read(part)


def _end(element: Element, tag: str) -> str:
    # A joint without its ends is refused when the tree is built.
    part = element.first(tag)
    return "" if part is None else part.get("link") or ""


def _type(element: Element, name: str) -> JointType:
    kind = element.get("type")
    if kind is None:
        raise element.error(f"joint [{name}] has no type, check to see if it's a reference.")
    if kind not in _TYPES:
        raise element.error(f"Joint [{name}] has no known type [{kind}]")
    return cast("JointType", kind)


def _axis(element: Element, name: str, kind: str) -> Vector:
    default = (1.0, 0.0, 0.0)
    part = element.first("axis")
    if part is None or kind in {"fixed", "floating"}:
        return default
    before = f"Malformed axis element for joint [{name}]: "
    axis = vector_of(part, "xyz", before) or default
    if kind in MOVING_TYPES and not any(axis):
        raise part.error(f"{before}it is zero, which is not a direction")
    return axis


def _limits(element: Element, kind: str, warnings: list[UrdfWarning]) -> JointLimits:
    lower = number_of(element, "lower", "lower value ({}) is not a valid float")
    upper = number_of(element, "upper", "upper value ({}) is not a valid float")
    if minor_version(element) >= 2:
        return _limits_of_version_1_2(element, kind, lower, upper)
    for attribute in _RATES:
        if element.get(attribute) is not None:
            is_of_version(element, 2, f"{attribute} attribute requiring", warnings)
    effort = number_of(element, "effort", "effort value ({}) is not a valid float")
    if effort is None:
        raise element.error("joint limit: no effort")
    velocity = number_of(element, "velocity", "velocity value ({}) is not a valid float")
    if velocity is None:
        raise element.error("joint limit: no velocity")
    return JointLimits(lower or 0.0, upper or 0.0, effort, velocity)


def _limits_of_version_1_2(
    element: Element, kind: str, lower: float | None, upper: float | None
) -> JointLimits:
    """Return limits of which most may be missing: then they are infinite."""
    if kind in _NO_LIMITS and (lower is None or upper is None):
        raise element.error(f"joint limit: no {'lower' if lower is None else 'upper'}")
    lowest, highest = -inf if lower is None else lower, inf if upper is None else upper
    if highest < lowest:
        raise element.error(f"joint limit: upper ({highest:g}) is less than lower ({lowest:g})")
    values = {}
    for attribute in ("effort", "velocity", *_RATES):
        value = number_of(element, attribute, attribute + " value ({}) is not a valid float")
        if value is not None and value < 0:
            raise element.error(f"joint limit: {attribute} ({value:g}) is negative")
        values[attribute] = inf if value is None else value
    if element.get("deceleration") is None:
        values["deceleration"] = values["acceleration"]
    return JointLimits(lowest, highest, **values)


def _safety(element: Element) -> Safety:
    def number(attribute: str) -> float | None:
        return number_of(element, attribute, attribute + " value ({}) is not a valid float")

    lower, upper = number("soft_lower_limit"), number("soft_upper_limit")
    k_position, k_velocity = number("k_position"), number("k_velocity")
    if k_velocity is None:
        raise element.error("joint safety: no k_velocity")
    return Safety(k_velocity, k_position or 0.0, lower or 0.0, upper or 0.0)


def _calibration(element: Element) -> Calibration:
    return Calibration(
        number_of(element, "rising", "risingvalue ({}) is not a valid float"),
        number_of(element, "falling", "fallingvalue ({}) is not a valid float"),
    )


def _mimic(element: Element) -> Mimic:
    joint = element.get("joint")
    if joint is None:
        raise element.error("joint mimic: no mimic joint specified")
    multiplier = number_of(element, "multiplier", "multiplier value ({}) is not a valid float")
    offset = number_of(element, "offset", "offset value ({}) is not a valid float")
    return Mimic(joint, 1.0 if multiplier is None else multiplier, offset or 0.0)


def _dynamics(element: Element) -> Dynamics:
    damping = number_of(element, "damping", "damping value ({}) is not a valid float")
    friction = number_of(element, "friction", "friction value ({}) is not a valid float")
    if damping is None and friction is None:
        raise element.error("joint dynamics element specified with no damping and no friction")
    return Dynamics(damping or 0.0, friction or 0.0)


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
