"""Single requests of pages: publish with a tool, save or load a view."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from turtlewire.web.commands import CommandError, is_finite_number
from turtlewire_view.rviz_camera import is_camera
from turtlewire_view.rviz_file import SavedDisplay, SavedView
from turtlewire_view.rviz_writing import write_rviz
from turtlewire_view.tools import tool_message

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from turtlewire_view.page_commands import PublishWithTool, SaveView
    from turtlewire_view.tools import ToolMessage

__all__ = ["message_of_tool", "text_of_view"]

_MOST_DISPLAYS = 100
_SWITCHES = ("names", "axes", "arrows", "grid")


def message_of_tool(
    command: PublishWithTool, fixed: str, origin: Sequence[float], now_ns: int
) -> ToolMessage:
    """Return the message that a command asks for.

    Args:
        command: Its ``position`` is in the page's coordinates: ``fixed``'s less ``origin``.
        fixed: The fixed frame.
        origin: What the server subtracts of all coordinates.
        now_ns: The time now.

    Raises:
        CommandError: The command makes no sense.
    """
    tool, position, yaw, topic = command
    if not all(map(is_finite_number, position)):
        raise CommandError("position must be a list of three finite numbers")
    place = [value + shift for value, shift in zip(position, origin, strict=False)]
    try:
        return tool_message(tool, place, yaw, fixed, now_ns, topic)
    except ValueError as error:
        raise CommandError(str(error)) from error


def text_of_view(
    command: SaveView, types: Mapping[str, str], former: SavedView | None = None
) -> str:
    """Return the ``.rviz`` file that a command asks for.

    Args:
        command: An invalid camera is left out.
        types: Message types by topic.
        former: The view that was loaded before, see :func:`write_rviz`.

    Raises:
        CommandError: The command makes no sense.
    """
    saved = tuple(_display_of(each) for each in command.displays[:_MOST_DISPLAYS])
    if former is None:
        saved = tuple(replace(each, place=None) for each in saved)
    switches = {name: command.show.get(name) is not False for name in _SWITCHES}
    camera: Any = command.camera
    view = SavedView(command.fixed, saved, switches, camera=camera if is_camera(camera) else None)
    return write_rviz(view, types, former)


def _display_of(entry: object) -> SavedDisplay:
    if isinstance(entry, dict):
        kind, topic, options = entry.get("kind"), entry.get("topic"), entry.get("options")
        if isinstance(kind, str) and isinstance(topic, str) and isinstance(options, dict):
            place = entry.get("place")
            place = place if isinstance(place, int) else None
            return SavedDisplay(kind, topic, options, entry.get("visible") is not False, place)
    raise CommandError("a display must have strings 'kind' and 'topic', and an object 'options'")
