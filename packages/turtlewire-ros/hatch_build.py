"""Builds what is generated in the wheel: interface packages, and the files of a ROS 2 prefix.

The interface packages (``std_msgs`` …) are made of the engine's definitions. The prefix has files
for ament, colcon, rosdep and shells: every package on a shelf and every interface package is a ROS
package, and entry points of the groups ``turtlewire.executables.<package>`` become
``lib/<package>/<executable>``, as ``ros2 run`` expects them. ``py.typed`` in each package tells
type checkers that its code has annotations.
"""

from __future__ import annotations

import ast
import hashlib
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any
from xml.sax.saxutils import escape

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

_GROUP = "turtlewire.executables."
#: Folder of an sdist for files generated from the engine's definitions, which it does not contain.
_SHIPPED_FILES = "interface_files"
_SHIPPED_MODULES = "interface_modules"
#: The one package that has both code here and interfaces.
_MIXED = "turtlesim"
#: The package of the prefix itself.
_OWN = Path("prefix", "turtlewire_ros")
_RULES_URL = "file:///turtlewire/rosdep.yaml"

#: Packages that pip installs under their ROS names: the prefix makes them known, and `ros2 run` and
#: `$(find …)` find them.
_FROM_PYPI = {"xacro": "xacro, from PyPI: macros for XML files, such as URDF."}

_PACKAGE_XML = """<?xml version="1.0"?>
<package format="3">
  <name>{name}</name>
  <version>{version}</version>
  <description>{description}</description>
  <maintainer email="turtlewire@users.noreply.github.com">turtlewire</maintainer>
  <license>Apache-2.0</license>
  <export>
    <build_type>ament_python</build_type>
  </export>
</package>
"""

_EXECUTABLE = """#!/usr/bin/env python3
import sys

from turtlewire.program import run_executable

sys.exit(run_executable("{entry_point}"))
"""


class PrefixBuildHook(BuildHookInterface):  # type: ignore[type-arg]
    """Adds interface packages and the prefix's files to the wheel, editable ones included."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Make the files and name them to the builder of the wheel or of the sdist."""
        self._folder = Path(tempfile.mkdtemp(prefix="turtlewire-prefix-"))
        self._modules = Path(tempfile.mkdtemp(prefix="turtlewire-interfaces-"))
        root = Path(self.root)
        self._generate(root)
        if self.target_name == "sdist":
            build_data["force_include"][str(self._folder)] = _SHIPPED_FILES
            build_data["force_include"][str(self._modules)] = _SHIPPED_MODULES
            return
        self._add_interfaces(root, version, build_data)
        packages = {init.parent for init in root.glob("*/*/__init__.py")}
        for package in packages:
            (package / "py.typed").touch()
        packages |= {init.parent for init in self._modules.glob("*/__init__.py")}
        for package in sorted(packages):
            self._add_package(package.name, package)
        for name, description in _FROM_PYPI.items():
            self._add_marker(name, description)
        for group, entries in self.metadata.core.entry_points.items():
            if group.startswith(_GROUP):
                for name, target in entries.items():
                    self._add_executable(group.removeprefix(_GROUP), name, target)
        for source in (root / _OWN / "environment").iterdir():
            self._write(source.name, source.read_text(encoding="utf-8"))
        cache = "share/turtlewire/ros_home/rosdep/sources.cache"
        self._write(f"{cache}/index", f"yaml {_RULES_URL}\n")
        rules = (root / _OWN / "rosdep" / "rules.yaml").read_text(encoding="utf-8")
        self._write(
            f"{cache}/{hashlib.sha1(_RULES_URL.encode(), usedforsecurity=False).hexdigest()}", rules
        )
        for path in self._folder.rglob("*"):
            if path.is_file():
                build_data["shared_data"][str(path)] = path.relative_to(self._folder).as_posix()

    def finalize(self, _version: str, _build_data: dict[str, Any], _artifact: str) -> None:
        """Remove the files again; the wheel or the sdist has them."""
        shutil.rmtree(self._folder)
        shutil.rmtree(self._modules)

    def _generate(self, root: Path) -> None:
        """Make what the engine's definitions give, or take it from the sdist."""
        if (root / _SHIPPED_FILES).is_dir():
            shutil.copytree(root / _SHIPPED_FILES, self._folder, dirs_exist_ok=True)
            shutil.copytree(root / _SHIPPED_MODULES, self._modules, dirs_exist_ok=True)
            return
        needed = (root.parent / "turtlewire" / "src", root / "rosidl", root / "prefix")
        paths = os.pathsep.join(map(str, needed))
        subprocess.run(  # noqa: S603 -- our own module
            [
                sys.executable,
                "-m",
                "turtlewire_ros.interface_files",
                str(self._folder),
                str(self._modules),
            ],
            env={**os.environ, "PYTHONPATH": paths, "AMENT_PREFIX_PATH": "", "ROS_DISTRO": ""},
            check=True,
        )

    def _add_interfaces(self, root: Path, version: str, build_data: dict[str, Any]) -> None:
        """Put the interface packages into the wheel; real files also in an editable installation.

        Type checkers see them there, which they would not behind an import hook.
        """
        is_editable = version == "editable"
        included = build_data["force_include_editable" if is_editable else "force_include"]
        for package in self._modules.iterdir():
            if package.name != _MIXED:
                included[str(package)] = package.name
            elif is_editable:
                # Its code is imported from this folder, so its interfaces must also lie there.
                for kind in package.iterdir():
                    target = root / _MIXED / _MIXED / kind.name
                    shutil.rmtree(target, ignore_errors=True)
                    shutil.copytree(kind, target)
            else:  # a shelf has its name, and the builder removes shelves
                included[str(package)] = f"{_MIXED}/{_MIXED}"

    def _add_package(self, name: str, source: Path) -> None:
        docstring = (
            ast.get_docstring(ast.parse((source / "__init__.py").read_text(encoding="utf-8")))
            or name
        )
        self._add_marker(name, docstring.splitlines()[0])
        share = source / "share"
        for path in share.rglob("*") if share.is_dir() else ():
            if path.is_file() and path.suffix != ".pyc":
                self._write(
                    f"share/{name}/{path.relative_to(share).as_posix()}",
                    path.read_text(encoding="utf-8"),
                )

    def _add_marker(self, name: str, description: str) -> None:
        description = escape(description)
        self._write(f"share/ament_index/resource_index/packages/{name}", "")
        self._write(
            f"share/{name}/package.xml",
            _PACKAGE_XML.format(name=name, version=self.metadata.version, description=description),
        )
        # Without it, colcon treats a venv in a workspace as sources.
        self._write(f"share/{name}/COLCON_IGNORE", "")

    def _add_executable(self, package: str, name: str, target: str) -> None:
        path = self._write(f"lib/{package}/{name}", _EXECUTABLE.format(entry_point=target))
        path.chmod(0o755)

    def _write(self, path: str, text: str) -> Path:
        file = self._folder / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
        return file
