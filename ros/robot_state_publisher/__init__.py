"""robot_state_publisher as in ROS 2: publishes a robot's frames from its URDF and joint states."""

from __future__ import annotations

from robot_state_publisher.node import RobotStatePublisher

__all__ = ["RobotStatePublisher"]
