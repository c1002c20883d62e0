"""Robots as URDF describes them: parser, joint model and forward kinematics.

::

    from turtlewire.urdf import Kinematics, load_urdf

    robot = load_urdf("arm.urdf")
    kinematics = Kinematics(robot)
    poses = kinematics.link_poses({"shoulder": [0.0, 0.1], "elbow": 0.5})   # (2, links, 7)

==================  ==============================================================
module              what it holds
==================  ==============================================================
`model`             links, joints and their properties: metres, radians, kilograms
`parser`            `parse_urdf`: urdfdom's rules and error texts
`elements`          XML as a tree of elements with their lines
`bodies`, `joints`  ``link`` and ``material`` elements; ``joint`` elements
`values`            numbers and vectors in attributes
`tree`              checks that links and joints are one tree
`faults`            errors of a URDF
`joint_model`       transforms of joints at given positions, as arrays
`mimic`             joints that follow other joints
`kinematics`        forward kinematics for many joint states at once
`frames_writer`     TFMessages in CDR, with other stamps and poses
`joint_messages`    bytes of a JointState to bytes of a TFMessage
==================  ==============================================================
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from turtlewire.urdf.faults import UrdfError
from turtlewire.urdf.mimic import Follower, followers_of
from turtlewire.urdf.model import Joint, JointLimits, Link, Material, Mesh, Mimic, Pose, Robot
from turtlewire.urdf.parser import load_urdf, parse_urdf

if TYPE_CHECKING:
    from turtlewire.urdf.kinematics import Kinematics as Kinematics

__all__ = [
    "Follower",
    "Joint",
    "JointLimits",
    "Kinematics",
    "Link",
    "Material",
    "Mesh",
    "Mimic",
    "Pose",
    "Robot",
    "UrdfError",
    "followers_of",
    "load_urdf",
    "parse_urdf",
]


def __getattr__(name: str) -> object:
    # NumPy is loaded only where poses are asked for.
    if name != "Kinematics":
        raise AttributeError(f"module 'turtlewire.urdf' has no attribute {name!r}")
    from turtlewire.urdf.kinematics import Kinematics

    globals()[name] = Kinematics
    return Kinematics
