"""Reads the joints of a robot from its description: URDF or SDF."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, NamedTuple
from xml.etree.ElementTree import ParseError

from joint_state_publisher.joints import FreeJoint, JointSet, MimicRule
from turtlewire.urdf.faults import XACRO_LEFT

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

# As in ROS 2, left out: they do not move, or need more than one number.
_SKIPPED_IN_URDF = frozenset({"fixed", "floating", "planar"})
_SKIPPED_IN_SDF = frozenset({"gearbox", "revolute2", "ball", "screw", "universal", "fixed"})


class DescriptionError(ValueError):
    """The description cannot be used; the text says why."""


class JointOptions(NamedTuple):
    """The parameters that configure joints.

    Attributes:
        zeros: Start values by joint [rad or m].
        mimics: Dependent joints that parameters define.
        use_mimic_tags: Whether mimic joints follow.
        use_smallest_limits: Whether the soft limits of ``safety_controller`` narrow the limits.
        positions: Whether positions are published for joints without another source.
        velocities: The same for velocities.
        efforts: The same for efforts.
    """

    zeros: Mapping[str, float]
    mimics: Mapping[str, MimicRule]
    use_mimic_tags: bool = True
    use_smallest_limits: bool = True
    positions: bool = True
    velocities: bool = False
    efforts: bool = False


def read_joints(text: str, options: JointOptions, warn: Callable[[str], None]) -> JointSet:
    """Return the joints of a description that move.

    Args:
        text: The XML.
        options: What parameters say.
        warn: Called with a sentence about each joint that is not treated as described.

    Raises:
        DescriptionError: The text is not XML, not a robot, or a joint has no limits.
    """
    import defusedxml
    from defusedxml.ElementTree import fromstring

    try:
        root = fromstring(text)
    except (ParseError, defusedxml.DefusedXmlException, ValueError) as error:
        raise DescriptionError(f"the robot description is not well-formed XML: {error}") from error
    if root.tag == "sdf":
        return _read_sdf(root, options)
    # As in ROS 2, the robot may lie within another element.
    robot = root if root.tag == "robot" else root.find(".//robot")
    if robot is None:
        raise DescriptionError('URDF must have a "robot" tag')
    joints = JointSet(robot=robot.get("name", ""))
    for element in robot.findall("joint"):
        if element.get("type", "") not in _SKIPPED_IN_URDF:
            _add_urdf_joint(joints, element, options)
    _free_mimics_of_nothing(joints, robot, options, warn)
    _warn_of_oddities(joints, root, warn)
    return joints


def _add_urdf_joint(joints: JointSet, element: Element, options: JointOptions) -> None:
    name = element.get("name", "")
    joints.order.append(name)
    joints.kinds[name] = element.get("type", "")
    mimics = element.findall("mimic")
    # As in ROS 2, several `mimic` elements count as none.
    if options.use_mimic_tags and len(mimics) == 1:
        joints.mimics[name] = MimicRule(
            mimics[0].get("joint", ""),
            _number(mimics[0].get("multiplier", "1"), f"multiplier of mimic joint {name!r}"),
            _number(mimics[0].get("offset", "0"), f"offset of mimic joint {name!r}"),
        )
    elif name in options.mimics:
        joints.mimics[name] = options.mimics[name]
    else:
        joints.free[name] = _urdf_free_joint(element, options)


def _urdf_free_joint(element: Element, options: JointOptions) -> FreeJoint:
    name, kind = element.get("name", ""), element.get("type", "")
    limit = element.find("limit")
    if kind == "continuous":
        # It has no limits, but a slider needs some: one turn.
        low, high = -math.pi, math.pi
    elif limit is None:
        raise DescriptionError(f'Limits must be specified for joint "{name}" of type "{kind}"')
    else:
        low, high = (_limit(limit, side, name, kind) for side in ("lower", "upper"))
    safety = element.findall("safety_controller")
    if options.use_smallest_limits and len(safety) == 1:
        soft_low, soft_high = (safety[0].get(f"soft_{side}_limit") for side in ("lower", "upper"))
        if soft_low is not None:
            low = max(low, _number(soft_low, f"soft_lower_limit of joint {name!r}"))
        if soft_high is not None:
            high = min(high, _number(soft_high, f"soft_upper_limit of joint {name!r}"))
    velocity = None if limit is None else limit.get("velocity")
    joint = _free_joint(name, kind, (low, high), options)
    if velocity is not None:
        joint.max_velocity = _number(velocity, f"velocity limit of joint {name!r}")
    return joint


def _free_joint(
    name: str, kind: str, limits: tuple[float, float], options: JointOptions
) -> FreeJoint:
    low, high = limits
    if name in options.zeros:
        zero = options.zeros[name]
    # Zero lies outside the limits.
    elif low > 0 or high < 0:
        zero = (high + low) / 2
    else:
        zero = 0.0
    return FreeJoint(
        name,
        kind,
        low,
        high,
        zero,
        position=zero if options.positions else None,
        velocity=0.0 if options.velocities else None,
        effort=0.0 if options.efforts else None,
    )


def _free_mimics_of_nothing(
    joints: JointSet, robot: Element, options: JointOptions, warn: Callable[[str], None]
) -> None:
    """Free the mimic joints of joints that are not here or do not move."""
    elements = {element.get("name", ""): element for element in robot.findall("joint")}
    known = {*joints.free, *joints.mimics}
    for name, mimic in list(joints.mimics.items()):
        if mimic.parent not in known:
            warn(
                f"Joint '{name}' mimics '{mimic.parent}', which is not a joint that moves: "
                f"'{name}' is treated as a free joint."
            )
            del joints.mimics[name]
            joints.free[name] = _urdf_free_joint(elements[name], options)


def _warn_of_oddities(joints: JointSet, root: Element, warn: Callable[[str], None]) -> None:
    # A name in xacro's namespace means that xacro has not run.
    if any(element.tag.partition("}")[0].endswith("/xacro") for element in root.iter()):
        warn(XACRO_LEFT)
    for joint in joints.free.values():
        if joint.minimum > joint.maximum:
            warn(
                f"Joint '{joint.name}' cannot move: its lower limit, {joint.minimum:g}, is above "
                f"its upper limit, {joint.maximum:g}."
            )


def _read_sdf(root: Element, options: JointOptions) -> JointSet:
    model = root.find(".//model")
    if model is None:
        raise DescriptionError('SDF must have a "model" tag')
    joints = JointSet(robot=model.get("name", ""))
    for element in model.findall("joint"):
        kind = element.get("type", "")
        if kind in _SKIPPED_IN_SDF:
            continue
        name = element.get("name", "")
        joints.order.append(name)
        joints.kinds[name] = kind
        if name in options.mimics:
            joints.mimics[name] = options.mimics[name]
            continue
        low, high = -math.pi, math.pi
        if kind != "continuous":
            low, high = (_sdf_limit(element, side, name, kind) for side in ("lower", "upper"))
        joints.free[name] = _free_joint(name, kind, (low, high), options)
    return joints


def _sdf_limit(element: Element, side: str, name: str, kind: str) -> float:
    found = element.find(f"axis/limit/{side}")
    if found is None:
        raise DescriptionError(f'Limits must be specified for joint "{name}" of type "{kind}"')
    return _number(found.text or "", f'"{side}" limit of joint {name!r}')


def _limit(limit: Element, side: str, name: str, kind: str) -> float:
    text = limit.get(side)
    if text is None:
        raise DescriptionError(
            f'"{side}" limit must be specified for joint "{name}" of type "{kind}"'
        )
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise DescriptionError(
            f'"{side}" limit must be a float for joint "{name}" of type "{kind}"'
        )
    return value


def _number(text: str, what: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise DescriptionError(f"the {what} must be a finite number, got {text!r}")
    return value
