"""Robots by path, or by name in ``robot_descriptions``; and their joints, which pages move."""

from __future__ import annotations

import errno
import math
import os
import re
import threading
from collections.abc import Mapping
from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any, NamedTuple

from turtlewire.path_arguments import near_path
from turtlewire.terminal.suggestion import did_you_mean
from turtlewire.urdf import Robot
from turtlewire.urdf.joints import followers_of
from turtlewire.web.commands import is_finite_number
from turtlewire_view.package_folders import PackageFolders

if TYPE_CHECKING:
    from turtlewire.tf.buffer import Buffer

__all__ = ["FoundRobot", "RobotJoints", "find_robot", "zero_of"]

_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_]*")
_SUFFIX = "_description"
_INSTALL = "pip install 'turtlewire-view[robots]'"


class FoundRobot(NamedTuple):
    """A robot, and where its meshes are."""

    robot: Robot
    packages: PackageFolders


def find_robot(what: str, packages: Mapping[str, str]) -> FoundRobot | None:
    """Return the robot of a URDF file or of a name; None if ``what`` is a path of something else.

    Args:
        what: A path, or a name such as ``panda`` for the module ``panda_description`` of
            ``robot_descriptions``. If there is a file or folder of that name, it is a path.
        packages: Folders of packages that the user has named.

    Raises:
        ConnectionError: The description cannot be fetched.
        FileNotFoundError: No file and no robot has this name.
        ModuleNotFoundError: The description needs xacrodoc, which is not installed.
        UrdfError: The description is invalid.
        ValueError: The description is not a URDF.
    """
    if what.endswith((".urdf", ".xacro")):
        return FoundRobot(Robot.load(what), PackageFolders(packages, what))
    if os.path.exists(what) or not _NAME.fullmatch(what):
        return None
    if find_spec("robot_descriptions") is None:
        advice = f"to show a robot of this name: {_INSTALL}"
        raise _nothing_named(what, f"{near_path(what)}; {advice}")
    return _described(what, _fetched(_module_of(what)), packages)


def _module_of(name: str) -> str:
    """Return the name of the module that describes a robot."""
    known: Mapping[str, Any] = import_module("robot_descriptions").DESCRIPTIONS
    module = name if name in known else name + _SUFFIX
    urdfs = {each.removesuffix(_SUFFIX) for each, about in known.items() if about.has_urdf}
    near = did_you_mean(name.removesuffix(_SUFFIX).removesuffix("_mj"), urdfs)
    if module not in known:
        text = f", and robot_descriptions has no robot of this name. {near}".rstrip(". ")
        raise _nothing_named(name, text)
    if not known[module].has_urdf:
        text = f"robot_descriptions has {name} only as MJCF, and the view shows URDF. {near}"
        raise ValueError(text.strip())
    return module


def _fetched(module: str) -> Any:
    """Import the module, which fetches the description with git when it is not there yet."""
    try:
        return import_module(f"robot_descriptions.{module}")
    except Exception as error:  # git's, or whatever else ends the import
        reason = (str(error).strip().splitlines() or [type(error).__name__])[-1].strip()
        reason = reason.removeprefix("stderr: '").rstrip("'")  # git's own line
        raise ConnectionError(
            f"the description of {module.removesuffix(_SUFFIX)} cannot be fetched: {reason}. "
            "git fetches it when it is shown for the first time, which needs a network."
        ) from error


def _described(name: str, module: Any, packages: Mapping[str, str]) -> FoundRobot:
    package, repository = module.PACKAGE_PATH, module.REPOSITORY_PATH
    roots = (package, repository, os.path.dirname(package), os.path.dirname(repository))
    path: str | None = getattr(module, "URDF_PATH", None)
    if path is not None:
        return FoundRobot(Robot.load(path), PackageFolders(packages, path, roots))
    others: Mapping[str, str] = getattr(module, "XACRO_PACKAGE_PATHS", {})
    # Paths in the URDF that xacro makes are relative to the package.
    around = PackageFolders({**others, **packages}, os.path.join(package, "robot.urdf"), roots)
    return FoundRobot(Robot.from_xml(_without_xacro(name, module, others)), around)


def _without_xacro(name: str, module: Any, packages: Mapping[str, str]) -> str:
    """Return the URDF that xacro makes of the module's file."""
    try:
        xacrodoc = import_module("xacrodoc")
    except ModuleNotFoundError as error:
        text = f"the description of {name} needs xacrodoc: {_INSTALL}"
        raise ModuleNotFoundError(text, name="xacrodoc") from error
    import_module("xacrodoc.packages").update_package_cache(dict(packages))
    document = xacrodoc.XacroDoc.from_file(
        module.XACRO_PATH, subargs=dict(getattr(module, "XACRO_ARGS", {}))
    )
    return str(document.to_urdf_string())


def _nothing_named(what: str, advice: str) -> FileNotFoundError:
    return FileNotFoundError(errno.ENOENT, f"No such file or directory{advice}", what)


class RobotJoints:
    """The joints of a robot; all pages share them. Thread-safe.

    Args:
        robot: The robot.
        positions: The position of each free joint [rad or m].
        buffer: Has the transforms of all links, and gets new ones.
    """

    def __init__(self, robot: Robot, positions: dict[str, float], buffer: Buffer) -> None:
        self._robot = robot
        self._positions = positions
        self._buffer = buffer
        self._lock = threading.Lock()
        self._followers = followers_of(robot)
        self._moving = [each for each in robot.joints.values() if each.moves]

    def description(self) -> list[dict[str, Any]]:
        """Return name, kind, limits and formula of each joint, in the order of the file."""
        return [self._describe(each.name, each.type) for each in self._moving]

    def positions(self) -> list[float]:
        """Return the positions of the joints of :meth:`description` [rad or m]."""
        with self._lock:
            return [self._position(each.name) for each in self._moving]

    def move(self, positions: Mapping[str, Any]) -> None:
        """Move joints, within their limits.

        Args:
            positions: Positions of free joints by name [rad or m].

        Raises:
            ValueError: The robot has no such joint, or a position is not a finite number.
        """
        for name, position in positions.items():
            if name not in self._positions:
                near = did_you_mean(name, self._positions)
                raise ValueError(f"the robot has no free joint {name!r:.100}. {near}".rstrip())
            if not is_finite_number(position):
                raise ValueError(
                    f"the position of {name!r} must be a number, got {position!r:.100}"
                )
        with self._lock:
            for name, position in positions.items():
                low, high = _limits(self._robot, name)
                self._positions[name] = min(max(float(position), low), high)
            self._write()

    def _write(self) -> None:
        moved = self._robot.transforms(self._positions)
        for joint in self._moving:
            link = moved.lookup_transform(joint.parent, joint.child)
            self._buffer.set_static_transform(
                joint.parent,
                joint.child,
                link.translation,
                link.rotation,
                sender=f"joint {joint.name}",
            )

    def _position(self, name: str) -> float:
        follower = self._followers.get(name)
        if follower is None:
            return self._positions[name]
        return self._positions[follower.leader] * follower.multiplier + follower.offset

    def _describe(self, name: str, kind: str) -> dict[str, Any]:
        follower = self._followers.get(name)
        if follower is not None:
            formula = {
                "parent": follower.leader,
                "factor": follower.multiplier,
                "offset": follower.offset,
            }
            return {"name": name, "kind": kind, "mimic": formula}
        low, high = _limits(self._robot, name)
        limits = self._robot.joints[name].limits
        return {
            "name": name,
            "kind": kind,
            "mimic": None,
            "minimum": low,
            "maximum": high,
            "zero": zero_of(self._robot, name),
            "max_velocity": limits.velocity if limits and math.isfinite(limits.velocity) else None,
        }


def _limits(robot: Robot, name: str) -> tuple[float, float]:
    """Return the least and the greatest position; a continuous joint makes one turn."""
    column = robot.joint_names.index(name)
    low, high = float(robot.lower[column]), float(robot.upper[column])
    return (low, high) if math.isfinite(low) and math.isfinite(high) else (-math.pi, math.pi)


def zero_of(robot: Robot, name: str) -> float:
    """Return the position of a joint at first: 0, or the middle of its limits."""
    low, high = _limits(robot, name)
    return 0.0 if low <= 0.0 <= high else (low + high) / 2
