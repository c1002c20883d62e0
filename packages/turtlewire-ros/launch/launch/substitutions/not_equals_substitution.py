"""Tests that two texts differ."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.frontend.expose import expose_substitution
from launch.substitutions.equals_substitution import EqualsSubstitution

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


@expose_substitution("not-equals")
class NotEqualsSubstitution(EqualsSubstitution):
    """``true`` if two texts differ, by the rules of :class:`EqualsSubstitution`."""

    def perform(self, context: LaunchContext) -> str:
        """``true`` or ``false``."""
        return "false" if self._equal(context) else "true"
