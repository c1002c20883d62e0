"""The definitions that come with turtlewire, for each distribution of ROS 2.

``interfaces`` holds Jazzy's definitions and all later additions. ``interfaces_since/DISTRO`` holds
the changes of a distribution. Definitions that a distribution does not have are not listed, but can
be loaded, for bags and robots of other distributions.
"""

from __future__ import annotations

import os

from turtlewire.distro import JAZZY, KILTED, LYRICAL, Distro, current_distro

__all__ = ["bundled_folders", "is_listed"]

_HERE = os.path.dirname(__file__)

#: Packages and interfaces that not all distributions have, with those that have them.
_ONLY_IN: dict[str, tuple[Distro, ...]] = {
    "actionlib_msgs": (JAZZY, KILTED),
    "geometry_msgs/msg/Pose2D": (JAZZY, KILTED),
    "turtlesim": (JAZZY,),
    "turtlesim_msgs": (KILTED, LYRICAL),
    "control_msgs/action/FollowJointWrenchTrajectory": (KILTED, LYRICAL),
    "control_msgs/msg/CANopenState": (KILTED, LYRICAL),
    "control_msgs/msg/EtherCATState": (KILTED, LYRICAL),
    "control_msgs/msg/GenericHardwareState": (KILTED, LYRICAL),
    "control_msgs/msg/HardwareDeviceDiagnostics": (KILTED, LYRICAL),
    "control_msgs/msg/HardwareDeviceStatus": (KILTED, LYRICAL),
    "control_msgs/msg/HardwareDiagnostics": (KILTED, LYRICAL),
    "control_msgs/msg/HardwareStatus": (KILTED, LYRICAL),
    "control_msgs/msg/JointCommand": (KILTED, LYRICAL),
    "control_msgs/msg/JointWrenchTrajectory": (KILTED, LYRICAL),
    "control_msgs/msg/JointWrenchTrajectoryPoint": (KILTED, LYRICAL),
    "control_msgs/msg/SteeringControllerCommand": (KILTED, LYRICAL),
    "control_msgs/msg/VDA5050State": (KILTED, LYRICAL),
    "control_msgs/msg/WrenchFramed": (KILTED, LYRICAL),
    "rosbag2_interfaces/msg/MessagesLostEvent": (LYRICAL,),
    "rosbag2_interfaces/msg/MessagesLostEventTopicStat": (LYRICAL,),
    "rosbag2_interfaces/srv/IsDiscoveryRunning": (JAZZY, LYRICAL),
    "rosbag2_interfaces/srv/Record": (JAZZY, LYRICAL),
    "rosbag2_interfaces/srv/StartDiscovery": (JAZZY, LYRICAL),
    "rosbag2_interfaces/srv/StopDiscovery": (JAZZY, LYRICAL),
}


def bundled_folders() -> list[str]:
    """Return the folders of packages to look into, the newest definitions first."""
    current = current_distro()
    changed = [
        os.path.join(_HERE, "interfaces_since", str(distro))
        for distro in sorted(Distro, reverse=True)
        if JAZZY < distro <= current
    ]
    return [*changed, os.path.join(_HERE, "interfaces")]


def is_listed(full_name: str) -> bool:
    """Return whether the process's distribution has a bundled interface, ``"pkg/msg/X"``."""
    package = full_name.partition("/")[0]
    having = _ONLY_IN.get(full_name) or _ONLY_IN.get(package)
    return having is None or current_distro() in having
