"""Serves the page with the sliders.

A browser gets ``joints`` when the description changes, and ``state`` when positions change.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from joint_state_publisher_gui.page_commands import READER
from turtlewire.web import CommandSession, Server
from turtlewire.web.desktop import wanted_port

if TYPE_CHECKING:
    from joint_state_publisher_gui.page_commands import Command
    from joint_state_publisher_gui.sliders import Sliders, Snapshot

_PAGE = Path(__file__).parent / "page"


class SliderScreen:
    """The page of one node.

    Args:
        node: Fully qualified name of the node.
        sliders: What the page shows.
        on_command: Called on the server's thread for each command; must return at once.
        lan: Whether to serve the devices of the network as well.

    Attributes:
        url: The page's address.
    """

    def __init__(
        self,
        node: str,
        sliders: Sliders,
        on_command: Callable[[Command], None],
        *,
        lan: bool = False,
    ) -> None:
        self._node = node
        self._sliders = sliders
        self._on_command = on_command
        self._server = Server(_PAGE, lambda: _Session(self), port=wanted_port(), lan=lan)
        self.url = self._server.url

    def update(self) -> None:
        """Send to all browsers what they do not have yet. For any thread; returns at once."""
        self._server.notify()

    def close(self) -> None:
        """Stop serving."""
        self._server.close()

    def _obey(self, command: Command) -> None:
        self._on_command(command)
        self._server.notify()


class _Session(CommandSession):
    """A browser that shows the page."""

    def __init__(self, screen: SliderScreen) -> None:
        super().__init__(READER)
        self._screen = screen
        self._shown: Snapshot | None = None

    def news(self) -> list[str | bytes]:
        messages: list[str | bytes] = []
        sliders = self._screen._sliders
        # Held for both, so that the description is that of the snapshot's version.
        with sliders.lock:
            snapshot = sliders.snapshot()
            if self._shown is None or snapshot.version != self._shown.version:
                described = {"type": "joints", "node": self._screen._node}
                messages.append(json.dumps(described | sliders.description()))
        if snapshot != self._shown:
            messages.append(json.dumps({"type": "state"} | snapshot._asdict()))
            self._shown = snapshot
        return messages

    def obey(self, command: Command) -> None:
        self._screen._obey(command)
