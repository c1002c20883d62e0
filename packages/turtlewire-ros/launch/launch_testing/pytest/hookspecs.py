"""The hook by which plugins choose how a launch test is collected."""

from turtlewire_ros.pytest_hookspecs import pytest_launch_collect_makemodule

__all__ = ["pytest_launch_collect_makemodule"]
