"""Chooses the topics of the graph that are recorded; knows the topics of actions and services.

An action has five topics in a bag: feedback, status, and the events of three services.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, NamedTuple

from turtlewire.distro import KILTED, since
from turtlewire.wire.names import is_hidden

if TYPE_CHECKING:
    from rosbag2_transport.options import RecordOptions

__all__ = [
    "ACTION_PARTS",
    "EVENT_TOPIC",
    "ActionTopic",
    "TopicFilter",
    "action_topic",
    "check_patterns",
    "is_service_event",
    "pattern",
    "service_of",
]

#: How the topics of service introspection end.
EVENT_TOPIC, _EVENT_TYPE = "/_service_event", "_Event"
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


def is_service_event(topic: str, type_name: str) -> bool:
    """Return True if a topic carries the introspection events of a service."""
    return topic.endswith(EVENT_TOPIC) and type_name.endswith(_EVENT_TYPE)


def service_of(topic: str, type_name: str) -> tuple[str, str]:
    """Return the name and type of the service whose events a topic carries."""
    return topic.removesuffix(EVENT_TOPIC), type_name.removesuffix(_EVENT_TYPE)


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


def pattern(text: str) -> re.Pattern[str] | None:
    """Return a compiled pattern; None for an empty string.

    Raises:
        RuntimeError: ``text`` is not a regular expression.
    """
    try:
        return re.compile(text) if text else None
    except re.error as error:
        raise RuntimeError(f"'{text}' is not a regular expression: {error}") from None


def check_patterns(options: RecordOptions) -> None:
    """Check the patterns of a recording.

    Raises:
        RuntimeError: A pattern is not a regular expression.
    """
    for text in (options.regex, options.exclude_regex):
        pattern(text)


class TopicFilter:
    """Decides by name and types; says once of each topic why it cannot be recorded.

    Args:
        options: Which topics to record.
        complain: Called with severity (``"error"`` or ``"warning"``) and text.

    Raises:
        RuntimeError: A pattern is not a regular expression.
    """

    def __init__(self, options: RecordOptions, complain: Callable[[str, str], None]) -> None:
        self._options = options
        self._complain = complain
        self._regex = pattern(options.regex)
        self._exclude_regex = pattern(options.exclude_regex)
        # In Jazzy, the topics of actions are like any other, unless actions are asked for.
        self._knows_actions = since(KILTED) or any(
            (options.all_actions, options.actions, options.exclude_actions)
        )
        self._told: set[str] = set()

    def takes(self, topic: str, types: Sequence[str], *, published: bool, heard: bool) -> bool:
        """Return True if a topic is recorded.

        Args:
            topic: Its name.
            types: The types that its publishers and subscriptions have.
            published: Whether it has a publisher.
            heard: Whether it has a subscription other than a recorder's.
        """
        options = self._options
        if not self._is_wanted(topic, types):
            return False
        if len(types) > 1:
            self._tell(
                topic,
                "error",
                f"Topic '{topic}' has several types associated. "
                "Only topics with one type are supported",
            )
            return False
        # Names of event topics and topics of actions always have a hidden part.
        hidden = is_hidden(topic) and not (
            is_service_event(topic, types[0]) or self._action(topic, types)
        )
        if hidden and not options.include_hidden_topics:
            text = "Hidden topics are not recorded. Enable them with --include-hidden-topics"
            self._tell("hidden topics", "warning", text)
            return False
        if not published and not options.include_unpublished_topics:
            return False
        return heard or not options.ignore_leaf_topics

    def _is_wanted(self, topic: str, types: Sequence[str]) -> bool:
        options = self._options
        action = self._action(topic, types)
        if action is not None:
            everything, listed = options.all_actions, action.action in options.actions
            excluded = action.action in options.exclude_actions
            name = action.action
        elif is_service_event(topic, types[0]):
            everything, listed = options.all_services, topic in options.services
            excluded = topic in options.exclude_service_events
            name = topic.removesuffix(EVENT_TOPIC)
        else:
            everything = options.all_topics
            listed = topic in options.topics or types[0] in options.topic_types
            excluded = topic in options.exclude_topics or types[0] in options.exclude_topic_types
            name = topic
        if excluded or (self._exclude_regex and self._exclude_regex.search(name)):
            return False
        return everything or listed or bool(self._regex and self._regex.search(name))

    def _action(self, topic: str, types: Sequence[str]) -> ActionTopic | None:
        """Return the action of a topic, if actions are recorded as such."""
        return action_topic(topic, types[0]) if self._knows_actions else None

    def _tell(self, what: str, severity: str, text: str) -> None:
        if what not in self._told:
            self._told.add(what)
            self._complain(severity, text)
