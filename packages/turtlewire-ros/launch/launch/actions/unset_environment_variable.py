"""Unsets an environment variable."""

from __future__ import annotations

from collections.abc import MutableMapping
from typing import TYPE_CHECKING

from launch.actions.variable_action import UnsetVariableAction
from launch.frontend.expose import expose_action

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


@expose_action("unset_env")
class UnsetEnvironmentVariable(UnsetVariableAction):
    """Unsets an environment variable for the processes that are started afterwards.

    Args:
        name: Its name.
        **kwargs: See :class:`Action`.
    """

    def variables(self, context: LaunchContext) -> MutableMapping[str, str]:
        """Return the environment of this process, which its children inherit."""
        return context.environment
