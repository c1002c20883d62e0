"""Actions of launch descriptions for tests."""

from launch_testing.actions.ready import ReadyToTest as _ReadyToTest


class ReadyToTest(_ReadyToTest):
    """Lets the tests begin as soon as it is visited."""
