"""Plain text."""

from launch.substitution import TextSubstitution

__all__ = ["TextSubstitution"]
