"""Feedback of a page on an interactive marker, as a message for the marker's server."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from turtlewire import msg
from turtlewire.geometry.conversions import matrix_from_pose, pose_from_matrix
from turtlewire.web.commands import CommandError, is_finite_number
from turtlewire_view.page_requests import ToolMessage

if TYPE_CHECKING:
    from turtlewire_view.display_feed import DisplayFeed
    from turtlewire_view.displays.content import Content
    from turtlewire_view.frames import Base
    from turtlewire_view.page_commands import GiveFeedback

__all__ = ["feedback_message"]

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


def _put(target: Any, names: str, values: list[float]) -> None:
    for name, value in zip(names, values, strict=True):
        setattr(target, name, value)
