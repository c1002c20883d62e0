"""Plain text."""

from launch.utilities.text import TextSubstitution

__all__ = ["TextSubstitution"]
