"""Puts the exercises into a wheel; an editable installation finds them in the sources."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

_LESSON = Path(__file__).resolve().parent.parent / "site" / "lesson"


class ExercisesHook(BuildHookInterface[Any]):
    """Adds what lies elsewhere in the sources."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Add the lessons' and exercises' files; ``version`` is ``standard`` or ``editable``."""
        if version == "standard":
            build_data["force_include"] = {
                str(_LESSON / "python" / "turtle_lesson"): "turtle_lesson",
                str(_LESSON / "lessons"): "turtle_class/lessons",
                str(Path(self.root) / "exercises"): "turtle_class/exercises",
            }
