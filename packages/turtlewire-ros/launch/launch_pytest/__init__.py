"""Tests of launched processes as functions of pytest.

===============  ==============================================================
module           contents
===============  ==============================================================
`fixture`        the decorator of fixtures that return a launch description
`plugin`         runs such launches, and the tests marked ``launch``
`wrapped_tests`  tests that run while the loop of their launch runs
`actions`        ``ReadyToTest``
`tools`          waits for starts, ends and output of processes
===============  ==============================================================
"""

from launch_pytest import actions, tools
from launch_pytest.fixture import fixture

__all__ = ["actions", "fixture", "tools"]
