"""Text that is known only when the launch runs: the base, and plain text."""

from __future__ import annotations

from collections.abc import Iterable
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


def described(substitutions: Iterable[Substitution]) -> str:
    """Return the descriptions of substitutions that give one text."""
    return " + ".join(part.describe() for part in substitutions)


class TextSubstitution(Substitution):
    """Plain text.

    Args:
        text: The text.
    """

    # ROS 2's module, which descriptions show. The class is defined here because `launch.utilities`,
    # which all other substitutions import, converts text to substitutions.
    __module__ = "launch.substitutions.text_substitution"

    def __init__(self, *, text: str) -> None:
        if not isinstance(text, str):
            raise TypeError(f"TextSubstitution expected Text object got '{type(text)}' instead.")
        self._text = text

    @property
    def text(self) -> str:
        """The text."""
        return self._text

    def describe(self) -> str:
        """Return the text in quotes."""
        return f"'{self._text}'"

    def perform(self, context: LaunchContext) -> str:
        """Return the text."""
        del context
        return self._text
