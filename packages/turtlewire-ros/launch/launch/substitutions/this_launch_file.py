"""The path of the launch file that is being read."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.substitutions.substitution_failure import SubstitutionFailure

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


@expose_substitution("filename")
class ThisLaunchFile(Substitution):
    """The path of the launch file that is being read."""

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[ThisLaunchFile], dict[str, Any]]:
        """Read ``$(filename)``."""
        if data:
            raise TypeError("filename substitution expects no arguments")
        return cls, {}

    def describe(self) -> str:
        return "ThisLaunchFile()"

    def perform(self, context: LaunchContext) -> str:
        """Return the path.

        Raises:
            SubstitutionFailure: No launch file is being read, only a script.
        """
        path: str | None = context.get_locals_as_dict().get("current_launch_file_path")
        if path is None:
            raise SubstitutionFailure("ThisLaunchFile used outside of a launch file (in a script)")
        return path
