"""ROS 2's transform system for Python, without a ROS installation."""
