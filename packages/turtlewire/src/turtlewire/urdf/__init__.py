"""Robots as URDF describes them: parser, joint model and forward kinematics.

::

    from turtlewire.urdf import Robot

    robot = Robot.load("arm.urdf")
    poses = robot.link_poses({"shoulder": [0.0, 0.1], "elbow": 0.5})   # (2, links, 7)

==================  ==============================================================
module              contents
==================  ==============================================================
`robot`             `Robot`: a description with forward kinematics
`model`             links, joints and their properties: metres, radians, kilograms
`parser`            urdfdom's rules and error texts; the tree of links and joints
`elements`          XML as a tree of elements with their lines; the versions of URDF
`bodies`, `joints`  ``link``, ``material`` and ``joint`` elements; joints that follow
`values`            numbers and vectors in attributes
`faults`            log lines about errors and warnings of a URDF
`joint_model`       transforms of joints at given positions, as arrays
`kinematics`        forward kinematics for many joint states at once, as poses or a buffer
`notebook`          the display of robots in Jupyter
`joint_messages`    bytes of a JointState to bytes of a TFMessage
==================  ==============================================================
"""

from turtlewire.errors import UrdfError
from turtlewire.urdf.model import Joint, JointLimits, Link, Material, Mesh, Mimic, Pose
from turtlewire.urdf.robot import Robot

__all__ = [
    "Joint",
    "JointLimits",
    "Link",
    "Material",
    "Mesh",
    "Mimic",
    "Pose",
    "Robot",
    "UrdfError",
]
