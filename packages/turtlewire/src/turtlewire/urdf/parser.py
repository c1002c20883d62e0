"""Reads a URDF with urdfdom's rules and error texts, and reports the positions of errors."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from turtlewire.errors import UrdfError
from turtlewire.urdf.bodies import read_link, read_material
from turtlewire.urdf.elements import Element, check_version, parse_xml
from turtlewire.urdf.faults import XACRO_LEFT, UrdfWarning, left_out, reported
from turtlewire.urdf.joints import read_joint
from turtlewire.urdf.model import Description, Material

if TYPE_CHECKING:
    from turtlewire.urdf.elements import Element
    from turtlewire.urdf.model import Joint, Link, Visual

__all__ = ["parse_urdf"]

_LIMITED = frozenset({"revolute", "prismatic"})


def parse_urdf(text: str | bytes) -> Description:
    """Return the robot that a URDF describes.

    Elements that urdfdom does not know (``gazebo``, ``transmission``, ``ros2_control``) are
    ignored.

    Args:
        text: The XML; for xacro files, what ``xacro`` makes of them.

    Raises:
        TypeError: ``text`` is neither str nor bytes.
        UrdfError: urdfdom rejects the description, the links do not form a tree, or the XML
            declares entities. ``line`` and ``element`` of the error say where.
    """
    if not isinstance(text, (str, bytes)):
        got = type(text).__name__
        raise TypeError(
            f"Robot.from_xml accepts the XML as str or bytes, got {got}; for a file, use Robot.load"
        )
    if not text.strip():
        raise UrdfError("The description is empty")
    root = parse_xml(text)
    if root.tag != "robot":
        raise root.error("Could not find the 'robot' element in the xml file")
    name = root.get("name")
    if name is None:
        raise root.error("No name given for the robot.")
    check_version(root)
    warnings = [*_xacro_left(root)]
    materials = _materials(root, warnings)
    links = _links(root, materials, warnings)
    if not links:
        raise root.error("No link elements found in urdf file")
    joints = _joints(root, warnings)
    top = _root_of(root, links, joints)
    return Description(name, links, joints, materials, top, tuple(warnings))


def _xacro_left(root: Element) -> Iterator[UrdfWarning]:
    """A warning at the first element of xacro: urdfdom ignores what xacro would make of it."""
    left = [root]
    while left:
        element = left.pop()
        if element.tag.startswith("xacro:"):
            yield UrdfWarning(XACRO_LEFT, element.line, element.described())
            return
        left += reversed(element.children)


def _materials(root: Element, warnings: list[UrdfWarning]) -> dict[str, Material]:
    found: dict[str, Material] = {}
    for element in root.all("material"):
        try:
            material = read_material(element, warnings)
        except UrdfError as error:
            warnings.append(left_out(error))
            material = Material("")
        else:
            if material.rgba is None and material.texture is None:
                text = f"Material [{material.name}] color has no rgba"
                warnings.append(UrdfWarning(text, element.line, element.described()))
        if material.name in found:
            raise element.error(f"material '{material.name}' is not unique.")
        found[material.name] = material
    return found


def _links(
    root: Element, materials: dict[str, Material], warnings: list[UrdfWarning]
) -> dict[str, Link]:
    found: dict[str, Link] = {}
    for element in root.all("link"):
        link = read_link(element, warnings)
        if link.name in found:
            raise element.error(f"link '{link.name}' is not unique.")
        visuals = tuple(
            _with_material(visual, part, link.name, materials, warnings)
            for visual, part in zip(link.visuals, element.all("visual"), strict=False)
        )
        found[link.name] = replace(link, visuals=visuals) if visuals else link
    return found


def _with_material(
    visual: Visual,
    element: Element,
    link: str,
    materials: dict[str, Material],
    warnings: list[UrdfWarning],
) -> Visual:
    """Return the visual with the colour of the material of that name; its own material wins."""
    material = visual.material
    if material is None:
        return visual
    if material.rgba is not None or material.texture is not None:
        materials.setdefault(material.name, material)
        return visual
    if material.name in materials:
        return replace(visual, material=materials[material.name])
    text = f"link '{link}' material '{material.name}' undefined."
    warnings.append(UrdfWarning(text, element.line, element.described()))
    return visual


def _joints(root: Element, warnings: list[UrdfWarning]) -> dict[str, Joint]:
    found: dict[str, Joint] = {}
    for element in root.all("joint"):
        with reported("joint xml is not initialized correctly"):
            joint = read_joint(element, warnings)
        if joint.name in found:
            raise element.error(f"joint '{joint.name}' is not unique.")
        found[joint.name] = joint
        limits = joint.limits
        if joint.type in _LIMITED and limits is not None and limits.lower > limits.upper:
            text = (
                f"joint '{joint.name}' cannot move: its lower limit, {limits.lower:g}, is above its"
                f" upper limit, {limits.upper:g}"
            )
            warnings.append(UrdfWarning(text, element.line, element.described()))
    return found


def _root_of(robot: Element, links: dict[str, Link], joints: dict[str, Joint]) -> str:
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
