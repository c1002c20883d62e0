"""Shows the arguments of a launch description."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.utilities.command_line import describe_arguments

if TYPE_CHECKING:
    from launch import LaunchDescription


def print_arguments_of_launch_description(*, launch_description: LaunchDescription) -> None:
    """Print names, descriptions and defaults of the arguments."""
    print(describe_arguments(launch_description.get_launch_arguments()))
