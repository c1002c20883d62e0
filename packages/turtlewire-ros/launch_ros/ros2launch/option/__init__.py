"""Options that other packages add to ``ros2 launch``: entry points in ``ros2launch.option``."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from ros2cli.plugin_system import (
    PLUGIN_SYSTEM_VERSION,
    named_extensions,
    satisfies_version,
)

if TYPE_CHECKING:
    from launch import LaunchDescription

__all__ = ["OptionExtension", "get_option_extensions"]


class OptionExtension:
    """Base of options."""

    NAME: str | None = None
    EXTENSION_POINT_VERSION = "0.1"

    def __init__(self) -> None:
        satisfies_version(PLUGIN_SYSTEM_VERSION, f"^{self.EXTENSION_POINT_VERSION}")

    def add_arguments(
        self, parser: argparse.ArgumentParser, cli_name: str, *, argv: list[str] | None = None
    ) -> None:
        """Define the options.

        Args:
            parser: Parser of ``ros2 launch``.
            cli_name: The words before.
            argv: The words of the command line.
        """

    def prestart(self, args: Any) -> None:
        """Called before the launch file is read."""

    def prelaunch(
        self, launch_description: LaunchDescription, args: Any
    ) -> tuple[LaunchDescription, ...] | None:
        """Called before the launch: a tuple whose first item is launched; None changes nothing."""

    def postlaunch(self, launch_return_code: int, args: Any) -> None:
        """Called after the launch with its exit status."""


def get_option_extensions(exclude_names: Iterable[str] | None = None) -> dict[str, Any]:
    """Return the instances of the options of other packages by name."""
    return named_extensions("ros2launch.option", exclude_names)
