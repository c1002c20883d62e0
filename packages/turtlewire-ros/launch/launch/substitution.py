"""Text that is known only when the launch runs."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class Substitution:
    """Base of all substitutions."""

    def describe(self) -> str:
        """Return the text that ``ros2 launch --print`` shows."""
        return self.__repr__()

    def perform(self, context: LaunchContext) -> str:
        """Return the text, in the given context.

        Raises:
            SubstitutionFailure: The substitution has no value in this context.
        """
        raise NotImplementedError(f"{type(self).__name__} does not define perform()")
