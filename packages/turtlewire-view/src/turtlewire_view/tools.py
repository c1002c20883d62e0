"""The messages of the page's tools, with RViz's topics, types and covariance."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

from turtlewire import msg

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["TOOLS", "ToolMessage", "tool_message"]

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
