"""The definitions that come with turtlewire, for each distribution of ROS 2.

``interfaces/PACKAGE.txt`` holds the definitions of a package: Jazzy's and all later additions, each
below a line such as ``=== geometry_msgs/msg/Twist``. ``interfaces_since/DISTRO.txt`` holds what a
distribution changed. Definitions that a distribution does not have are not listed, but can be
loaded, for bags and robots of other distributions.
"""

from __future__ import annotations

import functools
import os
import re

from turtlewire.distro import JAZZY, KILTED, LYRICAL, Distro, current_distro

_HERE = os.path.dirname(__file__)
_FOLDER = os.path.join(_HERE, "interfaces")
_HEADING = re.compile(r"^=== (\S+)\n", re.MULTILINE)

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


def bundled_packages() -> list[str]:
    """Return the names of the packages with definitions, sorted."""
    return sorted(file.removesuffix(".txt") for file in os.listdir(_FOLDER))


def bundled_interfaces(package: str) -> dict[str, list[str]]:
    """Return the names of a bundled package's interfaces by kind, also those not listed."""
    found: dict[str, list[str]] = {"msg": [], "srv": [], "action": []}
    for full_name in bundled_definitions(os.path.join(_FOLDER, f"{package}.txt")):
        _, kind, name = full_name.split("/")
        found[kind].append(name)
    return found


def bundled_file(full_name: str) -> str | None:
    """Return the file that defines ``"pkg/msg/X"`` in the process's distribution, or None."""
    current = current_distro()
    changes = [
        os.path.join(_HERE, "interfaces_since", f"{distro}.txt")
        for distro in sorted(Distro, reverse=True)
        if JAZZY < distro <= current
    ]
    package = full_name.partition("/")[0]
    if package not in _known_packages():
        return None
    for file in (*changes, os.path.join(_FOLDER, f"{package}.txt")):
        if full_name in bundled_definitions(file):
            return file
    return None


@functools.cache
def _known_packages() -> frozenset[str]:
    return frozenset(bundled_packages())


@functools.cache
def bundled_definitions(file: str) -> dict[str, str]:
    """Return the definitions in one of our files, by full name; none if there is no such file."""
    try:
        with open(file, encoding="utf-8") as opened:
            _, *parts = _HEADING.split(opened.read())
    except FileNotFoundError:
        return {}
    return dict(zip(parts[::2], parts[1::2], strict=True))


def is_listed(full_name: str) -> bool:
    """Return whether the process's distribution has a bundled interface, ``"pkg/msg/X"``."""
    package = full_name.partition("/")[0]
    having = _ONLY_IN.get(full_name) or _ONLY_IN.get(package)
    return having is None or current_distro() in having
