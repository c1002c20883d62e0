"""Settings for all nodes of a scope: namespace, parameters, remappings.

They are stored as launch configurations, so that a ``GroupAction`` limits their scope.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


def global_parameters(context: LaunchContext) -> list[Any]:
    """``(name, value)`` pairs and paths of parameter files, in the order of their setting."""
    return list(cast("list[Any]", context.launch_configurations.get("global_params", [])))


def add_global_parameter(context: LaunchContext, entry: Any) -> None:
    """Set a parameter, or a file of parameters, for the nodes that follow."""
    entries: Any = [*global_parameters(context), entry]
    context.launch_configurations["global_params"] = entries


def remaps(context: LaunchContext) -> list[tuple[str, str]]:
    """``(from, to)`` pairs, in the order in which they were set."""
    return list(cast("list[tuple[str, str]]", context.launch_configurations.get("ros_remaps", [])))


def add_remap(context: LaunchContext, source: str, target: str) -> None:
    """Remap a name for the nodes that follow."""
    pairs: Any = [*remaps(context), (source, target)]
    context.launch_configurations["ros_remaps"] = pairs
