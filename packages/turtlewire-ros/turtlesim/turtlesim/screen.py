"""The simulator's screen: a page in any browser of this machine, fed at the simulation's rate.

A browser receives ``scene`` texts (JSON) when turtles, background or hints change, ``tf`` texts a
few times a second while it watches the frames, an ``axes`` text at each tick while it draws them,
and one binary frame for each tick (of a crowd: each second tick) that it keeps up with. A frame is
little-endian: five 32-bit unsigned integers (tick, version of the scene that it belongs to, number
of turtles, number of strokes, 1 if the picture starts empty), five 32-bit floats for each turtle in
the scene's order (x, y, theta, linear and angular velocity), and the strokes as
:mod:`turtlesim.drawing` packs them. What comes back: :mod:`turtlesim.page_commands`.
"""

from __future__ import annotations

import json
import struct
import threading
import time
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from turtlesim.drawing import RECORD_SIZE, Drawing
from turtlesim.looks import shown_pen
from turtlesim.page_commands import TurtleCommandError, Unwatch, Watch, parse_command
from turtlesim.transform_view import field_frames
from turtlewire.web import Server
from turtlewire.web.desktop import wanted_port

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlesim.crowd import CrowdTick
    from turtlesim.model import Stroke, Turtle, TurtleTick
    from turtlesim.page_commands import Command
    from turtlesim.transform_view import TransformView

__all__ = ["Scene", "Screen", "pen_of"]

_HEADER = struct.Struct("<5I")
_PAGE = Path(__file__).parent / "page"
#: With a crowd, a page gets every second tick and interpolates: drawing takes its time.
_CROWD_TICKS = 2
#: Time between two looks at the frames [s].
_FRAMES_PERIOD_S = 0.2


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


class Screen:
    """Serves the page. The simulator's thread calls the methods, the server's thread reads.

    Attributes:
        url: The page's address.
    """

    def __init__(
        self,
        scene: Scene,
        on_command: Callable[[Command], None],
        transforms: TransformView,
        *,
        lan: bool = False,
    ) -> None:
        """Start serving.

        Args:
            scene: What to show first.
            on_command: Called on the server's thread for each command of a page; must return at
                once.
            transforms: The frames; closed with the screen.
            lan: Whether to serve the devices of the network, too.
        """
        self.transforms = transforms
        self._lock = threading.Lock()
        self._scene = scene
        self._version = 0
        self._tick = 0
        self._poses = b""
        self._shown: tuple[str, ...] = ()
        self._drawing = Drawing()
        self._server = Server(
            _PAGE, lambda: _Session(self, on_command), port=wanted_port(), lan=lan
        )
        self.url = self._server.url

    def show(self, ticks: list[TurtleTick]) -> None:
        """Take the results of one tick of the world."""
        with self._lock:
            self._tick += 1
            self._shown = tuple(tick.turtle.name for tick in ticks)
            self._poses = struct.pack(
                f"<{5 * len(ticks)}f", *(value for tick in ticks for value in tick.pose)
            )
            for tick in ticks:
                for stroke in tick.teleport_strokes:
                    self._draw(tick.turtle.name, stroke)
                if tick.move_stroke is not None:
                    self._draw(tick.turtle.name, tick.move_stroke)
        self._server.notify()

    def show_crowd(self, tick: CrowdTick) -> None:
        """Take the results of one tick of a crowd."""
        with self._lock:
            self._tick += 1
            self._shown = tuple([turtle.name for turtle in tick.turtles])
            self._poses = tick.poses.tobytes()
            self._drawing.add_records(tick.stroke_records())
        if self._tick % _CROWD_TICKS == 0:
            self._server.notify()

    def _draw(self, turtle: str, stroke: Stroke) -> None:
        self._drawing.add(turtle, stroke._replace(pen=shown_pen(turtle, stroke.pen)))

    def set_scene(self, scene: Scene) -> None:
        """Show other turtles, another background or other hints from now on."""
        with self._lock:
            if scene != self._scene:
                self._scene = scene
                self._version += 1

    def clear(self) -> None:
        """Wipe the pen's picture."""
        with self._lock:
            self._drawing.clear()

    @property
    def turtles(self) -> tuple[str, ...]:
        """Names of the turtles."""
        return self._scene.turtles

    def close(self) -> None:
        """Stop serving; pages show that the simulator is lost, and reconnect when it returns."""
        self._server.close()
        self.transforms.close()

    def scene_since(self, version: int) -> tuple[int, str | None]:
        """Return the scene as JSON if it changed after ``version``."""
        with self._lock:
            if version == self._version:
                return version, None
            return self._version, json.dumps(
                {"type": "scene", "version": self._version, **self._scene._asdict()}
            )

    def frame_since(self, position: int) -> tuple[int, bytes]:
        """Return the newest poses and the strokes after ``position``."""
        with self._lock:
            restart, strokes, position = self._drawing.since(position)
            # After a spawn or a kill, poses of the last tick do not belong to the new scene yet.
            current = self._shown == self._scene.turtles
            poses = self._poses if current else b""
            header = _HEADER.pack(
                self._tick & 0xFFFFFFFF,
                self._version,
                len(poses) // 20,
                len(strokes) // RECORD_SIZE,
                restart,
            )
        return position, header + poses + strokes


class _Session:
    """One browser that shows the page."""

    def __init__(self, screen: Screen, on_command: Callable[[Command], None]) -> None:
        self._screen = screen
        self._on_command = on_command
        self._version = -1  # older than any scene and stroke, so that the first answer is whole
        self._position = -1
        self._errors: list[str] = []
        self._watch: Watch | None = None
        self._next_look = 0.0
        self._field_frames: tuple[str, list[str]] = ("", [])

    def outgoing(self) -> list[str | bytes]:
        messages: list[str | bytes] = [
            json.dumps({"type": "error", "text": text}) for text in self._errors
        ]
        self._errors.clear()
        self._version, scene = self._screen.scene_since(self._version)
        if scene is not None:
            messages.append(scene)
        if self._watch is not None and time.monotonic() >= self._next_look:
            self._next_look = time.monotonic() + _FRAMES_PERIOD_S
            messages.append(self._look(self._watch))
        if self._watch is not None and self._watch.axes:
            axes = self._screen.transforms.axes(*self._field_frames)
            messages.append(json.dumps({"type": "axes", "frames": axes}))
        self._position, frame = self._screen.frame_since(self._position)
        return [*messages, frame]

    def receive(self, message: str | bytes) -> None:
        try:
            command = parse_command(message)
        except TurtleCommandError as error:
            self._errors.append(str(error))
            return
        if isinstance(command, (Watch, Unwatch)):
            self._set_watch(command if isinstance(command, Watch) else None)
        else:
            self._on_command(command)

    def closed(self) -> None:
        self._set_watch(None)

    def _set_watch(self, watch: Watch | None) -> None:
        if watch is not None and self._watch is None:
            self._screen.transforms.join()
        elif watch is None and self._watch is not None:
            self._screen.transforms.leave()
        self._watch = watch
        self._next_look = 0.0

    def _look(self, watch: Watch) -> str:
        transforms = self._screen.transforms
        relation = (
            transforms.relation(watch.target, watch.source)
            if watch.target and watch.source
            else None
        )
        frames = transforms.frames()
        self._field_frames = field_frames(frames, self._screen.turtles)
        told = {"target": watch.target, "source": watch.source, "relation": relation}
        return json.dumps({"type": "tf", "frames": frames, **told})
