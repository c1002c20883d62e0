"""RobotModel: a URDF's shapes, each below the live frame of its link.

The mass of a link is a ball of lead of that weight, as in RViz. The inertia is the box of even
density that has the link's mass and moments of inertia; a link whose moments no body can have gets
none.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from turtlewire.geometry import quaternions
from turtlewire.geometry.conversions import matrix_from_quaternion, quaternion_from_matrix
from turtlewire.urdf import Robot, UrdfError
from turtlewire.urdf.model import Box, Capsule, Cylinder, Mesh, Pose, Sphere
from turtlewire_view.displays.content import (
    Content,
    Display,
    Output,
    Removal,
    UnusableMessageError,
)
from turtlewire_view.displays.numeric import LARGEST
from turtlewire_view.meshes import file_of_package, mesh_address

if TYPE_CHECKING:
    from turtlewire.urdf.model import Collision, Geometry, Inertial, Link, Material, Visual
    from turtlewire_view.package_folders import PackageFolders

__all__ = [
    "RobotModelDisplay",
    "inertia_shapes",
    "pose_of_origin",
    "robot_content",
]

#: Density of lead [kg/m^3].
_LEAD = 11340.0
_INERTIA_COLOR = [255, 0, 0, 255]


def inertia_shapes(link: Link) -> dict[str, list[dict[str, Any]]]:
    """``mass`` and ``inertia`` of a link: each a list of one shape, or of none."""
    inertial = link.inertial
    origin = None if inertial is None else pose_of_origin(inertial.origin)
    if inertial is None or origin is None or not 0 < inertial.mass < LARGEST:
        return {"mass": [], "inertia": []}
    radius = (0.75 * inertial.mass / (math.pi * _LEAD)) ** (1 / 3)
    ball = {"shape": "sphere", "size": [radius], "color": _INERTIA_COLOR, "origin": origin}
    box = _box(inertial, origin)
    return {"mass": [ball], "inertia": [] if box is None else [box]}


def pose_of_origin(pose: Pose) -> list[float] | None:
    """x, y, z, qx, qy, qz, qw of an origin; None if it is not finite."""
    if not all(abs(value) < LARGEST for value in (*pose.xyz, *pose.rpy)):
        return None
    return [*pose.xyz, *pose.quaternion]


def _box(inertial: Inertial, origin: list[float]) -> dict[str, Any] | None:
    """Return the box along the principal axes; None for moments that no body has."""
    each = inertial
    tensor = np.array(
        [
            [each.ixx, each.ixy, each.ixz],
            [each.ixy, each.iyy, each.iyz],
            [each.ixz, each.iyz, each.izz],
        ]
    )
    if not np.isfinite(tensor).all():
        return None
    moments, axes = np.linalg.eigh(tensor)
    if np.linalg.det(axes) < 0:
        axes[:, 0] *= -1
    squares = 6 / inertial.mass * (moments.sum() - 2 * moments)
    if moments.min() <= 0 or squares.min() < 0 or squares.max() > LARGEST:
        return None
    turned = quaternion_from_matrix(matrix_from_quaternion(origin[3:]) @ axes)
    return {
        "shape": "box",
        "size": [float(value) for value in np.sqrt(squares)],
        "color": _INERTIA_COLOR,
        "origin": [*origin[:3], *(float(value) for value in turned)],
    }


#: What RViz gives a visual without a material.
_DEFAULT_COLOR = [200, 10, 10, 255]
_LONGEST_DESCRIPTION = 16 * 2**20


class RobotModelDisplay(Display):
    """The robot that a ``std_msgs/msg/String``, a node's parameter or a file describes.

    Options: ``source`` (``topic``, ``parameter``, ``file``) says which; ``node`` and ``parameter``
    name the parameter, ``description_file`` is the path of a ``.urdf`` file. ``tf_prefix`` stands
    before the links' names in frames, with a slash. The others say to the page what is drawn.
    """

    kind = "robot_model"
    replays = True
    _origin: tuple[str, ...] | None = None

    @property
    def parameter(self) -> tuple[str, str] | None:
        """Node and parameter that describe the robot, if it is to come from there."""
        if self.options.text("source") != "parameter":
            return None
        return "/" + self.options.text("node").strip("/"), self.options.text("parameter")

    def start(self) -> list[Output]:
        """Return the robot of the file, if it is to come from there; one from elsewhere goes."""
        file = self.options.text("description_file")
        origin = (self.options.text("source"), *(self.parameter or ()), file)
        gone: list[Output] = [] if self._origin in {None, origin} else [Removal("")]
        self._origin = origin
        if origin[0] == "file":
            return [*gone, *self._answer(lambda: [self._robot_of_file(file)])]
        return gone

    def content(self, message: Any) -> list[Output]:
        """Return the robot of a message, if it is to come from there."""
        return super().content(message) if self.options.text("source") == "topic" else []

    def take_parameter(self, text: str) -> list[Output]:
        """Return the robot that a parameter describes."""
        return self._answer(lambda: [self._robot(text)])

    def _outputs(self, message: Any) -> list[Output]:
        return [self._robot(message.data)]

    def _robot(self, text: str, packages: PackageFolders | None = None) -> Content:
        prefix = self.options.text("tf_prefix")
        return robot_content(text, prefix, self.warn, packages or self.packages)

    def _robot_of_file(self, file: str) -> Content:
        """The robot of a path or ``package://`` address that ends with ``.urdf``."""
        if not file:
            raise UnusableMessageError("no file is chosen: give the path of a .urdf file")
        path: str | None = file.removeprefix("file://")
        if file.startswith("package://"):
            path = file_of_package(file, self.packages)
        if path is None or not path.endswith(".urdf"):
            raise UnusableMessageError(f"'{file}' is not the path of a .urdf file")
        try:
            with open(path, encoding="utf-8", errors="replace") as opened:
                text = opened.read(_LONGEST_DESCRIPTION + 1)
        except (OSError, ValueError) as error:  # a path with a NUL is a ValueError
            reason = getattr(error, "strerror", None) or str(error)
            raise UnusableMessageError(f"'{file}' cannot be read: {reason}") from error
        return self._robot(text, self.packages.beside(path))


def robot_content(
    text: str, tf_prefix: str, warn: Callable[[str], None], packages: PackageFolders
) -> Content:
    """Return the drawing of a URDF.

    The header's ``links`` have ``name``, the ``frame`` that each hangs on, and ``visuals`` and
    ``collisions`` with shape, origin (x, y, z, qx, qy, qz, qw), colour, texture and mesh; ``mass``
    and ``inertia`` are also lists of such shapes, see `inertia_shapes`.

    Args:
        text: The XML.
        tf_prefix: Stands before the links' names.
        warn: Gets what urdfdom forgives, and what cannot be drawn.
        packages: Where packages with meshes lie.

    Raises:
        UnusableMessageError: urdfdom would refuse the description.
    """
    if len(text) > _LONGEST_DESCRIPTION:
        raise UnusableMessageError(f"a description of {len(text)} characters is too long")
    try:
        robot = Robot.from_xml(text)
    except UrdfError as error:
        raise UnusableMessageError(f"the description is invalid: {error}") from error
    for warning in robot.warnings:
        warn(f"{warning.text} ({warning.place})")
    reader = _Reader(robot, warn, packages)
    prefix = tf_prefix.rstrip("/") + "/" if tf_prefix else ""
    links = [
        {
            "name": link.name,
            "frame": prefix + link.name,
            "visuals": reader.shapes(link, link.visuals),
            "collisions": reader.shapes(link, link.collisions),
            **inertia_shapes(link),
        }
        for link in robot.links.values()
    ]
    header = {"robot": robot.name, "root": prefix + robot.root, "links": links}
    return Content(header, packages=tuple(sorted(reader.packages)))


def _drawn(body: Visual | Collision) -> list[tuple[Geometry | None, Pose]]:
    """Return the shapes that are drawn: a capsule is a cylinder and two spheres."""
    shape, origin = body.geometry, body.origin
    if not isinstance(shape, Capsule):
        return [(shape, origin)]
    up = quaternions.rotate(origin.quaternion, (0.0, 0.0, shape.length / 2))
    (x, y, z), (dx, dy, dz) = origin.xyz, up
    ends = [replace(origin, xyz=(x + s * dx, y + s * dy, z + s * dz)) for s in (1, -1)]
    ball = Sphere(shape.radius)
    return [(Cylinder(shape.radius, shape.length), origin), *((ball, end) for end in ends)]


class _Reader:
    """Shapes of links as headers."""

    def __init__(self, robot: Robot, warn: Callable[[str], None], folders: PackageFolders) -> None:
        self._materials = robot.materials
        self._warn = warn
        self._folders = folders
        self.packages: set[tuple[str, str]] = set()

    def shapes(self, link: Link, bodies: Iterable[Visual | Collision]) -> list[dict[str, Any]]:
        shapes = []
        for body in bodies:
            for geometry, pose in _drawn(body):
                shape, origin = self._shape(geometry), pose_of_origin(pose)
                if shape is None or origin is None:
                    if geometry is not None:
                        self._warn(f"link '{link.name}': a size or origin is not finite")
                    continue
                look = self._look(link, getattr(body, "material", None))
                shapes.append({**shape, **look, "origin": origin})
        return shapes

    def _shape(self, geometry: Geometry | None) -> dict[str, Any] | None:
        """Shape and size; None for nothing, or for sizes that are not finite."""
        if isinstance(geometry, Box):
            return _sized("box", size=list(geometry.size))
        if isinstance(geometry, Sphere):
            return _sized("sphere", size=[geometry.radius])
        if isinstance(geometry, Cylinder):
            return _sized("cylinder", size=[geometry.radius, geometry.length])
        if isinstance(geometry, Mesh):
            address = mesh_address(geometry.filename, self._folders)
            self._note(address.problem, address.packages)
            mesh = {"name": geometry.filename, **address.header()}
            return _sized("mesh", size=list(geometry.scale), mesh=mesh)
        return None

    def _look(self, link: Link, material: Material | None) -> dict[str, Any]:
        """Colour and texture; a material without either refers to the robot's one of its name."""
        if material is None:
            return {"color": None}
        named = self._materials.get(material.name, material)
        rgba = material.rgba or named.rgba
        look: dict[str, Any] = {"color": None}
        if rgba is not None and all(map(math.isfinite, rgba)):
            look["color"] = [round(255 * max(0.0, min(1.0, value))) for value in rgba]
        texture = material.texture or named.texture
        if texture:
            address = mesh_address(texture, self._folders, texture=True)
            self._note(address.problem, address.packages)
            if address.url is not None:
                look["texture"] = address.url
        if look == {"color": None}:
            look["color"] = _DEFAULT_COLOR
            self._warn(f"link '{link.name}': the material '{material.name}' has no colour")
        return look

    def _note(self, problem: str, packages: tuple[tuple[str, str], ...]) -> None:
        if problem:
            self._warn(problem)
        self.packages.update(packages)


def _sized(shape: str, size: list[float], **more: Any) -> dict[str, Any] | None:
    usable = all(abs(value) < LARGEST for value in size)
    return {"shape": shape, "size": size, **more} if usable else None
