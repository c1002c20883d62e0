"""Which packages a CMakeLists.txt may ask for."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import TYPE_CHECKING

from turtlewire_ros.prefix import MARKERS, editable_source, own_prefix

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["CONFIG_MARK", "PackageLookup"]

#: First line of the files with which installed packages hand their CMake extras on.
CONFIG_MARK = "# written by turtlewire"

#: Build tools, and what only C++ needs: without a compiled target, nothing depends on them.
_BUILD_ONLY = re.compile(
    r"(ament|rosidl|rcl|rmw|rcpputils|rcutils|tf2|launch_testing|pluginlib|class_loader|nodelet"
    r"|image_transport|cv_bridge|pcl|urdf|kdl|orocos|eigen|boost|opencv|python|pybind11|threads"
    r"|openmp|vulkan|qt|gtest|gmock|benchmark|gazebo|gz|ignition|yaml|tinyxml|fmt|spdlog|cuda"
    r"|pkgconfig|doxygen|git|zlib|osrf|backward|rviz|message_filters|diagnostic_updater"
    r"|hardware_interface|controller_interface|rosbag2|angles|bond|fast|cyclone|console_bridge"
    r"|performance_test|mimick|tracetools|libstatistics|ros_environment|test_msgs_support)",
    re.IGNORECASE,
)
_NOT_BUILD_ONLY = re.compile(r"_(msgs|interfaces|srvs|actions|description|bringup|common)$")


class PackageLookup:
    """Finds packages in the prefixes of an environment.

    Args:
        environment: ``AMENT_PREFIX_PATH`` of it is read.
    """

    def __init__(self, environment: Mapping[str, str]) -> None:
        paths = environment.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
        self._prefixes = [path for path in (*paths, own_prefix() or "") if path]

    def is_installed(self, name: str) -> bool:
        """Whether a package is in one of the prefixes, or was installed by pip."""
        return (
            any(os.path.isfile(os.path.join(prefix, MARKERS, name)) for prefix in self._prefixes)
            or editable_source(name) is not None
        )

    def is_known(self, name: str) -> bool:
        """Whether ``find_package`` finds a package.

        Build tools, and packages that only C++ needs, count as found.
        """
        build_only = _BUILD_ONLY.match(name) and not _NOT_BUILD_ONLY.search(name)
        return bool(build_only) or self.is_installed(name)

    def config(self, name: str) -> Path | None:
        """The file with the CMake extras of a package that turtlewire has built, or None."""
        for prefix in self._prefixes:
            path = Path(prefix) / "share" / name / "cmake" / f"{name}Config.cmake"
            if path.is_file():
                text = path.read_text(encoding="utf-8", errors="replace")
                return path if text.startswith(CONFIG_MARK) else None
        return None

    def has_ament_cmake(self) -> bool:
        """Whether there is a real ament_cmake, with which CMake can build packages."""
        return any(
            (Path(prefix) / "share/ament_cmake/cmake/ament_cmakeConfig.cmake").is_file()
            for prefix in self._prefixes
        )
