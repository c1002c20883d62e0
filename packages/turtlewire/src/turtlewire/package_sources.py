"""The repositories of well-known packages that do not come with turtlewire.

They contain only interfaces or Python code, so they build in seconds in a workspace. Errors about
such a missing package name the repository to clone. Other packages are in turtlewire-extras, or
need a ROS 2.
"""

from __future__ import annotations

import functools
import shlex
import sys
from collections.abc import Callable
from types import TracebackType
from typing import Any

#: Repositories, each with its branch for Jazzy and the packages in it that work without a compiler.
_REPOSITORIES = (
    ("ANYbotics/grid_map", "jazzy", "grid_map_msgs"),
    (
        "autowarefoundation/autoware_msgs",
        "main",
        (
            "autoware_common_msgs autoware_control_msgs autoware_localization_msgs "
            "autoware_map_msgs autoware_perception_msgs autoware_planning_msgs "
            "autoware_sensing_msgs autoware_system_msgs autoware_v2x_msgs autoware_vehicle_msgs"
        ),
    ),
    ("christianrauch/apriltag_msgs", "master", "apriltag_msgs"),
    ("gazebosim/ros_gz", "jazzy", "ros_gz_interfaces"),
    ("IMRCLab/crazyswarm2", "main", "crazyflie_interfaces"),
    ("IntelRealSense/realsense-ros", "ros2-master", "realsense2_camera_msgs"),
    ("iRobotEducation/irobot_create_msgs", "jazzy", "irobot_create_msgs"),
    ("KumarRobotics/ublox", "ros2", "ublox_msgs"),
    ("mavlink/mavros", "ros2", "mavros_msgs"),
    ("mgonzs13/yolo_ros", "main", "yolo_msgs"),
    ("micro-ROS/micro_ros_msgs", "jazzy", "micro_ros_msgs"),
    ("moveit/moveit_msgs", "ros2", "moveit_msgs"),
    ("OctoMap/octomap_msgs", "ros2", "octomap_msgs"),
    ("open-rmf/rmf_building_map_msgs", "jazzy", "rmf_building_map_msgs"),
    (
        "open-rmf/rmf_internal_msgs",
        "jazzy",
        (
            "rmf_charger_msgs rmf_dispenser_msgs rmf_door_msgs rmf_fleet_msgs rmf_ingestor_msgs "
            "rmf_lift_msgs rmf_obstacle_msgs rmf_scheduler_msgs rmf_site_map_msgs rmf_task_msgs "
            "rmf_traffic_msgs rmf_workcell_msgs"
        ),
    ),
    ("open-rmf/rmf_visualization_msgs", "jazzy", "rmf_visualization_msgs"),
    ("PickNikRobotics/graph_msgs", "ros2", "graph_msgs"),
    ("PX4/px4_msgs", "main", "px4_msgs"),
    ("ROBOTIS-GIT/turtlebot3_msgs", "jazzy", "turtlebot3_msgs"),
    ("RobotWebTools/rosbridge_suite", "ros2", "rosapi_msgs rosbridge_msgs rosbridge_test_msgs"),
    (
        "ros-controls/ros2_control",
        "jazzy",
        "controller_manager controller_manager_msgs ros2controlcli",
    ),
    ("ros-drivers/ackermann_msgs", "ros2", "ackermann_msgs"),
    ("ros-drivers/audio_common", "ros2", "audio_common_msgs"),
    ("ros-drivers/nmea_msgs", "ros2", "nmea_msgs"),
    ("ros-drivers/velodyne", "ros2", "velodyne_msgs"),
    ("ros-industrial/ros_canopen", "dashing-devel", "can_msgs"),
    ("ros-navigation/navigation2", "jazzy", "dwb_msgs nav2_msgs nav2_simple_commander nav_2d_msgs"),
    ("ros-perception/pcl_msgs", "ros2", "pcl_msgs"),
    ("ros-perception/radar_msgs", "ros2", "radar_msgs"),
    ("ros-simulation/gazebo_ros_pkgs", "ros2", "gazebo_msgs"),
    ("ros-simulation/simulation_interfaces", "main", "simulation_interfaces"),
    ("ros/bond_core", "ros2", "bond"),
    ("ros2/cartographer_ros", "ros2", "cartographer_ros_msgs"),
    ("ros2/demos", "jazzy", "pendulum_msgs"),
    ("ros2/rcl_interfaces", "jazzy", "test_msgs"),
    ("SteveMacenski/slam_toolbox", "jazzy", "slam_toolbox"),
    ("swri-robotics/gps_umd", "ros2-devel", "gps_msgs"),
    (
        "swri-robotics/marti_messages",
        "ros2-devel",
        (
            "marti_can_msgs marti_common_msgs marti_dbw_msgs marti_introspection_msgs "
            "marti_nav_msgs marti_perception_msgs marti_sensor_msgs marti_status_msgs "
            "marti_visualization_msgs"
        ),
    ),
    ("turtlebot/turtlebot4", "jazzy", "turtlebot4_msgs"),
    ("unitreerobotics/unitree_ros2", "master", "unitree_api unitree_go unitree_hg"),
    ("wg-perception/object_recognition_msgs", "ros2", "object_recognition_msgs"),
)

_SOURCES = {
    package: (repository, branch)
    for repository, branch, packages in _REPOSITORIES
    for package in packages.split()
}


_NOT_HERE = (
    "{} does not come with turtlewire. Run the programs that need it on a computer with ROS 2: its "
    "nodes and yours discover each other"
)
_EXTRAS = {
    "cv_bridge",
    "demo_nodes_cpp",
    "diagnostic_updater",
    "interactive_markers",
    "urdf_launch",
}
#: Packages that need C++ or a simulator, by name and by the beginning of their names.
_ELSEWHERE = {
    "angles",
    "image_geometry",
    "laser_geometry",
    "tf2_kdl",
    "tf2_eigen",
    "turtlebot3_gazebo",
    "urdf_parser_py",
}
_ELSEWHERE_FROM = ("gazebo_", "moveit_", "nav2_", "ros_gz")


def pip_install() -> str:
    """Return the command, to be typed in a shell, that installs into this Python."""
    python = sys.executable if sys.platform == "win32" else shlex.quote(sys.executable)
    return f"{python} -m pip install"


def source_hint(name: str) -> str:
    """Say how to get a package that is missing; empty if unknown.

    Args:
        name: Name of the package, or of something in it: ``nav2_msgs``, ``nav2_msgs.action``,
            ``nav2_msgs/action/Spin``.
    """
    package = name.partition("/")[0].partition(".")[0]
    if package in _EXTRAS:
        return (
            f"{package} comes with turtlewire-extras. In the folder of turtlewire's sources, type: "
            f"{pip_install()} ./packages/turtlewire-extras"
        )
    if package not in _SOURCES:
        is_elsewhere = package in _ELSEWHERE or package.startswith(_ELSEWHERE_FROM)
        return _NOT_HERE.format(package) if is_elsewhere else ""
    repository, branch = _SOURCES[package]
    return (
        f"{package} does not come with turtlewire. In the folder src of your workspace, type: "
        f"git clone -b {branch} https://github.com/{repository}; then, in the workspace: "
        f"colcon build --packages-up-to {package} && source install/setup.bash"
    )


@functools.cache
def explain_missing_modules() -> None:
    """Let tracebacks of missing modules end with `source_hint`. Only the first call matters."""
    sys.excepthook = functools.partial(_show, sys.excepthook)


def _show(
    show_traceback: Callable[[type[BaseException], BaseException, TracebackType | None], Any],
    kind: type[BaseException],
    value: BaseException,
    traceback: TracebackType | None,
) -> None:
    show_traceback(kind, value, traceback)
    hint = source_hint(value.name or "") if isinstance(value, ModuleNotFoundError) else ""
    if hint and sys.stderr is not None:
        sys.stderr.write(f"{hint}\n")
