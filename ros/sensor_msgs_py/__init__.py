"""Helpers for sensor messages in Python, as ROS 2's package of this name."""
