"""The five topics of an action in a bag: feedback, status, and the events of three services."""

from __future__ import annotations

import re
from typing import NamedTuple

#: Parts of an action in the order of ``ros2 bag info``.
ACTION_PARTS = ("feedback", "status", "send_goal", "cancel_goal", "get_result")

_NAME = re.compile(
    r"(.+)/_action/(?:(feedback|status)|(send_goal|cancel_goal|get_result)/_service_event)"
)
_TYPE_ENDINGS = {
    "feedback": "_FeedbackMessage",
    "send_goal": "_SendGoal_Event",
    "get_result": "_GetResult_Event",
}
_COMMON_TYPES = {
    "status": "action_msgs/msg/GoalStatusArray",
    "cancel_goal": "action_msgs/srv/CancelGoal_Event",
}


class ActionTopic(NamedTuple):
    """An action and the part of it that a topic carries.

    Attributes:
        action: Name of the action.
        part: One of `ACTION_PARTS`.
        type: Type of the action; empty for parts that all actions have in common.
    """

    action: str
    part: str
    type: str


def action_topic(topic: str, type_name: str) -> ActionTopic | None:
    """Return the action of a topic and its part; None for other topics."""
    found = _NAME.fullmatch(topic)
    if found is None:
        return None
    part = found[2] or found[3]
    if part in _COMMON_TYPES:
        return ActionTopic(found[1], part, "") if type_name == _COMMON_TYPES[part] else None
    ending = _TYPE_ENDINGS[part]
    if not type_name.endswith(ending):
        return None
    return ActionTopic(found[1], part, type_name.removesuffix(ending))
