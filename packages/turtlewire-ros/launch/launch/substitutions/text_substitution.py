"""Plain text."""

from __future__ import annotations

from launch.utilities.text import TextSubstitution

__all__ = ["TextSubstitution"]
