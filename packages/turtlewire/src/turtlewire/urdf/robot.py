"""A robot: the content of a URDF, with forward kinematics."""

from __future__ import annotations

import errno
import os
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from functools import cached_property
from typing import TYPE_CHECKING

from turtlewire.call_errors import explain_calls, hint_at
from turtlewire.errors import UrdfError
from turtlewire.path_arguments import missing_file, path_text
from turtlewire.urdf.faults import XACRO_LEFT
from turtlewire.urdf.model import Description
from turtlewire.urdf.parser import parse_urdf
from turtlewire.wording import counted

if TYPE_CHECKING:
    from typing import TypeAlias

    import numpy as np
    from numpy.typing import ArrayLike, NDArray
    from typing_extensions import Self

    from turtlewire.tf.buffer import Buffer
    from turtlewire.urdf.kinematics import Kinematics

    Positions: TypeAlias = Mapping[str, ArrayLike] | ArrayLike

__all__ = ["Robot", "is_xml"]


def is_xml(path: object) -> bool:
    """Return whether an argument for a path is XML instead."""
    return isinstance(path, (str, bytes)) and path.lstrip()[:1] in {"<", b"<"}


def _with_file(error: UrdfError, path: str, content: bytes) -> UrdfError:
    """Return an error whose hint names the file and, if it has another format, what to do."""
    parts = [f"{path}, {error.place}" if error.line else path]
    if b"<xacro:" in content:
        parts.append(f"xacro makes URDF of it: xacro {path} > robot.urdf")
    for tag, name in (("<sdf>", "SDF"), ("<mujoco", "MJCF")):
        if error.element.startswith(tag):
            parts.append(f"It is {name}; Robot.load reads URDF")
    fresh = UrdfError(str(error))  # without a position, which would add a note
    fresh.reports, fresh.line, fresh.element = error.reports, error.line, error.element
    fresh.with_hint(". ".join(parts))
    return fresh


@hint_at(
    {
        "link_fk fk forward_kinematics compute_fk get_fk": "link_poses(positions)",
        "link_map": "links",
        "joint_map": "joints",
        "actuated_joint_names actuated_joints free_joints": "joint_names",
        "joint_limits limits": "lower and upper",
        "root root_link base_link": "link_names[0]",
        "buffer": "transforms(positions, stamps)",
        "from_urdf from_file load_urdf": "Robot.load(path)",
        "from_xml_string from_string": "Robot.from_xml(text)",
        "show plot": "turtlewire.show(robot)",
    }
)
@explain_calls
@dataclass(frozen=True, repr=False)
class Robot(Description):
    """A tree of links and joints, and the poses of its links at given positions of its joints.

    ``positions`` are either positions by name of the joint, each a number or an array of N numbers
    (joints not named are at 0), or an array (joints,) or (N, joints) with a column for each of
    `joint_names`. They are in radians or, for prismatic joints, in metres. Mimic joints follow the
    free ones. Floating and planar joints stay at their origin, because one number cannot say where
    they are.

    Attributes:
        name: Name of the robot.
        links: Links by name, in the order of the file, as are the joints and materials.
        joints: Joints by name.
        materials: Materials of the whole robot by name, including those that a visual defines.
        root: Name of the link that is not the child of a joint.
        warnings: What was odd and accepted.
        xml: The URDF itself.
    """

    xml: str = field(default="", compare=False)

    def __new__(cls, *arguments: object, **parts: object) -> Self:
        """Refuse a single argument, for example XML or a path."""
        if len(arguments) == 1 and not parts:
            raise TypeError("call Robot.from_xml(text) for XML, or Robot.load(path) for a file")
        return super().__new__(cls)

    def __repr__(self) -> str:
        moving = sum(joint.moves for joint in self.joints.values())
        return (
            f"<Robot {self.name!r}: {counted(len(self.links), 'link')}, "
            f"{counted(len(self.joints), 'joint')}, {moving} moving>"
        )

    def _repr_html_(self) -> str:
        from turtlewire.urdf.notebook import robot_html

        return robot_html(self)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Robot:
        """Return the robot that a URDF file describes.

        Raises:
            FileNotFoundError: ``path`` does not exist.
            IsADirectoryError: ``path`` is a folder.
            TypeError: ``path`` is not a path.
            UrdfError: See `from_xml`; or the file is one of xacro, which makes URDF of it.
            ValueError: ``path`` is XML.
        """
        if is_xml(path):
            raise ValueError("Robot.load accepts a path, not XML; for XML, call Robot.from_xml")
        name = path_text(path, what="path of a URDF file")
        if os.path.isdir(name):
            found = [each for each in sorted(os.listdir(name)) if each.endswith(".urdf")]
            advice = f"it contains {', '.join(found)}" if found else "it contains no .urdf file"
            text = f"a robot is a URDF file, not a folder; {advice}"
            raise IsADirectoryError(errno.EISDIR, text, name)
        if not os.path.exists(name):
            raise missing_file(name)
        with open(name, "rb") as file:
            content = file.read()
        try:
            robot = cls.from_xml(content)
        except UrdfError as error:
            raise _with_file(error, name, content) from None
        left = [each for each in robot.warnings if each.text == XACRO_LEFT]
        if left:
            xacro = UrdfError("This is a xacro file, not URDF", left[0].line, left[0].element)
            raise _with_file(xacro, name, content)
        return robot

    @classmethod
    def from_xml(cls, text: str | bytes) -> Robot:
        """Return the robot that a URDF describes.

        Elements that urdfdom does not know (``gazebo``, ``transmission``, ``ros2_control``) are
        ignored.

        Args:
            text: The XML; for xacro files, the output of ``xacro``.

        Raises:
            TypeError: ``text`` is neither str nor bytes.
            UrdfError: urdfdom rejects the description, the links do not form a tree, or the XML
                declares entities. ``line`` and ``element`` of the error are the position.
        """
        try:
            found = parse_urdf(text)
        except UrdfError as error:
            if isinstance(text, str) and "<" not in text:
                error.with_hint("This text is not XML. To read a file, call Robot.load.")
            raise
        parts = {each.name: getattr(found, each.name) for each in fields(found)}
        return cls(**parts, xml=text if isinstance(text, str) else text.decode("utf-8", "replace"))

    @cached_property
    def _kinematics(self) -> Kinematics:
        from turtlewire.urdf.kinematics import Kinematics  # NumPy is loaded when poses are needed

        return Kinematics(self)

    @property
    def joint_names(self) -> tuple[str, ...]:
        """The free joints, in the order of the file: moving joints that do not follow another.

        Raises:
            UrdfError: Joints mimic each other in a loop; so for all methods below.
        """
        return self._kinematics.joints

    @property
    def link_names(self) -> tuple[str, ...]:
        """The links, parents before children: the second axis of `link_poses`."""
        return self._kinematics.links

    @property
    def lower(self) -> NDArray[np.float64]:
        """(joints,) the lower limits in radians or metres; -inf for continuous joints."""
        return self._kinematics.lower

    @property
    def upper(self) -> NDArray[np.float64]:
        """(joints,) the upper limits in radians or metres; inf for continuous joints."""
        return self._kinematics.upper

    def _states(self, positions: Positions) -> NDArray[np.float64]:
        """Return the positions as an array, with a warning about those in degrees."""
        states = self._kinematics.joint_states(positions)
        if found := self._kinematics.in_degrees(states):
            warnings.warn(found, stacklevel=4)
        return states

    def link_poses(self, positions: Positions) -> NDArray[np.float64]:
        """Return the pose of each link in the root link.

        Args:
            positions: The positions of the joints. Limits are not applied.

        Returns:
            (N, links, 7) float64: x y z in metres and the unit quaternion x y z w, for the links in
            the order of `link_names`. N is 1 for single positions.

        Raises:
            KeyError: No free joint has that name.
            ValueError: The shapes do not fit.

        Warns:
            UserWarning: The positions of a revolute joint look like degrees.
        """
        return self._kinematics.link_poses(self._states(positions))

    def transforms(self, positions: Positions, stamps: ArrayLike | None = None) -> Buffer:
        """Return a buffer with the transforms of all links.

        Args:
            positions: The positions of the joints. Limits are not applied.
            stamps: (N,) int64 nanoseconds or ``datetime64``, one for each row of the positions.
                Without stamps all transforms are static.

        Raises:
            KeyError: No free joint has that name.
            ValueError: The shapes do not fit, or there are several rows and no stamps.
        """
        return self._kinematics.buffer(self._states(positions), stamps)

    def clip(self, positions: Positions) -> NDArray[np.float64]:
        """Return the positions (N, joints) moved into the limits; continuous joints have none."""
        return self._kinematics.clip(positions)

    def within_limits(self, positions: Positions) -> NDArray[np.bool_]:
        """Return which of the positions (N, joints) are within the limits; False for NaN."""
        return self._kinematics.within_limits(positions)
