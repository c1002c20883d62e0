"""Makes ``colcon build`` and ``colcon test`` support ament_cmake packages without CMake.

colcon-ros hands every ``ament_cmake`` package to CMake, which needs ament_cmake. Most such packages
of Python users hold Python, launch files, robot descriptions and interfaces. Here they get a
package type whose tasks read their CMakeLists.txt with `turtlewire_colcon.cmake`. Targets that
compile C++ are left out with a warning; the rest of such a package is installed. Where a real
ament_cmake is installed, packages with C++ stay with colcon-ros.
"""

from __future__ import annotations

import json
import os
import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from catkin_pkg.package import InvalidPackage, parse_package
from colcon_core.environment import create_environment_hooks, create_environment_scripts
from colcon_core.event.test import TestFailure
from colcon_core.logging import colcon_logger
from colcon_core.package_identification import PackageIdentificationExtensionPoint
from colcon_core.python_install_path import get_python_install_path
from colcon_core.shell import create_environment_hook, get_command_environment
from colcon_core.task import TaskExtensionPoint, run
from colcon_ros.package_identification.ros import RosPackageIdentification

from turtlewire_colcon.cmake.evaluate import evaluate_package
from turtlewire_colcon.cmake.syntax import CMakeError
from turtlewire_colcon.package_lookup import PackageLookup
from turtlewire_colcon.plan_install import PlanInstaller, build_commands
from turtlewire_ros.manifest import ManifestError, manifest_fault

if TYPE_CHECKING:
    from colcon_core.package_descriptor import PackageDescriptor

    from turtlewire_colcon.cmake.plan import Plan

__all__ = [
    "AmentPackageBuild",
    "AmentPackageIdentification",
    "AmentPackageTest",
    "UnreadablePackageBuild",
]

_TYPE = "ros.turtlewire_ament"  # "ros." makes colcon-ros read the dependencies in package.xml
_UNREADABLE_TYPE = "turtlewire.unreadable"
_COMPILES = re.compile(
    r"^\s*(?:add_executable|pybind11_add_module|rclcpp_components_register_nodes?"
    r"|add_library)\s*\((?!\s*\S+\s+(?:INTERFACE|ALIAS|IMPORTED)\b)",
    re.MULTILINE | re.IGNORECASE,
)
_AMENT_CMAKE = re.compile(r"<build_type>\s*ament_cmake\s*</build_type>")
#: The tests that the last build found, in the build folder.
_TESTS = "turtlewire_tests.json"


class AmentPackageIdentification(PackageIdentificationExtensionPoint):
    """Recognizes ament_cmake packages, and packages whose package.xml is broken."""

    PRIORITY = RosPackageIdentification.PRIORITY + 10

    def __init__(self) -> None:
        super().__init__()
        self._ros = RosPackageIdentification()

    def identify(self, desc: PackageDescriptor) -> None:
        """Set name and type of such a package."""
        cmake, manifest = desc.path / "CMakeLists.txt", desc.path / "package.xml"
        if not manifest.is_file():
            return
        fault = manifest_fault(manifest) or _content_fault(manifest)
        if fault is not None:
            colcon_logger.error(fault)
            desc.name, desc.type = desc.path.name, _UNREADABLE_TYPE
            return
        if not cmake.is_file():
            if not _AMENT_CMAKE.search(manifest.read_text(encoding="utf-8", errors="replace")):
                return
        elif _is_for_cmake(cmake):
            return
        self._ros.identify(desc)
        if desc.type == "ros.ament_cmake":
            desc.type = _TYPE


def _content_fault(manifest: Path) -> str | None:
    """Return catkin_pkg's error about a package.xml on one line; None if it is valid.

    colcon-ros says nothing of it, and leaves the package to CMake or to setuptools.
    """
    if "<package" not in manifest.read_text(encoding="utf-8", errors="replace"):
        return None  # a file of this name that is not ROS's
    try:
        parse_package(manifest, warnings=[])
    except (AssertionError, InvalidPackage) as error:
        lines = [line for line in str(error).splitlines() if not line.startswith("Error(s) in")]
        return f"{manifest}: {'; '.join(lines)}"
    return None


def _is_for_cmake(path: Path) -> bool:
    """Return True if a CMakeLists.txt compiles C++, and there is an ament_cmake to do it."""
    text = path.read_text(encoding="utf-8", errors="replace")
    return bool(_COMPILES.search(text)) and PackageLookup(os.environ).has_ament_cmake()


class UnreadablePackageBuild(TaskExtensionPoint):
    """Fails for a package whose package.xml cannot be read.

    colcon-ros would build it as a plain Python package, which ROS does not find.
    """

    async def build(self) -> int:
        """Return the exit status; the fault was logged when the package was found."""
        return 1


class AmentPackageBuild(TaskExtensionPoint):
    """Installs what the CMakeLists.txt of a package names, and generates its interfaces."""

    async def build(self) -> int:
        """Build the package of the context; returns the exit status."""
        args = self.context.args
        try:
            environment = await get_command_environment(
                "build", args.build_base, self.context.dependencies
            )
            return await self._build(environment)
        except (CMakeError, ManifestError, OSError, RuntimeError) as error:
            colcon_logger.error(f"{self.context.pkg.name}: {error}")
            return 1

    async def _build(self, environment: dict[str, str]) -> int:
        args, name = self.context.args, self.context.pkg.name
        source, build, prefix = (
            Path(path) for path in (args.path, args.build_base, args.install_base)
        )
        base = {"base": str(prefix), "platbase": str(prefix)}
        modules = Path(get_python_install_path("purelib", base))
        plan, interpreter = evaluate_package(
            source,
            build,
            prefix,
            modules.relative_to(prefix).as_posix(),
            environment,
            [*(getattr(args, "cmake_args", None) or ()),
             *(getattr(args, "ament_cmake_args", None) or ())],
        )  # fmt: skip
        errors, warnings = plan.verdict()
        for line in warnings:
            colcon_logger.warning(f"{name}: {line}")
        for line in errors:
            colcon_logger.error(f"{name}: {line}")
        if errors:
            return 1
        for command in build_commands(plan, build, modules):
            done = await run(self.context, command.words, cwd=command.folder, env=environment)
            if done.returncode and command.may_fail:
                colcon_logger.warning(f"{name}: {' '.join(command.words)} failed")
            elif done.returncode:
                return int(done.returncode)
        installer = PlanInstaller(
            plan, interpreter, source, prefix, modules, symlink=bool(args.symlink_install)
        )
        hooks = installer.install()
        for line in installer.warnings:
            colcon_logger.warning(f"{name}: {line}")
        _write_tests(plan, build)
        _create_environment(self.context, hooks)
        return 0


class AmentPackageTest(TaskExtensionPoint):
    """Runs the tests that a package's CMakeLists.txt adds."""

    async def test(self) -> int:
        """Test the package of the context; returns the exit status."""
        args = self.context.args
        path = Path(args.build_base) / _TESTS
        try:
            tests = json.loads(path.read_text(encoding="utf-8"))
            environment = dict(
                await get_command_environment("test", args.build_base, self.context.dependencies)
            )
        except FileNotFoundError:
            colcon_logger.error(f"{self.context.pkg.name}: build it first, with colcon build")
            return 1
        except RuntimeError as error:
            colcon_logger.error(str(error))
            return 1
        generated = Path(args.build_base) / "rosidl_generator_py"
        if generated.is_dir():
            paths = (str(generated), environment.get("PYTHONPATH", ""))
            environment["PYTHONPATH"] = os.pathsep.join(filter(None, paths))
        failed = False
        for test in tests:
            done = await run(
                self.context,
                self._command(test),
                cwd=args.build_base,
                env=environment | {"PYTHONDONTWRITEBYTECODE": "1"} | test["environment"],
            )
            failed = failed or bool(done.returncode)
        if failed:
            self.context.put_event_into_queue(TestFailure(self.context.pkg.name))
        return 0

    def _command(self, test: dict[str, Any]) -> list[str]:
        args, name = self.context.args, self.context.pkg.name
        folder = Path(args.test_result_base or args.build_base) / "test_results" / name
        command = [
            sys.executable, "-m", "turtlewire_colcon.run_test",
            "--kind", test["kind"],
            "--name", f"{name}.{test['name']}",
            "--result", str(folder / f"{test['name']}.xunit.xml"),
            "--folder", test["folder"],
            "--timeout", str(test["timeout"]),
            *(["--isolated"] if test["isolated"] else []),
            "--", *test["words"],
        ]  # fmt: skip
        extra = getattr(args, "pytest_args", None) or []
        return command + extra if test["kind"] == "pytest" else command


def _write_tests(plan: Plan, build: Path) -> None:
    text = json.dumps([test._asdict() for test in plan.tests], indent=1)
    (build / _TESTS).write_text(text, encoding="utf-8")


def _create_environment(context: Any, additional_hooks: list[str]) -> None:
    """Write the package's part of the workspace's setup files."""
    name, prefix = context.pkg.name, Path(context.args.install_base)
    hooks = create_environment_hooks(prefix, name)
    hooks += create_environment_hook(
        "ament_prefix_path", prefix, name, "AMENT_PREFIX_PATH", "", mode="prepend"
    )
    create_environment_scripts(
        context.pkg, context.args, default_hooks=hooks, additional_hooks=additional_hooks
    )
