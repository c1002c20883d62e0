"""The plan of a package: evaluates the CMakeLists.txt in its folder."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

from turtlewire_colcon.cmake.ament import AMENT, OWN_PARTS, XACRO
from turtlewire_colcon.cmake.basics import BASICS
from turtlewire_colcon.cmake.files import FILES
from turtlewire_colcon.cmake.interpreter import Interpreter
from turtlewire_colcon.cmake.plan import Plan
from turtlewire_colcon.cmake.processes import PROCESSES
from turtlewire_colcon.cmake.syntax import CMakeError
from turtlewire_colcon.cmake.targets import ROS_1, TARGETS
from turtlewire_colcon.package_lookup import PackageLookup
from turtlewire_ros.manifest import read_manifest

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["evaluate_package"]

_DEFINITION = re.compile(r"-D\s*(\w+)(?::\w+)?=(.*)", re.DOTALL)

_C_STANDARDS = ("90", "99", "11", "17", "23")
_CXX_STANDARDS = ("98", "11", "14", "17", "20", "23")


def evaluate_package(
    source: Path,
    build: Path,
    prefix: Path,
    python_folder: str,
    environment: Mapping[str, str] = os.environ,
    cmake_arguments: Iterable[str] = (),
) -> tuple[Plan, Interpreter]:
    """Evaluate the CMakeLists.txt in a folder: what it installs, generates and tests.

    Args:
        source: The folder with CMakeLists.txt and package.xml.
        build: Where commands write files.
        prefix: Where the package is installed.
        python_folder: The folder of Python packages in it, relative to it.
        environment: With the prefixes of the packages that it depends on.
        cmake_arguments: As typed after ``--cmake-args``; ``-DNAME=VALUE`` sets a variable.

    Returns:
        The plan, and the interpreter with the variables as they are at the end.

    Raises:
        CMakeError: The file cannot be evaluated; the text begins with file and line. In a package
            with C++, only faults of commands for its other parts are raised.
        ManifestError: package.xml cannot be read.
        OSError: A file cannot be read or written.
    """
    manifest = read_manifest(source / "package.xml")
    plan = Plan(version=manifest.version)
    variables = _variables(source, build, prefix)
    variables["PYTHON_INSTALL_DIR"] = python_folder
    variables["AMENT_PACKAGE_NAME"] = manifest.name
    variables["AMENT_BUILD_DEPENDENCIES"] = ";".join(manifest.build_dependencies)
    for argument in cmake_arguments:
        match = _DEFINITION.match(argument)
        if match is not None:
            variables[match[1]] = match[2]
    path = source / "CMakeLists.txt"
    if not path.is_file():
        raise FileNotFoundError(
            f"there is no {path}, which the build_type ament_cmake in package.xml requires"
        )
    interpreter = Interpreter(
        BASICS | FILES | PROCESSES | TARGETS | AMENT | XACRO,
        plan,
        variables,
        environment,
        PackageLookup(environment),
        strict=frozenset((*OWN_PARTS, *ROS_1)),
    )
    build.mkdir(parents=True, exist_ok=True)
    try:
        interpreter.run_file(path)
        if plan.faults and not plan.compiled:
            raise plan.faults[0]
    except CMakeError as error:
        troubles = plan.missing + plan.unknown
        raise CMakeError(error.place, error.text, troubles) from error
    plan.name = manifest.name
    return plan, interpreter


def _variables(source: Path, build: Path, prefix: Path) -> dict[str, str]:
    variables = {
        "CMAKE_INSTALL_PREFIX": str(prefix),
        "CMAKE_VERSION": "3.28.3",
        "CMAKE_COMMAND": "cmake",
        "CMAKE_BUILD_TYPE": "",
        "CMAKE_SYSTEM_NAME": {"win32": "Windows", "darwin": "Darwin"}.get(sys.platform, "Linux"),
        "CMAKE_INSTALL_BINDIR": "bin",
        "CMAKE_INSTALL_LIBDIR": "lib",
        "CMAKE_INSTALL_INCLUDEDIR": "include",
        "CMAKE_INSTALL_DATADIR": "share",
        "CMAKE_INSTALL_DATAROOTDIR": "share",
        "AMENT_INDEX_BINARY_DIR": str(build / "ament_cmake_index"),
        "BUILD_TESTING": "ON",
        # Packages ask for a standard before they add targets; any will do, as none is compiled.
        "CMAKE_C_COMPILE_FEATURES": ";".join(f"c_std_{year}" for year in _C_STANDARDS),
        "CMAKE_CXX_COMPILE_FEATURES": ";".join(f"cxx_std_{year}" for year in _CXX_STANDARDS),
        "CMAKE_CXX_COMPILER_ID": "GNU",
        "BUILD_SHARED_LIBS": "ON",
    }
    for name in ("PYTHON_EXECUTABLE", "Python3_EXECUTABLE", "Python_EXECUTABLE"):
        variables[name] = sys.executable
    for prefix_ in ("CMAKE", "CMAKE_CURRENT", "PROJECT"):
        variables[f"{prefix_}_SOURCE_DIR"] = str(source)
        variables[f"{prefix_}_BINARY_DIR"] = str(build)
    system = {"win32": "WIN32", "darwin": "APPLE"}.get(sys.platform, "")
    variables |= {"WIN32": "1"} if system == "WIN32" else {"UNIX": "1"}
    return variables | ({system: "1"} if system else {})
