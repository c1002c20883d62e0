"""The folder of the launch's log files."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch import logging
from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution

if TYPE_CHECKING:
    from collections.abc import Sequence

    from launch.launch_context import LaunchContext

__all__ = ["LaunchLogDir"]


@expose_substitution("launch_log_dir")
@expose_substitution("log_dir")
class LaunchLogDir(Substitution):
    """The folder of the launch's log files."""

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[LaunchLogDir], dict[str, Any]]:
        """Read ``$(launch_log_dir)``."""
        if data:
            raise TypeError("launch_log_dir substitution expects no arguments")
        return cls, {}

    def describe(self) -> str:
        """Name it."""
        return "LaunchLogDir()"

    def perform(self, context: LaunchContext) -> str:
        """Return the folder."""
        del context
        return logging.launch_config.log_dir
