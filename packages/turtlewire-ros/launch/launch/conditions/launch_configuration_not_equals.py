"""True when a launch configuration has another value."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.conditions.launch_configuration_equals import LaunchConfigurationEquals

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class LaunchConfigurationNotEquals(LaunchConfigurationEquals):
    """True when a launch configuration has another value. Deprecated in ROS 2."""

    def _predicate_func(self, context: LaunchContext) -> bool:
        return not super()._predicate_func(context)
