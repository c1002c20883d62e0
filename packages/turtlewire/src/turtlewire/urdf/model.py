"""The content of a URDF: links, joints and their properties, in metres, radians and kilograms."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Literal, TypeAlias

from turtlewire.geometry import quaternions

if TYPE_CHECKING:
    from turtlewire.geometry.quaternions import Quaternion
    from turtlewire.urdf.faults import UrdfWarning

__all__ = [
    "MOVING_TYPES",
    "Box",
    "Calibration",
    "Capsule",
    "Collision",
    "Cylinder",
    "Description",
    "Dynamics",
    "Geometry",
    "Inertial",
    "Joint",
    "JointLimits",
    "JointType",
    "Link",
    "Material",
    "Mesh",
    "Mimic",
    "Pose",
    "Safety",
    "Sphere",
    "Vector",
    "Visual",
]

Vector: TypeAlias = tuple[float, float, float]
JointType: TypeAlias = Literal["revolute", "continuous", "prismatic", "fixed", "floating", "planar"]

#: Joints whose place is one number: an angle or a length.
MOVING_TYPES: frozenset[str] = frozenset({"revolute", "continuous", "prismatic"})


@dataclass(frozen=True, slots=True)
class Pose:
    """An ``origin`` element.

    Attributes:
        xyz: Translation in metres.
        rpy: Roll, pitch and yaw in radians about fixed axes: ``R = Rz(yaw) Ry(pitch) Rx(roll)``.
        quat_xyzw: The rotation as a unit quaternion, if the file gives it so (version 1.1); then
            ``rpy`` are the angles of the same rotation.
    """

    xyz: Vector = (0.0, 0.0, 0.0)
    rpy: Vector = (0.0, 0.0, 0.0)
    quat_xyzw: Quaternion | None = None

    @property
    def quaternion(self) -> Quaternion:
        """The rotation as a unit quaternion: x, y, z, w."""
        return self.quat_xyzw or quaternions.from_rpy(*self.rpy)


@dataclass(frozen=True, slots=True)
class Box:
    """A box; ``size`` is the full length of its edges in metres, its origin in the middle."""

    size: Vector


@dataclass(frozen=True, slots=True)
class Sphere:
    """A sphere; ``radius`` in metres."""

    radius: float


@dataclass(frozen=True, slots=True)
class Cylinder:
    """A cylinder along z, its origin in the middle; ``radius`` and ``length`` in metres."""

    radius: float
    length: float


@dataclass(frozen=True, slots=True)
class Capsule:
    """A cylinder along z with a half sphere at each end, its origin in the middle; in metres.

    ``length`` is that of the cylinder.
    """

    radius: float
    length: float


@dataclass(frozen=True, slots=True)
class Mesh:
    """A file with triangles; ``filename`` is a path or URI, ``scale`` a factor for each axis."""

    filename: str
    scale: Vector = (1.0, 1.0, 1.0)


Geometry: TypeAlias = Box | Sphere | Cylinder | Capsule | Mesh


@dataclass(frozen=True, slots=True)
class Material:
    """The colour and texture of a visual.

    Attributes:
        name: Name of the material.
        rgba: Red, green, blue and alpha, from 0 to 1; None if the file gives no colour.
        texture: Path or URI of an image; None without one.
    """

    name: str
    rgba: tuple[float, float, float, float] | None = None
    texture: str | None = None


@dataclass(frozen=True, slots=True)
class Visual:
    """A visible shape of a link; nothing is drawn if ``geometry`` is None."""

    geometry: Geometry | None
    origin: Pose = Pose()
    name: str = ""
    material: Material | None = None


@dataclass(frozen=True, slots=True)
class Collision:
    """The shape of a link for collisions; a ``geometry`` of None collides with nothing."""

    geometry: Geometry | None
    origin: Pose = Pose()
    name: str = ""


@dataclass(frozen=True, slots=True)
class Inertial:
    """Mass in kilograms and moments of inertia in kg m² about the centre of mass, ``origin``."""

    mass: float
    ixx: float
    ixy: float
    ixz: float
    iyy: float
    iyz: float
    izz: float
    origin: Pose = Pose()


@dataclass(frozen=True, slots=True)
class Link:
    """A rigid body; ``line`` is where the file defines it."""

    name: str
    inertial: Inertial | None = None
    visuals: tuple[Visual, ...] = ()
    collisions: tuple[Collision, ...] = ()
    line: int = 0


@dataclass(frozen=True, slots=True)
class JointLimits:
    """Limits in radians (prismatic joints: metres), N m (N), and rad/s (m/s), per s and per s².

    Acceleration, deceleration and jerk came with version 1.2. What has no limit is infinite.
    """

    lower: float
    upper: float
    effort: float
    velocity: float
    acceleration: float = math.inf
    deceleration: float = math.inf
    jerk: float = math.inf


@dataclass(frozen=True, slots=True)
class Mimic:
    """The joint follows another one: ``position = multiplier * other + offset``."""

    joint: str
    multiplier: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True, slots=True)
class Dynamics:
    """Damping in N m s/rad (prismatic joints: N s/m) and static friction in N m (N)."""

    damping: float = 0.0
    friction: float = 0.0


@dataclass(frozen=True, slots=True)
class Safety:
    """A ``safety_controller`` element."""

    k_velocity: float
    k_position: float = 0.0
    soft_lower_limit: float = 0.0
    soft_upper_limit: float = 0.0


@dataclass(frozen=True, slots=True)
class Calibration:
    """Positions of the reference edges; None where the file gives none."""

    rising: float | None = None
    falling: float | None = None


@dataclass(frozen=True, slots=True)
class Joint:
    """A connection of two links.

    Attributes:
        name: Name of the joint.
        type: One of ROS's six types.
        parent: Name of the link nearer to the root.
        child: Name of the other link. The joint's frame at position 0 is the child's frame.
        origin: Pose of the child in the parent's frame at position 0.
        axis: Direction in the joint's frame, as the file gives it, so of any length.
        limits: None if the file gives none; never None for revolute and prismatic joints.
        mimic: The joint that this one follows, or None.
        dynamics: Damping and friction, or None.
        safety: The safety controller, or None.
        calibration: The reference positions, or None.
        line: Where the file defines the joint.
    """

    name: str
    type: JointType
    parent: str
    child: str
    origin: Pose = Pose()
    axis: Vector = (1.0, 0.0, 0.0)
    limits: JointLimits | None = None
    mimic: Mimic | None = None
    dynamics: Dynamics | None = None
    safety: Safety | None = None
    calibration: Calibration | None = None
    line: int = 0

    @property
    def moves(self) -> bool:
        """True if one number is the joint's position: revolute, continuous or prismatic."""
        return self.type in MOVING_TYPES


@dataclass(frozen=True)
class Description:
    """The content of a URDF: a tree of links and joints.

    Attributes:
        name: Name of the robot.
        links: Links by name, in the order of the file, as are the joints and materials.
        joints: Joints by name.
        materials: Materials of the whole robot by name; those that a visual defines are included.
        root: Name of the link that no joint has as its child.
        warnings: What was odd and accepted.
    """

    name: str
    links: dict[str, Link]
    joints: dict[str, Joint]
    materials: dict[str, Material]
    root: str
    warnings: tuple[UrdfWarning, ...] = field(default=(), compare=False)

    @cached_property
    def parent_joints(self) -> dict[str, Joint]:
        """The joint above each link, by the link's name; the root is missing."""
        return {joint.child: joint for joint in self.joints.values()}

    @cached_property
    def child_joints(self) -> dict[str, tuple[Joint, ...]]:
        """The joints below each link, by the link's name, sorted by the joints' names."""
        found: dict[str, list[Joint]] = {name: [] for name in self.links}
        for joint in sorted(self.joints.values(), key=lambda joint: joint.name):
            found[joint.parent].append(joint)
        return {name: tuple(joints) for name, joints in found.items()}
