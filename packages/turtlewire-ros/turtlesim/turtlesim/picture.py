"""The data that the page draws: the turtles, and new lines of the pens.

A page gets a ``scene`` when turtles, background or hints change, and a ``frame`` for each tick. A
frame's arrays are ``poses``, five floats for each turtle in the scene's order (x, y, theta, linear
and angular velocity), and ``strokes`` as :mod:`turtlesim.drawing` packs them. ``version`` is
the scene of the frame; with ``restart`` the page clears its drawing first.
"""

from __future__ import annotations

import json
import struct
from typing import TYPE_CHECKING, NamedTuple

from turtlesim.drawing import StrokeHistory, shown_pen
from turtlewire.web.packets import encode_packet

if TYPE_CHECKING:
    from turtlesim.crowd import CrowdTick
    from turtlesim.model import Stroke, Turtle, TurtleTick


class Scene(NamedTuple):
    """The part of the picture that changes rarely.

    Attributes:
        node: Fully qualified name of the simulator's node.
        turtles: Names in the order in which frames list their poses.
        background: Red, green and blue, 0..255.
        missing: Turtles that are referenced but were never spawned.
        pens: As :func:`pen_of` gives them, in the order of the turtles.
        speed: Simulated seconds in a second; 0 in a pause.
    """

    node: str
    turtles: tuple[str, ...]
    background: tuple[int, int, int]
    missing: tuple[str, ...]
    pens: tuple[tuple[str, int, bool], ...] = ()
    speed: float = 1.0


def pen_of(turtle: Turtle) -> tuple[str, int, bool]:
    """Colour (as in CSS), width [pixels of the 500 x 500 image] and whether the pen draws."""
    r, g, b, width = shown_pen(turtle.name, turtle.pen)
    return f"#{r:02x}{g:02x}{b:02x}", width, turtle.pen_on


class FieldPicture:
    """The newest tick, the scene and the drawing. Not thread-safe.

    Attributes:
        scene: What changes rarely.
        tick: Number of the newest tick.
    """

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.tick = 0
        self._version = 0
        self._shown: tuple[str, ...] = ()
        self._poses = b""
        self._drawing = StrokeHistory()

    def show(self, ticks: list[TurtleTick]) -> None:
        """Take the results of one tick of the world."""
        self.tick += 1
        self._shown = tuple(tick.turtle.name for tick in ticks)
        self._poses = struct.pack(
            f"<{5 * len(ticks)}f", *(value for tick in ticks for value in tick.pose)
        )
        for tick in ticks:
            for stroke in tick.teleport_strokes:
                self._draw(tick.turtle.name, stroke)
            if tick.move_stroke is not None:
                self._draw(tick.turtle.name, tick.move_stroke)

    def show_crowd(self, tick: CrowdTick) -> None:
        """Take the results of one tick of a crowd."""
        self.tick += 1
        self._shown = tuple([turtle.name for turtle in tick.turtles])
        self._poses = tick.poses.tobytes()
        self._drawing.add_records(tick.stroke_records())

    def _draw(self, turtle: str, stroke: Stroke) -> None:
        self._drawing.add(turtle, stroke._replace(pen=shown_pen(turtle, stroke.pen)))

    def set_scene(self, scene: Scene) -> None:
        """Show other turtles, another background or other hints from now on."""
        if scene != self.scene:
            self.scene = scene
            self._version += 1

    def clear(self) -> None:
        """Wipe the pen's drawing."""
        self._drawing.clear()

    def scene_since(self, version: int) -> tuple[int, str | None]:
        """Return the scene as JSON if it changed after ``version``."""
        if version == self._version:
            return version, None
        return self._version, json.dumps(
            {"type": "scene", "version": self._version, **self.scene._asdict()}
        )

    def frame_since(self, position: int) -> tuple[int, bytes]:
        """Return the newest poses and the strokes after ``position``."""
        restart, strokes, position = self._drawing.since(position)
        # After a spawn or a kill, poses of the last tick do not belong to the new scene yet.
        poses = self._poses if self._shown == self.scene.turtles else b""
        header = {"type": "frame", "tick": self.tick, "version": self._version, "restart": restart}
        arrays = {"poses": memoryview(poses).cast("f"), "strokes": memoryview(strokes).cast("I")}
        return position, encode_packet(header, arrays)
