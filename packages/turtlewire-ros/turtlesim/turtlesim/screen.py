"""The simulator's screen: a page in any browser of this machine, updated at the simulation's rate.

A browser gets scenes and frames (:mod:`turtlesim.picture`); of a crowd, at most every second frame.
It gets ``tf`` messages a few times a second while it shows the frames, and an ``axes`` message at
each tick while it draws them.
"""

from __future__ import annotations

import json
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from turtlesim.page_commands import READER, Unwatch, Watch
from turtlesim.picture import FieldPicture
from turtlesim.transform_view import field_frames
from turtlewire.web import CommandSession, Server
from turtlewire.web.desktop import wanted_port

if TYPE_CHECKING:
    from turtlesim.crowd import CrowdTick
    from turtlesim.model import TurtleTick
    from turtlesim.page_commands import Command
    from turtlesim.picture import Scene
    from turtlesim.transform_view import TransformView

_PAGE = Path(__file__).parent / "page"
#: With a crowd, a page gets every second tick and interpolates: drawing takes its time.
_CROWD_TICKS = 2
#: Time between two looks at the frames [s].
_FRAMES_PERIOD_S = 0.2


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
            lan: Whether to serve the devices of the network as well.
        """
        self.transforms = transforms
        self._lock = threading.Lock()
        self._picture = FieldPicture(scene)
        self._server = Server(
            _PAGE, lambda: _Session(self, on_command), port=wanted_port(), lan=lan
        )
        self.url = self._server.url

    def show(self, ticks: list[TurtleTick]) -> None:
        """Take the results of one tick of the world."""
        with self._lock:
            self._picture.show(ticks)
        self._server.notify()

    def show_crowd(self, tick: CrowdTick) -> None:
        """Take the results of one tick of a crowd."""
        with self._lock:
            self._picture.show_crowd(tick)
        if self._picture.tick % _CROWD_TICKS == 0:
            self._server.notify()

    def set_scene(self, scene: Scene) -> None:
        """Show other turtles, another background or other hints from now on."""
        with self._lock:
            self._picture.set_scene(scene)

    def clear(self) -> None:
        """Wipe the pen's drawing."""
        with self._lock:
            self._picture.clear()

    @property
    def turtles(self) -> tuple[str, ...]:
        """Names of the turtles."""
        return self._picture.scene.turtles

    def close(self) -> None:
        """Stop serving; pages show that the simulator is lost, and reconnect when it returns."""
        self._server.close()
        self.transforms.close()

    def scene_since(self, version: int) -> tuple[int, str | None]:
        """Return the scene as JSON if it changed after ``version``."""
        with self._lock:
            return self._picture.scene_since(version)

    def frame_since(self, position: int) -> tuple[int, bytes]:
        """Return the newest poses and the strokes after ``position``."""
        with self._lock:
            return self._picture.frame_since(position)


class _Session(CommandSession):
    """A browser that shows the page."""

    def __init__(self, screen: Screen, on_command: Callable[[Command], None]) -> None:
        super().__init__(READER)
        self._screen = screen
        self._on_command = on_command
        self._version = -1  # older than any scene and stroke, so that the first answer is whole
        self._position = -1
        self._watch: Watch | None = None
        self._next_look = 0.0
        self._field_frames: tuple[str, list[str]] = ("", [])

    def news(self) -> list[str | bytes]:
        messages: list[str | bytes] = []
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

    def obey(self, command: Command) -> None:
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
