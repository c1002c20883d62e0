"""Single requests of pages: publish with a tool, give feedback on a marker, save a view."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from turtlewire import msg
from turtlewire.geometry.conversions import matrix_from_pose, pose_from_matrix
from turtlewire.web.commands import CommandError, is_finite_number
from turtlewire_view.rviz_file import SavedDisplay, SavedView, is_camera
from turtlewire_view.rviz_writing import write_rviz

if TYPE_CHECKING:
    from turtlewire_view.display_feed import DisplayFeed
    from turtlewire_view.displays.content import Content
    from turtlewire_view.frames import Base
    from turtlewire_view.page_commands import GiveFeedback, PublishWithTool, SaveView

__all__ = [
    "TOOLS",
    "ToolMessage",
    "feedback_message",
    "message_of_tool",
    "text_of_view",
]

_MOST_DISPLAYS = 100
_SWITCHES = ("names", "axes", "arrows", "grid")


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
        CommandError: The tool does not exist, or a number is not finite.
    """
    tool, position, yaw, topic = command
    if not all(map(is_finite_number, position)):
        raise CommandError("position must be a list of three finite numbers")
    if tool not in TOOLS:
        raise CommandError(f"there is no tool '{tool}'; choose from {', '.join(TOOLS)}")
    place = [float(value + shift) for value, shift in zip(position, origin, strict=False)]
    if len(position) != 3 or not all(map(math.isfinite, (*place, yaw))):
        raise CommandError("a tool needs a position of three finite numbers and a finite yaw")
    if not fixed:
        raise CommandError("no position can be published, because there is no fixed frame yet")
    own_topic, type_name = TOOLS[tool]
    message: Any = msg.get_message(type_name)()
    message.header.frame_id = fixed
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(now_ns, 10**9)
    if tool == "point":
        _put(message.point, "xyz", place)
    else:
        pose = message.pose.pose if tool == "pose_estimate" else message.pose
        _put(pose.position, "xyz", (*place[:2], 0.0))
        pose.orientation.z, pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    if tool == "pose_estimate":
        covariance = [0.0] * 36
        covariance[0] = covariance[7] = _DEVIATION_XY**2
        covariance[35] = _DEVIATION_YAW**2
        message.pose.covariance = covariance
    return ToolMessage(topic or own_topic, type_name, msg.serialize(message))


_LAST_EVENT = 5
_LAST_ENTRY = 2**32 - 1


def feedback_message(
    command: GiveFeedback, feed: DisplayFeed, base: Base, now_ns: int
) -> ToolMessage:
    """Return the message that a command asks for.

    As in RViz, a marker without a stamp gives its pose in its own frame, and a marker with a stamp
    in the fixed frame, now.

    Args:
        command: Its pose and mouse point are in the marker's frame.
        feed: The display of the marker.
        base: The fixed frame, and the transforms.
        now_ns: The time now.

    Raises:
        CommandError: The marker does not exist, or a number is not finite.
        TransformException: The marker's frame is not connected to the fixed frame.
    """
    sends, content = feed.display.sends, feed.display.marker(command.marker)
    if sends is None or content is None:
        raise CommandError(f"There is no interactive marker {command.marker!r}.")
    assert content.frame_id is not None
    pose, point = _numbers("pose", command.pose, 7), command.mouse_point
    at = None if point is None else _numbers("mouse_point", point, 3)
    if not 0 <= command.event <= _LAST_EVENT or not 0 <= command.menu_entry <= _LAST_ENTRY:
        raise CommandError("event must be from 0 to 5, and menu_entry a number of 32 bits")
    topic, type_name = sends
    message: Any = msg.get_message(type_name)()
    message.header.frame_id = content.frame_id
    if content.stamp_ns:
        message.header.frame_id = base.fixed
        pose, at = _in_fixed_frame(content, base, pose, at)
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(now_ns, 10**9)
    message.client_id = f"turtlewire_view/{feed.name}"
    message.marker_name, message.control_name = command.marker, command.control
    message.event_type, message.menu_entry_id = int(command.event), int(command.menu_entry)
    _put(message.pose.position, "xyz", pose[:3])
    _put(message.pose.orientation, "xyzw", pose[3:])
    if at is not None:
        message.mouse_point_valid = True
        _put(message.mouse_point, "xyz", at)
    return ToolMessage(topic, type_name, msg.serialize(message))


def _in_fixed_frame(
    content: Content, base: Base, pose: list[float], at: list[float] | None
) -> tuple[list[float], list[float] | None]:
    assert content.frame_id is not None
    fixed_from_frame = base.buffer.lookup_transform(
        base.fixed, content.frame_id, content.stamp_ns
    ).as_matrix()
    there = pose_from_matrix(fixed_from_frame @ matrix_from_pose(pose)).tolist()
    if at is None:
        return there, None
    return there, (fixed_from_frame @ np.array([*at, 1.0]))[:3].tolist()


def _numbers(name: str, values: list[Any], count: int) -> list[float]:
    if len(values) != count or not all(map(is_finite_number, values)):
        raise CommandError(f"{name} must be a list of {count} finite numbers")
    return [float(value) for value in values]


def _put(target: Any, names: str, values: Sequence[float]) -> None:
    for name, value in zip(names, values, strict=True):
        setattr(target, name, value)
