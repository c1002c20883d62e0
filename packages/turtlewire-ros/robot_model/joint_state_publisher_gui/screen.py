"""Serves the page with the sliders.

What goes to a browser, as JSON texts: ``joints`` when there is another description, ``state`` when
positions changed, ``error`` when it sent something that is not a command. What comes back:
:mod:`joint_state_publisher_gui.page_commands`.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

from joint_state_publisher_gui.page_commands import JointCommandError, parse_command
from turtlewire.web import Server
from turtlewire.web.desktop import wanted_port

if TYPE_CHECKING:
    from collections.abc import Callable

    from joint_state_publisher_gui.page_commands import Command
    from joint_state_publisher_gui.sliders import Sliders, Snapshot

__all__ = ["Screen"]

_PAGE = Path(__file__).parent / "page"


class Screen:
    """The page of one node.

    Args:
        node: Fully qualified name of the node.
        sliders: What the page shows.
        on_command: Called on the server's thread for each command; must return at once.
        lan: Whether to serve the devices of the network, too.

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


class _Session:
    """One browser that shows the page."""

    def __init__(self, screen: Screen) -> None:
        self._screen = screen
        self._shown: Snapshot | None = None
        self._errors: list[str] = []

    def outgoing(self) -> list[str | bytes]:
        messages: list[str | bytes] = [
            json.dumps({"type": "error", "text": text}) for text in self._errors
        ]
        self._errors.clear()
        sliders = self._screen._sliders
        with sliders.lock:
            snapshot = sliders.snapshot()
            if self._shown is None or snapshot.version != self._shown.version:
                described = {"type": "joints", "node": self._screen._node}
                messages.append(json.dumps(described | sliders.description()))
        if snapshot != self._shown:
            messages.append(json.dumps({"type": "state"} | snapshot._asdict()))
            self._shown = snapshot
        return messages

    def receive(self, message: str | bytes) -> None:
        try:
            command = parse_command(message)
        except JointCommandError as error:
            self._errors.append(str(error))
            return
        self._screen._obey(command)

    def closed(self) -> None:
        """Nothing is kept for a browser that is gone."""
