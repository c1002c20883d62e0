"""The folder of the launch file that is being read."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from launch.frontend.expose import expose_substitution
from launch.substitutions.path_join_substitution import PathSubstitution
from launch.substitutions.substitution_failure import SubstitutionFailure

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


@expose_substitution("dirname")
class ThisLaunchFileDir(PathSubstitution):
    """The folder of the launch file that is being read; ``/`` extends it."""

    def __init__(self) -> None:
        super().__init__(self)

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[ThisLaunchFileDir], dict[str, Any]]:
        """Read ``$(dirname)``."""
        if data:
            raise TypeError("dirname substitution expects no arguments")
        return cls, {}

    def describe(self) -> str:
        return "ThisLaunchFileDir()"

    def perform(self, context: LaunchContext) -> str:
        """Return the path.

        Raises:
            SubstitutionFailure: No launch file is being read, only a script.
        """
        path: str | None = context.get_locals_as_dict().get("current_launch_file_directory")
        if path is None:
            raise SubstitutionFailure(
                "ThisLaunchFileDir used outside of a launch file (in a script)"
            )
        return path
