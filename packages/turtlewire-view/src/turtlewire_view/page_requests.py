"""What pages ask for once: publish with a tool, save a view, load one."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from turtlewire_view.rviz_camera import is_camera
from turtlewire_view.rviz_file import SavedDisplay, SavedView
from turtlewire_view.rviz_writing import write_rviz
from turtlewire_view.tools import tool_message

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from turtlewire_view.tools import ToolMessage

__all__ = ["RequestError", "message_of_tool", "text_of_view"]

_MOST_DISPLAYS = 100
_SWITCHES = ("names", "axes", "arrows", "grid")


class RequestError(ValueError):
    """A request that makes no sense; the text says why."""


def message_of_tool(
    command: Mapping[str, Any], fixed: str, origin: Sequence[float], now_ns: int
) -> ToolMessage:
    """Return the message that a ``publish`` command asks for.

    Args:
        command: Its ``position`` is in the page's coordinates: ``fixed``'s less ``origin``.
        fixed: The fixed frame.
        origin: What the server subtracts of all coordinates.
        now_ns: The time now.

    Raises:
        RequestError: The command makes no sense.
    """
    tool, topic = command.get("tool"), command.get("topic") or ""
    position, yaw = command.get("position"), command.get("yaw", 0.0)
    if not isinstance(tool, str) or not isinstance(topic, str):
        raise RequestError("'tool' and 'topic' must be texts")
    if not isinstance(position, list) or not all(map(_is_number, [*position, yaw])):
        raise RequestError("'position' must be a list of three numbers, and 'yaw' a number")
    place = [value + shift for value, shift in zip(position, origin, strict=False)]
    try:
        return tool_message(tool, place, yaw, fixed, now_ns, topic)
    except ValueError as error:
        raise RequestError(str(error)) from error


def text_of_view(
    command: Mapping[str, Any], types: Mapping[str, str], former: SavedView | None = None
) -> str:
    """Return the ``.rviz`` file that a ``save`` command asks for.

    Args:
        command: ``fixed``, ``displays``, ``show`` and ``camera`` as in the ``view`` packet; an
            invalid camera is left out.
        types: Message types by topic.
        former: The view that was loaded before, see :func:`write_rviz`.

    Raises:
        RequestError: The command makes no sense.
    """
    displays, show, fixed = command.get("displays"), command.get("show"), command.get("fixed")
    if not isinstance(displays, list) or not isinstance(show, dict) or not isinstance(fixed, str):
        raise RequestError("'fixed' must be a string, 'displays' a list and 'show' an object")
    saved = tuple(_display_of(each) for each in displays[:_MOST_DISPLAYS])
    if former is None:
        saved = tuple(replace(each, place=None) for each in saved)
    switches = {name: show.get(name) is not False for name in _SWITCHES}
    camera = command.get("camera")
    view = SavedView(fixed, saved, switches, camera=camera if is_camera(camera) else None)
    return write_rviz(view, types, former)


def _display_of(entry: object) -> SavedDisplay:
    if isinstance(entry, dict):
        kind, topic, options = entry.get("kind"), entry.get("topic"), entry.get("options")
        if isinstance(kind, str) and isinstance(topic, str) and isinstance(options, dict):
            place = entry.get("place")
            place = place if isinstance(place, int) else None
            return SavedDisplay(kind, topic, options, entry.get("visible") is not False, place)
    raise RequestError("a display must have the texts 'kind' and 'topic', and an object 'options'")


def _is_number(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)
