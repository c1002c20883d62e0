"""A menu that 3D views show on interactive markers."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from visualization_msgs.msg import InteractiveMarkerFeedback, MenuEntry

if TYPE_CHECKING:
    from interactive_markers.interactive_marker_server import Callback, InteractiveMarkerServer

__all__ = ["MenuHandler"]

#: The parent of the entries on the menu's first level.
_TOP = 0


@dataclass
class _Entry:
    title: str
    parent: int
    command_type: int
    command: str
    callback: Callback | None
    is_visible: bool = True
    check_state: int = 0


class MenuHandler:
    """A menu of one or more interactive markers, with a callback for each entry.

    Views see a change after `apply` or `reApply`, and the server's ``applyChanges``.
    """

    NO_CHECKBOX = 0
    CHECKED = 1
    UNCHECKED = 2

    _BOXES = ("", "[x] ", "[ ] ")

    def __init__(self) -> None:
        self._entries: dict[int, _Entry] = {}
        self._markers: set[str] = set()

    def insert(
        self,
        title: str,
        parent: int | None = None,
        command_type: int = MenuEntry.FEEDBACK,
        command: str = "",
        callback: Callback | None = None,
    ) -> int | None:
        """Append an entry; returns its handle, or None if there is no such parent.

        Args:
            title: What the view shows.
            parent: Handle of the entry whose submenu this one is in; by default, the first level.
            command_type: What the view does: send feedback, or run a command.
            command: The command that the view runs.
            callback: Called with the feedback when a user selects the entry.
        """
        if parent is not None and parent not in self._entries:
            return None
        handle = len(self._entries) + 1
        self._entries[handle] = _Entry(title, parent or _TOP, command_type, command, callback)
        return handle

    def setVisible(self, handle: int, visible: bool) -> bool:  # noqa: N802  ROS 2's name
        """Show or hide an entry with its submenu; returns False for an unknown handle."""
        entry = self._entries.get(handle)
        if entry is None:
            return False
        entry.is_visible = visible
        return True

    def setCheckState(self, handle: int, check_state: int) -> bool:  # noqa: N802  ROS 2's name
        """Give an entry a check box, or none; returns False for an unknown handle."""
        entry = self._entries.get(handle)
        if entry is None:
            return False
        entry.check_state = check_state
        return True

    def getCheckState(self, handle: int) -> int | None:  # noqa: N802  ROS 2's name
        """Return ``NO_CHECKBOX``, ``CHECKED`` or ``UNCHECKED``; None for an unknown handle."""
        entry = self._entries.get(handle)
        return None if entry is None else entry.check_state

    def getTitle(self, handle: int) -> str | None:  # noqa: N802  ROS 2's name
        """Return the title of an entry, without its check box; None for an unknown handle."""
        entry = self._entries.get(handle)
        return None if entry is None else entry.title

    def apply(self, server: InteractiveMarkerServer, marker_name: str) -> bool:
        """Put the menu on a marker; returns False if the server does not have the marker."""
        marker = server.get(marker_name)
        if marker is None:
            self._markers.discard(marker_name)
            return False
        marker.menu_entries = list(self._menu(_TOP))
        server.insert(
            marker,
            feedback_callback=self.processFeedback,
            feedback_type=InteractiveMarkerFeedback.MENU_SELECT,
        )
        self._markers.add(marker_name)
        return True

    def reApply(self, server: InteractiveMarkerServer) -> bool:  # noqa: N802  ROS 2's name
        """Put the menu on all its markers again; returns False if one is gone."""
        applied = [self.apply(server, name) for name in sorted(self._markers)]
        return all(applied)

    def processFeedback(self, feedback: InteractiveMarkerFeedback) -> None:  # noqa: N802  ROS 2's name
        """Call the callback of the entry that a user selected."""
        entry = self._entries.get(feedback.menu_entry_id)
        if entry is not None and entry.callback is not None:
            entry.callback(feedback)

    def _menu(self, parent: int) -> Iterator[MenuEntry]:
        """Yield the entries below one, each before its submenu."""
        for handle, entry in self._entries.items():
            if entry.parent == parent and entry.is_visible:
                yield MenuEntry(
                    id=handle,
                    parent_id=parent,
                    title=self._BOXES[entry.check_state] + entry.title,
                    command=entry.command,
                    command_type=entry.command_type,
                )
                yield from self._menu(handle)
