"""Turtlesim's picture for the page of the lesson, which draws it as turtlesim's own page does."""

from __future__ import annotations

from turtlesim.picture import FieldPicture, Scene

__all__ = ["LessonScreen"]


class LessonScreen(FieldPicture):
    """Takes what the simulator draws; the page fetches it after each step."""

    def __init__(self) -> None:
        super().__init__(Scene("", (), (0, 0, 0), ()))
        self._seen_version = 0
        self._position = -1

    def close(self) -> None:
        """Nothing is open."""

    @property
    def turtles(self) -> tuple[str, ...]:
        """Names of all turtles."""
        return self.scene.turtles

    def take_scene(self) -> str | None:
        """Return the scene as JSON if it has changed since the last call."""
        self._seen_version, scene = self.scene_since(self._seen_version)
        return scene

    def take_frame(self) -> bytes:
        """Return the newest poses, and the strokes since the last call."""
        self._position, frame = self.frame_since(self._position)
        return frame
