"""Runs launches of ROS nodes with their tests."""

from launch_testing.test_runner import LaunchTestRunner as _LaunchTestRunner


class LaunchTestRunner(_LaunchTestRunner):
    """Runs launches of ROS nodes with their tests; nothing more is needed for nodes."""
