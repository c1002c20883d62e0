"""Lets ``colcon build`` build packages of interfaces and of data without CMake and compiler.

colcon-ros hands every ``ament_cmake`` package to CMake. A package whose CMakeLists.txt generates
interfaces and builds nothing else, or only installs files, gets a type of its own here, which this
distribution builds. All other packages stay with colcon-ros.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path
from shutil import copyfile
from typing import TYPE_CHECKING, Any

from colcon_core.environment import create_environment_hooks, create_environment_scripts
from colcon_core.logging import colcon_logger
from colcon_core.package_identification import PackageIdentificationExtensionPoint
from colcon_core.python_install_path import get_python_install_path
from colcon_core.shell import create_environment_hook, get_command_environment
from colcon_core.task import TaskExtensionPoint, run
from colcon_ros.package_identification.ros import RosPackageIdentification

from turtlewire_ros.cmake_data import install_files, read_installs
from turtlewire_ros.manifest import manifest_fault

if TYPE_CHECKING:
    from colcon_core.package_descriptor import PackageDescriptor

__all__ = [
    "DataPackageBuild",
    "InterfacePackageBuild",
    "InterfacePackageIdentification",
    "UnreadablePackageBuild",
]

_DATA_TYPE = "ros.turtlewire_data"
_TYPE = "ros.turtlewire_interfaces"  # "ros." has colcon-ros read the dependencies in package.xml
_UNREADABLE_TYPE = "turtlewire.unreadable"
_KINDS = ("msg", "srv", "action")
_BUILDS_CODE = re.compile(
    r"^\s*(add_executable|add_library|ament_python_install_package)\s*\(", re.MULTILINE
)
_GENERATES_INTERFACES = re.compile(r"^\s*rosidl_generate_interfaces\s*\(", re.MULTILINE)


class InterfacePackageIdentification(PackageIdentificationExtensionPoint):
    """Recognizes packages that consist of interface definitions or of files to install."""

    PRIORITY = RosPackageIdentification.PRIORITY + 10

    def __init__(self) -> None:
        super().__init__()
        self._ros = RosPackageIdentification()

    def identify(self, desc: PackageDescriptor) -> None:
        """Set name and type of such a package, and of one whose package.xml is broken."""
        cmake, manifest = desc.path / "CMakeLists.txt", desc.path / "package.xml"
        if not manifest.is_file():
            return
        fault = manifest_fault(manifest)
        if fault is not None:
            colcon_logger.error(fault)
            desc.name, desc.type = desc.path.name, _UNREADABLE_TYPE
            return
        if not cmake.is_file():
            return
        text = cmake.read_text(encoding="utf-8", errors="replace")
        if _GENERATES_INTERFACES.search(text) and not _BUILDS_CODE.search(text):
            kind = _TYPE
        elif read_installs(text) is not None:
            kind = _DATA_TYPE
        else:
            return
        self._ros.identify(desc)
        if desc.type == "ros.ament_cmake":
            desc.type = kind


class UnreadablePackageBuild(TaskExtensionPoint):
    """Fails for a package whose package.xml cannot be read.

    colcon-ros would build it as a plain Python package, which ROS does not find.
    """

    async def build(self) -> int:
        """Return the exit status; the fault was logged when the package was found."""
        return 1


class InterfacePackageBuild(TaskExtensionPoint):
    """Installs definitions, modules and stubs of an interface package."""

    async def build(self) -> int:
        """Build the package of the context; returns the exit status."""
        args, name = self.context.args, self.context.pkg.name
        prefix, source = Path(args.install_base), Path(args.path)
        try:
            environment = await get_command_environment(
                "build", args.build_base, self.context.dependencies
            )
        except RuntimeError as error:
            colcon_logger.error(str(error))
            return 1
        modules = Path(
            get_python_install_path("purelib", {"base": str(prefix), "platbase": str(prefix)})
        )
        command = [
            sys.executable,
            "-m",
            "turtlewire.msg",
            str(source),
            "--output",
            str(modules),
            "--package",
            name,
        ]
        done = await run(self.context, command, cwd=args.build_base, env=environment)
        if done.returncode:
            return int(done.returncode)
        _install_share(name, source, prefix)
        _create_environment(self.context)
        return 0


class DataPackageBuild(TaskExtensionPoint):
    """Installs the files that the CMakeLists.txt of a package without code names."""

    async def build(self) -> int:
        """Build the package of the context; returns the exit status."""
        args, name = self.context.args, self.context.pkg.name
        prefix, source = Path(args.install_base), Path(args.path)
        text = (source / "CMakeLists.txt").read_text(encoding="utf-8", errors="replace")
        try:
            install_files(read_installs(text) or [], source, prefix)
        except OSError as error:
            colcon_logger.error(
                f"{name}: cannot install {error.filename}: {error.strerror} "
                f"(named in {source / 'CMakeLists.txt'})"
            )
            return 1
        _register(name, source, prefix, {"packages": ""})
        _create_environment(self.context)
        return 0


def _create_environment(context: Any) -> None:
    """Write the package's part of the workspace's setup files."""
    name, prefix = context.pkg.name, Path(context.args.install_base)
    hooks = create_environment_hooks(prefix, name)
    hooks += create_environment_hook(
        "ament_prefix_path", prefix, name, "AMENT_PREFIX_PATH", "", mode="prepend"
    )
    create_environment_scripts(context.pkg, context.args, default_hooks=hooks)


def _install_share(name: str, source: Path, prefix: Path) -> None:
    """Install the package's files and register them in ament's index, where tools find them."""
    share = prefix / "share" / name
    definitions = [
        path.relative_to(source)
        for kind in _KINDS
        for path in sorted((source / kind).glob(f"*.{kind}"))
    ]
    for file in definitions:
        (share / file).parent.mkdir(parents=True, exist_ok=True)
        copyfile(source / file, share / file)
    listed = "\n".join(path.as_posix() for path in definitions)
    _register(name, source, prefix, {"packages": "", "rosidl_interfaces": listed})


def _register(name: str, source: Path, prefix: Path, resources: dict[str, str]) -> None:
    """Install package.xml, and enter the package into ament's index."""
    share = prefix / "share" / name
    share.mkdir(parents=True, exist_ok=True)
    copyfile(source / "package.xml", share / "package.xml")
    index = prefix / "share" / "ament_index" / "resource_index"
    for resource, content in resources.items():
        (index / resource).mkdir(parents=True, exist_ok=True)
        (index / resource / name).write_text(content, encoding="utf-8")
