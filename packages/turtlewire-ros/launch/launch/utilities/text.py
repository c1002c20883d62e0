"""Plain text as a substitution; import it as ``launch.substitutions.TextSubstitution``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.substitution import Substitution

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class TextSubstitution(Substitution):
    """Plain text.

    Args:
        text: The text.
    """

    # ROS 2's module, which descriptions show. The class is defined here because `launch.utilities`
    # converts text to substitutions, and all other substitutions import that package.
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
