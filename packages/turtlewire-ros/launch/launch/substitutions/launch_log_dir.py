"""The folder of the launch's log files."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from launch import logging
from launch.frontend.expose import expose_substitution
from launch.substitutions.path_join_substitution import PathSubstitution

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


@expose_substitution("launch_log_dir")
@expose_substitution("log_dir")
class LaunchLogDir(PathSubstitution):
    """The folder of the launch's log files; ``/`` extends it."""

    def __init__(self) -> None:
        super().__init__(self)

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[LaunchLogDir], dict[str, Any]]:
        """Read ``$(launch_log_dir)``."""
        if data:
            raise TypeError("launch_log_dir substitution expects no arguments")
        return cls, {}

    def describe(self) -> str:
        return "LaunchLogDir()"

    def perform(self, context: LaunchContext) -> str:
        """Return the folder."""
        del context
        return logging.launch_config.log_dir
