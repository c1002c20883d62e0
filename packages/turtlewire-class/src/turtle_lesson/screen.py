"""Turtlesim's picture for the page: the frames and scenes that its own page understands."""

from __future__ import annotations

import json
import struct
from typing import TYPE_CHECKING

from turtlesim.drawing import RECORD_SIZE, Drawing
from turtlesim.looks import shown_pen

if TYPE_CHECKING:
    from turtlesim.crowd import CrowdTick
    from turtlesim.model import Stroke, TurtleTick
    from turtlesim.screen import Scene

__all__ = ["LessonScreen"]

_HEADER = struct.Struct("<5I")


class LessonScreen:
    """Takes what the simulator draws; the page fetches it after each step.

    The bytes are those that :mod:`turtlesim.screen` describes.
    """

    def __init__(self) -> None:
        self._scene: Scene | None = None
        self._shown_scene: Scene | None = None
        self._version = 0
        self._tick = 0
        self._names: tuple[str, ...] = ()
        self._poses = b""
        self._drawing = Drawing()
        self._position = -1

    def show(self, ticks: list[TurtleTick]) -> None:
        """Take the results of one tick."""
        self._tick += 1
        self._names = tuple(tick.turtle.name for tick in ticks)
        self._poses = struct.pack(
            f"<{5 * len(ticks)}f", *(value for tick in ticks for value in tick.pose)
        )
        for tick in ticks:
            for stroke in tick.teleport_strokes:
                self._draw(tick.turtle.name, stroke)
            if tick.move_stroke is not None:
                self._draw(tick.turtle.name, tick.move_stroke)

    def _draw(self, turtle: str, stroke: Stroke) -> None:
        self._drawing.add(turtle, stroke._replace(pen=shown_pen(turtle, stroke.pen)))

    def show_crowd(self, tick: CrowdTick) -> None:
        """Take the results of one tick of many turtles."""
        self._tick += 1
        self._names = tuple(turtle.name for turtle in tick.turtles)
        self._poses = tick.poses.tobytes()
        self._drawing.add_records(tick.stroke_records())

    def set_scene(self, scene: Scene) -> None:
        """Show other turtles or another background from now on."""
        if scene != self._scene:
            self._scene = scene
            self._version += 1

    def clear(self) -> None:
        """Wipe the drawing."""
        self._drawing.clear()

    def close(self) -> None:
        """Nothing is open."""

    @property
    def turtles(self) -> tuple[str, ...]:
        """Names of all turtles."""
        return self._names

    def take_scene(self) -> str | None:
        """Return the scene as JSON if it has changed since the last call."""
        if self._scene is None or self._scene == self._shown_scene:
            return None
        self._shown_scene = self._scene
        return json.dumps({"type": "scene", "version": self._version, **self._scene._asdict()})

    def take_frame(self) -> bytes:
        """Return the newest poses, and the strokes since the last call."""
        restart, strokes, self._position = self._drawing.since(self._position)
        current = self._scene is not None and self._names == self._scene.turtles
        poses = self._poses if current else b""
        header = _HEADER.pack(
            self._tick, self._version, len(poses) // 20, len(strokes) // RECORD_SIZE, restart
        )
        return header + poses + strokes
