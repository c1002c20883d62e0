"""Reads ``link`` and ``material`` elements with urdfdom's rules and texts."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from turtlewire.distro import LYRICAL, since
from turtlewire.errors import UrdfError
from turtlewire.urdf.elements import is_of_version, minor_version
from turtlewire.urdf.faults import UrdfWarning, left_out, reported
from turtlewire.urdf.model import (
    Box,
    Capsule,
    Collision,
    Cylinder,
    Inertial,
    Link,
    Material,
    Mesh,
    Sphere,
    Visual,
)
from turtlewire.urdf.values import color_of, number_of, pose_of, vector_of

if TYPE_CHECKING:
    from turtlewire.urdf.elements import Element
    from turtlewire.urdf.model import Geometry

__all__ = ["read_link", "read_material"]

_MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")


def read_link(element: Element, warnings: list[UrdfWarning]) -> Link:
    """Read a ``link`` element; as in urdfdom, what follows a faulty part of it is left out.

    A link without a name has the empty name and no parts.

    Args:
        element: The element.
        warnings: Gets what urdfdom complains of and accepts.

    """
    name = element.get("name")
    if name is None:
        warnings.append(left_out(element.error("No name given for the link.")))
        return Link("", line=element.line)
    inertial: Inertial | None = None
    visuals: list[Visual] = []
    collisions: list[Collision] = []
    try:
        if (part := element.first("inertial")) is not None:
            with reported(f"Could not parse inertial element for Link [{name}]"):
                inertial = _inertial(part, warnings)
        with reported(f"Could not parse visual element for Link [{name}]"):
            visuals.extend(_visual(part, warnings) for part in element.all("visual"))
        with reported(f"Could not parse collision element for Link [{name}]"):
            collisions.extend(_collision(part, warnings) for part in element.all("collision"))
    except UrdfError as error:
        warnings.append(left_out(error))
    return Link(name, inertial, tuple(visuals), tuple(collisions), element.line)


def read_material(element: Element, warnings: list[UrdfWarning]) -> Material:
    """Return a ``material`` element; without colour or texture it is a reference to another one.

    Args:
        element: The element.
        warnings: Gets a malformed colour, which urdfdom leaves out.

    Raises:
        UrdfError: The material has no name.
    """
    name = element.get("name")
    if name is None:
        raise element.error("Material must contain a name attribute")
    texture, rgba = element.first("texture"), None
    color = element.first("color")
    if color is not None:
        try:
            before = f"Material [{name}] has malformed color rgba values: "
            rgba = color_of(color, "rgba", before)
        except UrdfError as error:
            warnings.append(UrdfWarning(str(error), error.line, error.element))
    return Material(name, rgba, None if texture is None else texture.get("filename"))


def _inertial(element: Element, warnings: list[UrdfWarning]) -> Inertial:
    origin = pose_of(element.first("origin"), warnings)
    mass_element = element.first("mass")
    if mass_element is None:
        raise element.error("Inertial element must have a mass element")
    mass = number_of(mass_element, "value", "Inertial: mass [{}] is not a float")
    if mass is None:
        raise mass_element.error("Inertial: mass element must have value attribute")
    inertia = element.first("inertia")
    if inertia is None:
        raise element.error("Inertial element must have inertia element")
    moments = {name: _moment(inertia, name) for name in _MOMENTS}
    return Inertial(mass=mass, origin=origin, **moments)


def _moment(inertia: Element, name: str) -> float:
    refusal = f"Inertial: inertia element {name} is not a valid double"
    value = number_of(inertia, name, refusal)
    if value is None:
        raise inertia.error(f"Inertial: inertia element missing {name} attribute")
    return value


def _visual(element: Element, warnings: list[UrdfWarning]) -> Visual:
    origin = pose_of(element.first("origin"), warnings)
    geometry = _geometry(element.first("geometry"), warnings)
    material = None
    if (part := element.first("material")) is not None:
        if part.get("name") is None:
            raise part.error("Visual material must contain a name attribute")
        material = read_material(part, warnings)
    return Visual(geometry, origin, element.get("name") or "", material)


def _collision(element: Element, warnings: list[UrdfWarning]) -> Collision:
    origin = pose_of(element.first("origin"), warnings)
    geometry = _geometry(element.first("geometry"), warnings)
    return Collision(geometry, origin, element.get("name") or "")


def _geometry(element: Element | None, warnings: list[UrdfWarning]) -> Geometry | None:
    if element is None:
        return None
    if not element.children:
        raise element.error("Geometry tag contains no child element.")
    shape = element.children[0]
    if shape.tag == "capsule" and since(LYRICAL):
        needs = "capsule attribute minimum required version"
        return _capsule(shape) if is_of_version(shape, 1, needs, warnings) else None
    reader = _SHAPES.get(shape.tag)
    if reader is None:
        raise shape.error(f"Unknown geometry type '{shape.tag}'")
    return reader(shape)


def _sphere(element: Element) -> Geometry:
    radius = number_of(element, "radius", "radius [{}] is not a valid float")
    if radius is None:
        raise element.error("Sphere shape must have a radius attribute")
    _check_sizes(element, (radius,), "Sphere radius must be a positive finite value")
    return Sphere(radius)


def _box(element: Element) -> Geometry:
    size = vector_of(element, "size")
    if size is None:
        raise element.error("Box shape has no size attribute")
    _check_sizes(element, size, "Box size must be positive finite values")
    return Box(size)


def _cylinder(element: Element) -> Geometry:
    return Cylinder(*_radius_and_length(element, "Cylinder"))


def _capsule(element: Element) -> Geometry:
    return Capsule(*_radius_and_length(element, "Capsule"))


def _radius_and_length(element: Element, shape: str) -> tuple[float, float]:
    if element.get("length") is not None and element.get("radius") is not None:
        length = number_of(element, "length", "length [{}] is not a valid float")
        radius = number_of(element, "radius", "radius [{}] is not a valid float")
        if length is not None and radius is not None:
            refusal = f"{shape} length and radius must be positive finite values"
            _check_sizes(element, (radius, length), refusal)
            return radius, length
    raise element.error(f"{shape} shape must have both length and radius attributes")


def _check_sizes(element: Element, sizes: Iterable[float], refusal: str) -> None:
    """Reject sizes that are not positive, from version 1.2 on; numbers are always finite."""
    if minor_version(element) >= 2 and not all(size > 0 for size in sizes):
        raise element.error(refusal)


def _mesh(element: Element) -> Geometry:
    filename = element.get("filename")
    if filename is None:
        raise element.error("Mesh must contain a filename attribute")
    before = "Mesh scale was specified, but could not be parsed: "
    return Mesh(filename, vector_of(element, "scale", before) or (1.0, 1.0, 1.0))


_SHAPES = {"sphere": _sphere, "box": _box, "cylinder": _cylinder, "mesh": _mesh}
