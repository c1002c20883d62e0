"""robot_state_publisher as in ROS 2: publishes a robot's frames from its URDF and joint states.

=======================  ======================================================
module                   contents
=======================  ======================================================
`robot_state_publisher`  the executable
`node`                   `RobotStatePublisher`: joint states in, transforms out
`description`            robot descriptions, with the log lines of ROS 2
`publish_times`          when each joint was published last
`diagnosis`              log lines that say why transforms are missing
=======================  ======================================================
"""

from robot_state_publisher.node import RobotStatePublisher

__all__ = ["RobotStatePublisher"]
