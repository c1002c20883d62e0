"""Fixtures and helpers of the tests of launch_ros."""

import pytest

from launch import LaunchContext


@pytest.fixture
def context():
    """A context for substitutions that need no running launch."""
    return LaunchContext()
