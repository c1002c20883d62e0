"""Finds the packages that a CMakeLists.txt may request."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from pathlib import Path

from turtlewire.package_sources import source_hint
from turtlewire.terminal.suggestion import did_you_mean
from turtlewire_ros.prefix import MARKERS, editable_source, own_prefix

__all__ = ["CONFIG_MARK", "PackageLookup"]

#: First line of the files in which installed packages list their CMake extras.
CONFIG_MARK = "# written by turtlewire"

#: Build tools, and what only C++ needs: without a compiled target, nothing depends on them.
_BUILD_ONLY = re.compile(
    r"ament_\w+|rosidl_\w+|rmw(_\w+)?|rcl(_\w+)?|rclcpp(_\w+)?|rcutils|rcpputils|python3?"
    r"|python(interp|libs|_cmake_module)|pybind11(_vendor)?|launch_testing_ament_cmake"
    r"|ros_testing|tf2|tf2_(eigen|kdl|bullet)(_\w+)?|pluginlib|class_loader|image_transport"
    r"|cv_bridge|image_geometry|laser_geometry|pcl(_\w+)?|kdl_parser|orocos_kdl(_vendor)?"
    r"|urdf(dom(_headers)?|_parser_plugin)?|eigen3(_cmake_module)?|boost|opencv|threads|openmp"
    r"|gtest|gmock|benchmark|pkgconfig|git|doxygen|zlib|fmt|spdlog(_vendor)?|yaml-cpp"
    r"|yaml_cpp_vendor|tinyxml2?(_vendor)?|console_bridge(_vendor)?|cuda(toolkit)?|qt[56]"
    r"|osrf_testing_tools_cpp|mimick_vendor|performance_test_fixture|backward_ros|tracetools"
    r"|rviz_\w+|rosbag2_(cpp|storage|transport)|hardware_interface|controller_interface"
    r"|ros_environment|message_filters|angles|bondcpp|xacro",
    re.IGNORECASE,
)


class PackageLookup:
    """Finds packages in the prefixes of an environment.

    Args:
        environment: ``AMENT_PREFIX_PATH`` of it is read.
    """

    def __init__(self, environment: Mapping[str, str]) -> None:
        paths = environment.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
        self._prefixes = [path for path in (*paths, own_prefix() or "") if path]

    def is_installed(self, name: str) -> bool:
        """Return True if a package is in one of the prefixes, or was installed by pip."""
        return (
            any(os.path.isfile(os.path.join(prefix, MARKERS, name)) for prefix in self._prefixes)
            or editable_source(name) is not None
        )

    def is_known(self, name: str) -> bool:
        """Return True if ``find_package`` finds a package.

        Build tools, and packages that only C++ needs, count as found: none of them installs or
        generates anything here.
        """
        return _BUILD_ONLY.fullmatch(name) is not None or self.is_installed(name)

    def advice(self, name: str) -> str:
        """Say what to do about a package that is missing, and which similar ones are installed."""
        if hint := source_hint(name):
            return f"; {hint}"
        folders = [os.path.join(prefix, MARKERS) for prefix in self._prefixes]
        known = {each for folder in folders if os.path.isdir(folder) for each in os.listdir(folder)}
        near = did_you_mean(name, sorted(known))
        return (
            f"{f' ({near})' if near else ''}; add it to the workspace, source a workspace that has "
            "it, or install it"
        )

    def config(self, name: str) -> Path | None:
        """Return the file with the CMake extras of a package that turtlewire has built, or None."""
        for prefix in self._prefixes:
            path = Path(prefix) / "share" / name / "cmake" / f"{name}Config.cmake"
            if path.is_file():
                text = path.read_text(encoding="utf-8", errors="replace")
                return path if text.startswith(CONFIG_MARK) else None
        return None

    def has_ament_cmake(self) -> bool:
        """Return True if there is a real ament_cmake, with which CMake can build packages."""
        return any(
            (Path(prefix) / "share/ament_cmake/cmake/ament_cmakeConfig.cmake").is_file()
            for prefix in self._prefixes
        )
