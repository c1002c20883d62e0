"""Robots that are shown by a path, or by a name of the PyPI package ``robot_descriptions``."""

from __future__ import annotations

import errno
import os
import re
from collections.abc import Mapping
from importlib import import_module
from importlib.util import find_spec
from typing import Any, NamedTuple

from turtlewire.path_arguments import near_path
from turtlewire.terminal.suggestion import did_you_mean
from turtlewire.urdf import Robot
from turtlewire_view.package_folders import PackageFolders

__all__ = ["FoundRobot", "find_robot"]

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
