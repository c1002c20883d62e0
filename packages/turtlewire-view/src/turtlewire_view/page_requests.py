"""Single requests of pages: publish with a tool, save or load a view."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

from turtlewire import msg
from turtlewire.web.commands import CommandError, is_finite_number
from turtlewire_view.rviz_file import SavedDisplay, SavedView, is_camera
from turtlewire_view.rviz_writing import write_rviz

if TYPE_CHECKING:
    from turtlewire_view.page_commands import PublishWithTool, SaveView

__all__ = ["TOOLS", "ToolMessage", "message_of_tool", "text_of_view", "tool_message"]

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


#: Tool to the topic and the type that RViz publishes with it.
TOOLS = {
    "point": ("/clicked_point", "geometry_msgs/msg/PointStamped"),
    "pose_estimate": ("/initialpose", "geometry_msgs/msg/PoseWithCovarianceStamped"),
    "goal": ("/goal_pose", "geometry_msgs/msg/PoseStamped"),
}
#: RViz's standard deviations of a 2D pose estimate [m, rad].
_DEVIATION_XY, _DEVIATION_YAW = 0.5, math.pi / 12


class ToolMessage(NamedTuple):
    """The message that a tool publishes."""

    topic: str
    type_name: str
    cdr: bytes


def tool_message(
    tool: str, position: Sequence[float], yaw: float, frame_id: str, stamp_ns: int, topic: str = ""
) -> ToolMessage:
    """Return the message of a tool.

    Args:
        tool: ``point``, ``pose_estimate`` or ``goal``.
        position: x, y, z in ``frame_id`` [m].
        yaw: Direction about z [rad]; a point has none.
        frame_id: The fixed frame.
        stamp_ns: The time now.
        topic: Where to; RViz's topic if empty.

    Raises:
        ValueError: The tool does not exist, or a number is not finite.
    """
    if tool not in TOOLS:
        raise ValueError(f"there is no tool '{tool}'; choose from {', '.join(TOOLS)}")
    if len(position) != 3 or not all(map(math.isfinite, (*position, yaw))):
        raise ValueError("a tool needs a position of three finite numbers and a finite yaw")
    if not frame_id:
        raise ValueError("no position can be published, because there is no fixed frame yet")
    own_topic, type_name = TOOLS[tool]
    message: Any = msg.get_message(type_name)()
    message.header.frame_id = frame_id
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp_ns, 10**9)
    x, y, z = (float(value) for value in position)
    if tool == "point":
        _set_point(message.point, x, y, z)
    else:
        pose = message.pose.pose if tool == "pose_estimate" else message.pose
        _set_point(pose.position, x, y, 0.0)
        pose.orientation.z, pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    if tool == "pose_estimate":
        covariance = [0.0] * 36
        covariance[0] = covariance[7] = _DEVIATION_XY**2
        covariance[35] = _DEVIATION_YAW**2
        message.pose.covariance = covariance
    return ToolMessage(topic or own_topic, type_name, msg.serialize(message))


def _set_point(point: Any, x: float, y: float, z: float) -> None:
    point.x, point.y, point.z = x, y, z
