"""Sets a launch configuration."""

from __future__ import annotations

from collections.abc import MutableMapping
from typing import TYPE_CHECKING

from launch.actions.variable_action import SetVariableAction
from launch.frontend.expose import expose_action

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


@expose_action("let")
class SetLaunchConfiguration(SetVariableAction):
    """Sets a launch configuration.

    Args:
        name: Its name.
        value: Its value.
        **kwargs: See :class:`Action`.
    """

    def variables(self, context: LaunchContext) -> MutableMapping[str, str]:
        """Return the launch configurations."""
        return context.launch_configurations
